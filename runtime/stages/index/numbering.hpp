// SPDX-License-Identifier: Apache-2.0
// The numbers of a pyramid's bricks, leaves and voxels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/grid/grid_frame.hpp"

namespace voxelume {

/// The contents of the bricks of a list, in the list's order.
struct BrickContents {
    std::span<const uint32_t> brick_numbers;  ///< indices into the table of bricks
    std::span<const uint64_t> leaf_masks;     ///< a brick without leaves holds nothing
    std::span<const uint32_t> counts;         ///< per brick `counted`; the first is of voxels
    size_t counted = 0;
};

/// The entries of the pyramid's upper levels, and where each brick's leaves and counts start.
struct Numbering {
    std::vector<uint32_t> sectors, bricks;
    std::vector<uint32_t> starts;  ///< per brick of the list: the first leaf, then one number for
                                   ///< each of its counts
    uint32_t leaf_count = 0;
    std::vector<uint64_t> totals;  ///< sum of each count
};

/// Numbers the contents of a lattice's bricks in the order of the pyramid, which depends on the
/// bricks alone.
Numbering number_bricks(const GridFrame& frame, const BrickContents& contents);

/// Throws Error::limit for more than 2^30 voxels or primitives, 2^28 of voxels with fields: kernels
/// gather two words of each leaf, or eight of each field, by signed indices.
void check_numbers(bool fields, uint64_t voxels, uint64_t primitives);

}  // namespace voxelume
