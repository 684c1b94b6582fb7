// Placing one object of cubes, as several tests do.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "runtime/stages/place.hpp"
#include "tests/brick_grids.hpp"
#include "tests/test_device.hpp"

namespace voxelume {

/// Opens one device for all tests of a program and closes it before the driver's own end.
class SharedDevice : public ::testing::Environment {
  public:
    void SetUp() override { device = test_device(); }
    void TearDown() override { device.reset(); }
    inline static std::optional<Device> device;
};

inline ::testing::Environment* const kSharedDevice =
    ::testing::AddGlobalTestEnvironment(new SharedDevice);

/// The device of all placing tests: buffers of one can't be read by kernels of another.
inline const Device& shared_device() {
    return SharedDevice::device.value();
}

inline GridFrame frame_at(const glm::dvec3& origin, const glm::dvec3& edge,
                          const glm::ivec3& size) {
    return {.origin = origin, .voxel_edge = edge, .size = size};
}

/// Places a grid of cubes alone and reads the world's voxels back; all have word 0.
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
