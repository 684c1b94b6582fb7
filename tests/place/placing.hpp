// SPDX-License-Identifier: Apache-2.0
// Places one object of cubes, for several tests.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "runtime/stages/place/place.hpp"
#include "tests/support/brick_grids.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {

inline GridFrame frame_at(const glm::dvec3& origin, const glm::dvec3& edge,
                          const glm::ivec3& size) {
    return {.origin = origin, .voxel_edge = edge, .size = size};
}

/// Places a grid of cubes alone and reads the world's voxels back; the packed attributes of all are
/// 0.
inline VoxelMap place_cubes(const BrickGrid& grid, const glm::dmat4& world_from_object,
                            const GridFrame& world, VoxelSet set = VoxelSet::supercover) {
    const std::vector<PlacedObject> objects = {{.grid = &grid,
                                                .world_from_object = world_from_object,
                                                .material_of_group = {0},
                                                .set = set}};
    return ReadBricks(place(shared_device(), objects, world)).voxels();
}

inline VoxelMap voxels_of(std::initializer_list<glm::ivec3> voxels) {
    VoxelMap map;
    for (const glm::ivec3& v : voxels) map[v] = 0;
    return map;
}

}  // namespace voxelume
