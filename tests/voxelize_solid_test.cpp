#include "runtime/stages/voxelize_solid.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "tests/test_device.hpp"

namespace voxelume {
namespace {

size_t voxel_count(const BrickGrid& grid) {
    size_t count = 0;
    for (const uint64_t mask : grid.occupancy.read()) count += std::popcount(mask);
    for (const uint32_t slot : grid.slots.read()) count += slot == kBrickInside ? 4096 : 0;
    return count;
}

size_t ball_voxels(double radius, double centre) {
    Solid ball;
    ball.radius = radius;
    GridFrame frame;
    frame.origin = glm::dvec3(-36 - centre, -37 - centre, -38 - centre);
    frame.size = {73, 75, 77};
    return voxel_count(voxelize_solid(test_device(), ball, glm::dmat4(1), frame,
                                      {Surface::cubes, VoxelSet::solid}));
}

TEST(VoxelizeSolid, ABallHasAsManyVoxelsAsCentresInsideIt) {
    EXPECT_EQ(ball_voxels(32, 0.0), 137376u);  // centred on a voxel's corner
    EXPECT_EQ(ball_voxels(32, 0.5), 137065u);  // on a voxel's centre: 6 centres on the surface
    EXPECT_EQ(ball_voxels(4, 0.0), 280u);
    EXPECT_EQ(ball_voxels(10, 0.0), 4224u);
}

}  // namespace
}  // namespace voxelume
