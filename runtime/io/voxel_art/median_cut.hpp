// SPDX-License-Identifier: Apache-2.0
// Many colours -> a few that replace them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace voxelume {

struct Palette {
    std::vector<uint32_t> colors;          ///< 0xBBGGRR
    std::map<uint32_t, uint32_t> numbers;  ///< for each given colour: its index in `colors`
};

/// At most `max` colours, by median cut after Heckbert 1982: the box of colours with the longest
/// side is cut in half by its number of voxels, again and again, and each box gets its average
/// colour. If there are no more colours than that, they stay.
Palette median_cut(const std::map<uint32_t, uint64_t>& voxels_by_color, size_t max);

}  // namespace voxelume
