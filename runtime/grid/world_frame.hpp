// SPDX-License-Identifier: Apache-2.0
// The lattice of the world.
#pragma once

#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/parts/world.hpp"

namespace voxelume {

/// The world's lattice: its first voxel starts at the bounds' minimum corner.
inline GridFrame world_frame(const World& world) {
    return {world.bounds.min, world.voxel_size, world.voxels};
}

}  // namespace voxelume
