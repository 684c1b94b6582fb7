// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "runtime/render/tile_share.hpp"

namespace voxelume {
namespace {

std::vector<uint32_t> tiles_of(const std::vector<TileRange>& ranges) {
    std::vector<uint32_t> tiles;
    for_each_tile(ranges, [&](uint32_t tile) { tiles.push_back(tile); });
    return tiles;
}

TEST(TileRanges, HaveASixteenthRoundedUpAndTheRest) {
    for (const uint32_t count : {1u, 15u, 16u, 17u, 100u}) {
        std::vector<TileRange> rest = {{3, count / 2}, {1000, count - count / 2}};
        const std::vector<uint32_t> all = tiles_of(rest);
        const std::vector<TileRange> few = take_sixteenth(rest);
        EXPECT_EQ(count_tiles(few), (count + 15) / 16) << count;
        std::vector<uint32_t> joined = tiles_of(few);
        for (const uint32_t tile : tiles_of(rest)) joined.push_back(tile);
        EXPECT_EQ(joined, all) << count;
    }
}

TEST(TileRanges, JoinNeighboursAmongChosenTiles) {
    const std::vector<TileRange> chosen =
        tiles_where({{0, 4}, {8, 3}}, [](uint32_t tile) { return tile != 2 && tile != 8; });
    ASSERT_EQ(chosen.size(), 3u);
    EXPECT_EQ(tiles_of(chosen), (std::vector<uint32_t>{0, 1, 3, 9, 10}));
}

}  // namespace
}  // namespace voxelume
