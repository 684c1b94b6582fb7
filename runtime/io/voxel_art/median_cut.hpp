// SPDX-License-Identifier: Apache-2.0
// Many colours -> the few that stand for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace voxelume {

struct Palette {
    std::vector<uint32_t> colors;          ///< 0xBBGGRR
    std::map<uint32_t, uint32_t> numbers;  ///< of each given colour: its place in `colors`
};

/// At most `max` colours, by median cut after Heckbert 1982: the box of colours with the longest
/// side is cut where half of its voxels are, again and again, and each box has its average. Where
/// there are no more colours than that, they stay as they are.
Palette median_cut(const std::map<uint32_t, uint64_t>& voxels_by_color, size_t max);

}  // namespace voxelume
