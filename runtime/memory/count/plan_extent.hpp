// SPDX-License-Identifier: Apache-2.0
// extents of objects -> the minimum that they take of the world, since they may lie in each other.
#pragma once

#include <vector>

#include "runtime/grid/grid_frame.hpp"

namespace voxelume {

/// The extent of surfaces in the world's lattice.
struct WorldExtent {
    double voxels = 0;
    double bricks = 0;
    double exact_voxels = 0;  ///< those of `voxels` that list their primitives
};

struct ObjectExtent {
    VoxelBox box;  ///< box around the object, in the world's voxels
    WorldExtent extent;
};

/// The sum over objects of which no two can share a brick: in the order of decreasing bricks, an
/// object counts if its box is apart from those counted before. If there are very many objects, the
/// smallest are left out.
WorldExtent min_extent(std::vector<ObjectExtent> objects);

/// A box of a lattice's voxels, in the voxels of a part of the lattice.
VoxelBox in_part(const VoxelBox& box, const GridFrame& whole, const GridFrame& part);

}  // namespace voxelume
