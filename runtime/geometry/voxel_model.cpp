// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/voxel_model.hpp"

#include <bit>
#include <cstdlib>

namespace voxelume {

size_t bricks_of(const GridFrame& frame) {
    const glm::ivec3 bricks = frame.bricks();
    return size_t(bricks.x) * size_t(bricks.y) * size_t(bricks.z);
}

size_t VoxelModel::voxels() const {
    size_t count = 0;
    for (const uint64_t mask : occupancy) count += size_t(std::popcount(mask));
    for (const int16_t d : distance) count += std::abs(d) < kDistanceUnitsPerVoxel;
    return count;
}

BrickGrid VoxelModel::upload(const Device& device) const {
    BrickGrid grid;
    grid.frame = frame;
    grid.brick_count = uint32_t(coordinates.size());
    grid.slots = {device, "model slots", slots};
    grid.coordinates = {device, "model coordinates", coordinates};
    grid.occupancy = {device, "model occupancy", occupancy};
    grid.distance = {device, "model distances", distance};
    grid.attributes = {device, "model attributes", attributes};
    grid.colors = {device, "model colors", colors};
    grid.normals = {device, "model normals", normals};
    grid.transparent = transparent;
    return grid;
}

}  // namespace voxelume
