// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_views.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace voxelume {

std::vector<float4> ways_from_outside(const GridFrame& world) {
    const double length = glm::length(world.voxel_edge * glm::dvec3(world.size));
    std::vector<float4> ways = {{0, 0, 0, 0}};
    for (int axes = 1; axes <= 3; ++axes)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                for (int z = -1; z <= 1; ++z) {
                    const glm::dvec3 way(x, y, z);
                    if (std::abs(x) + std::abs(y) + std::abs(z) != axes) continue;
                    const glm::dvec3 voxels = length * glm::normalize(way) / world.voxel_edge;
                    ways.push_back({float(voxels.x), float(voxels.y), float(voxels.z), 0});
                }
    return ways;
}

}  // namespace voxelume
