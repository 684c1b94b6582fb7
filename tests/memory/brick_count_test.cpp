// SPDX-License-Identifier: Apache-2.0
// Bricks and voxels of solids counted by distances, against those that are voxelized.
#include "runtime/memory/count/brick_count.hpp"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/memory/count/voxel_bricks.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/voxelize/voxelize_solid.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

Solid solid_of(SolidKind kind) {
    Solid s;
    s.kind = kind;
    s.radius = 0.31, s.top_radius = 0.12, s.tube = 0.09, s.height = 0.5, s.thickness = 0.3;
    s.radii = {0.4, 0.23, 0.31};
    s.size = {0.7, 0.33, 0.52};
    return s;
}

SurfaceExtent counted(const Solid& solid, const glm::dmat4& map, const GridFrame& frame,
                      Surface surface) {
    TakenBricks taken(frame);
    return count_bricks(SolidField(solid, map), frame, {glm::dvec3(0), glm::dvec3(frame.size)},
                        model_rule(surface, false), taken)
        .extent;
}

TEST(BrickCount, IsThatOfVoxelizingWithinAFifth) {
    const Device device = test_device();
    const glm::dmat4 map = glm::rotate(glm::translate(glm::dmat4(1), {0.013, -0.021, 0.007}), 0.4,
                                       glm::dvec3(0.3, 1, -0.2));
    const GridFrame frame{{-0.61, -0.62, -0.6}, glm::dvec3(0.01), {121, 124, 119}};
    for (const SolidKind kind :
         {SolidKind::sphere, SolidKind::ellipsoid, SolidKind::box, SolidKind::cylinder,
          SolidKind::cone, SolidKind::torus, SolidKind::capsule, SolidKind::slab})
        for (const Surface surface : {Surface::smooth, Surface::cubes}) {
            const Solid solid = solid_of(kind);
            const BrickGrid grid =
                voxelize_solid(device, solid, map, frame, {surface, VoxelSet::supercover});
            const double voxels = build_index(device, grid).voxel_count;
            const SurfaceExtent extent = counted(solid, map, frame, surface);
            EXPECT_NEAR(extent.bricks, grid.brick_count, 0.12 * grid.brick_count + 2)
                << int(kind) << " " << int(surface);
            EXPECT_NEAR(extent.voxels, voxels, 0.2 * voxels) << int(kind) << " " << int(surface);
        }
}

TEST(BrickCount, OfALargeSurfaceIsThatOfACoarserLattice) {
    const Solid ball = solid_of(SolidKind::sphere);
    const auto bricks = [&](int size) {
        const GridFrame frame{glm::dvec3(-0.4), glm::dvec3(0.8 / size), glm::ivec3(size)};
        return counted(ball, glm::dmat4(1), frame, Surface::cubes).bricks;
    };
    EXPECT_NEAR(bricks(8192) / bricks(2048), 16, 1);
}

TEST(BrickCount, CountsABrickOfTwoSurfacesOnce) {
    const GridFrame frame{glm::dvec3(-0.5), glm::dvec3(0.01), {100, 101, 102}};
    const VoxelBox box{glm::dvec3(0), glm::dvec3(frame.size)};
    const SolidField ball(solid_of(SolidKind::sphere), glm::dmat4(1));
    TakenBricks taken(frame);
    const BrickRule rule = world_rule(Surface::smooth, false, false);
    EXPECT_GT(count_bricks(ball, frame, box, rule, taken).new_bricks, 100);
    EXPECT_EQ(count_bricks(ball, frame, box, rule, taken).new_bricks, 0);
}

TEST(BrickCount, TakesAwayWhatADifferenceDoes) {
    Solid half = solid_of(SolidKind::sphere);
    half.kind = SolidKind::difference_of;
    half.parts = {solid_of(SolidKind::sphere), solid_of(SolidKind::box)};
    half.parts[1].size = glm::dvec3(2);
    half.parts[1].parent_from_solid = glm::translate(glm::dmat4(1), {1, 0, 0});
    const SolidField field(half, glm::dmat4(1));
    EXPECT_NEAR(field.distance({-0.2, 0, 0}), -0.11, 1e-12);
    EXPECT_NEAR(field.distance({0.2, 0, 0}), 0.2, 1e-12);
}

TEST(BrickCount, OfAFilesCubesIsThatOfTheBricksThatTheyReach) {
    VoxelModel full;  // one brick, in voxels of 1 m
    full.frame = {glm::dvec3(0), glm::dvec3(1), glm::ivec3(kBrickSize)};
    full.slots = full.coordinates = {0};
    full.occupancy.assign(kLeavesPerBrick, ~uint64_t{0});
    const GridFrame world{glm::dvec3(0), glm::dvec3(1), glm::ivec3(64)};
    const auto bricks = [&](const glm::dmat4& map) {
        TakenBricks taken(world);
        taken.take({1, 1, 1});
        const BrickCount count = count_voxels(full, map, 1, world, taken);
        EXPECT_LE(count.new_bricks, count.extent.bricks);
        return count.extent.bricks;
    };
    // Placing stores what is a voxel away, too.
    EXPECT_EQ(bricks(glm::translate(glm::dmat4(1), glm::dvec3(16))), 27);
    EXPECT_EQ(bricks(glm::translate(glm::dmat4(1), glm::dvec3(20))), 8);
    EXPECT_EQ(bricks(glm::translate(glm::dmat4(1), glm::dvec3(20, 20, -4))), 4);
    EXPECT_EQ(bricks(glm::scale(glm::dmat4(1), glm::dvec3(2))), 27);
    TakenBricks taken(world);
    taken.take({1, 1, 1});
    const glm::dmat4 map = glm::translate(glm::dmat4(1), glm::dvec3(20));
    EXPECT_EQ(count_voxels(full, map, 1, world, taken).new_bricks, 7);
    // Cubes far too large are counted without a list.
    EXPECT_GT(count_voxels(full, glm::scale(glm::dmat4(1), glm::dvec3(1e4)), 1, world, taken)
                  .extent.bricks,
              1e9);
}

}  // namespace
}  // namespace voxelume
