// SPDX-License-Identifier: Apache-2.0
// extents of objects -> what they take of the world at least, as they may lie in each other.
#pragma once

#include <vector>

#include "runtime/grid/grid_frame.hpp"

namespace voxelume {

/// What surfaces take of the world's lattice.
struct WorldExtent {
    double voxels = 0;
    double bricks = 0;
    double exact_voxels = 0;  ///< of `voxels`, those that list their primitives
};

struct ObjectExtent {
    VoxelBox box;  ///< around the object, in the world's voxels
    WorldExtent extent;
};

/// The sum over objects of which no two can share a brick: beginning with those of most bricks,
/// each counts if its box is apart from those counted before. The smallest of very many are left
/// out.
WorldExtent min_extent(std::vector<ObjectExtent> objects);

/// A box of a lattice's voxels, in the voxels of a part of the lattice.
VoxelBox in_part(const VoxelBox& box, const GridFrame& whole, const GridFrame& part);

}  // namespace voxelume
