// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/place/place.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "runtime/base/error.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "tests/place/placing.hpp"

namespace voxelume {
namespace {

using ::testing::HasSubstr;

BrickGrid tricube() {
    const VoxelMap voxels = voxels_of({{1, 2, 3}, {2, 2, 3}, {1, 3, 3}});
    return occupied_bricks(frame_of({4, 5, 6}), voxels).upload(shared_device());
}

const GridFrame kAround = frame_at(glm::dvec3(-8), glm::dvec3(1), {17, 18, 19});

TEST(Place, YawByAQuarterTurnTakesXToMinusZ) {
    EXPECT_EQ(
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {90, 0, 0}, {1, 1, 1}), kAround),
        voxels_of({{11, 10, 6}, {11, 10, 5}, {11, 11, 6}}));
}

TEST(Place, PitchByAQuarterTurnTakesYToZ) {
    EXPECT_EQ(
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {0, 90, 0}, {1, 1, 1}), kAround),
        voxels_of({{9, 4, 10}, {10, 4, 10}, {9, 4, 11}}));
}

TEST(Place, RollByAQuarterTurnTakesXToY) {
    EXPECT_EQ(
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {0, 0, 90}, {1, 1, 1}), kAround),
        voxels_of({{5, 9, 11}, {5, 10, 11}, {4, 9, 11}}));
}

TEST(Place, MirrorsAndDoublesAndHalves) {
    EXPECT_EQ(
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {0, 0, 0}, {-1, 1, 1}), kAround),
        voxels_of({{6, 10, 11}, {5, 10, 11}, {6, 11, 11}}));
    const VoxelMap doubled =
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {0, 0, 0}, {2, 2, 2}), kAround);
    EXPECT_EQ(doubled.size(), 24u);
    for (const auto& [v, word] : doubled) {
        const glm::ivec3 source = (v - 8) / 2;
        EXPECT_TRUE(source == glm::ivec3(1, 2, 3) || source == glm::ivec3(2, 2, 3) ||
                    source == glm::ivec3(1, 3, 3));
    }
    EXPECT_EQ(
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {0, 0, 0}, {.5, .5, .5}), kAround),
        voxels_of({{8, 9, 9}, {9, 9, 9}}));
}

/// A random lump without symmetry.
VoxelMap random_lump(uint32_t seed, const glm::ivec3& size) {
    std::mt19937 random(seed);
    VoxelMap voxels;
    for (glm::ivec3 v{0}; v.z < size.z; ++v.z)
        for (v.y = 0; v.y < size.y; ++v.y)
            for (v.x = 0; v.x < size.x; ++v.x)
                if (random() % 3 != 0) voxels[v] = 0;
    return voxels;
}

TEST(Place, MovesByWholeVoxelsExactlyEvenFarFromTheOrigin) {
    const VoxelMap lump = random_lump(11, {21, 13, 18});
    HostBricks bricks =
        occupied_bricks(frame_at({0.3, -0.7, 0.1}, glm::dvec3(0.1), {21, 13, 18}), lump);
    bricks.attributes.clear();
    const BrickGrid grid = bricks.upload(shared_device());
    for (const double far : {0.0, 1e4, 1e5, 1e6}) {  // 10^7 voxels at most
        const GridFrame world =
            frame_at(glm::dvec3(far) + glm::dvec3{-0.3, -1.9, 0.6}, glm::dvec3(0.1), {40, 30, 35});
        glm::dmat4 map(1.0);
        map[3] = {far + 0.4, far - 0.5, far + 0.8, 1};
        VoxelMap expected;
        for (const auto& [v, word] : lump) expected[v + glm::ivec3{10, 7, 3}] = 0;
        EXPECT_EQ(place_cubes(grid, map, world), expected) << far;
    }
}

TEST(Place, AFullTurnInTenthsIsTheIdentity) {
    const VoxelMap lump = random_lump(12, {13, 14, 15});
    HostBricks bricks = occupied_bricks(frame_at({-6, -7, -7}, glm::dvec3(1), {13, 14, 15}), lump);
    bricks.attributes.clear();
    const BrickGrid grid = bricks.upload(shared_device());
    glm::dmat3 turn(1.0);
    for (int i = 0; i < 36; ++i) turn = rotation_from_turn({10, 0, 0}) * turn;
    EXPECT_EQ(place_cubes(grid, glm::dmat4(turn), grid.frame), lump);
}

TEST(Place, SamplesTheVoxelThatTheCentreFallsInForAGeneralMap) {
    constexpr uint32_t kSeed = 4;
    const glm::ivec3 size{33, 20, 27};
    const VoxelMap lump = random_lump(kSeed, size);
    HostBricks bricks = occupied_bricks(frame_at({-1.5, -1, -1.2}, {0.1, 0.1, 0.1}, size), lump);
    bricks.attributes.clear();
    const BrickGrid grid = bricks.upload(shared_device());
    glm::dmat4 map = affine_from_factors({0.13, -0.21, 0.34}, {33, -21, 57}, {1.3, -1.1, 1.9});
    map[1] += 0.2 * map[0];  // a shear
    const GridFrame world = frame_at({-3.01, -3.02, -3.03}, {0.05, 0.06, 0.07}, {127, 98, 85});
    const VoxelMap placed = place_cubes(grid, map, world);
    const glm::dmat4 inverse = glm::inverse(map);
    size_t found = 0;
    for (glm::ivec3 v{0}; v.z < world.size.z; ++v.z)
        for (v.y = 0; v.y < world.size.y; ++v.y)
            for (v.x = 0; v.x < world.size.x; ++v.x) {
                const glm::dvec3 centre = world.origin + world.voxel_edge * (glm::dvec3(v) + 0.5);
                const glm::dvec3 p =
                    (glm::dvec3(inverse * glm::dvec4(centre, 1)) - grid.frame.origin) /
                    grid.frame.voxel_edge;
                const glm::dvec3 gap = glm::abs(p - glm::round(p));
                if (std::min({gap.x, gap.y, gap.z}) < 1e-6) continue;
                const bool expected = lump.contains(glm::ivec3(glm::floor(p)));
                found += expected;
                ASSERT_EQ(placed.contains(v), expected)
                    << "seed " << kSeed << " at " << v.x << " " << v.y << " " << v.z;
            }
    EXPECT_GT(found, 10000u);
}

TEST(Place, RefusesMapsThatCanNotBeInverted) {
    const BrickGrid grid = tricube();
    const auto message_of = [&](const glm::dmat4& map) -> std::string {
        try {
            place_cubes(grid, map, kAround);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::scene);
            return error.what();
        }
        return "placed";
    };
    EXPECT_THAT(message_of(affine_from_factors({0, 0, 0}, {0, 0, 0}, {1, 0, 1})),
                HasSubstr("flattens"));
    EXPECT_THAT(message_of(affine_from_factors({0, 0, 0}, {5, 6, 7}, {1, 2e-6, 1})),
                HasSubstr("stretches one direction 5e+05 times"));
    EXPECT_THAT(message_of(affine_from_factors({1e300 * 1e10, 0, 0}, {0, 0, 0}, {1, 1, 1})),
                HasSubstr("not finite"));
    EXPECT_THAT(message_of(affine_from_factors({1e30, 0, 0}, {0, 0, 0}, {1, 1, 1})),
                HasSubstr("too far"));
    EXPECT_EQ(message_of(affine_from_factors({0, 0, 0}, {5, 6, 7}, {1, 1e-4, 1})), "placed");
}

TEST(Place, OverlapsShowThePriorityThenTheEarlierObjectInAnyOrderOfTheList) {
    const Device& device = shared_device();
    const glm::ivec3 size{20, 18, 7};
    std::vector<BrickGrid> grids;
    std::vector<VoxelMap> lumps;
    for (const uint32_t seed : {1u, 2u, 3u, 4u}) {
        lumps.push_back(random_lump(seed, size));
        HostBricks bricks = occupied_bricks(frame_of(size), lumps.back());
        for (size_t i = 0; i < bricks.attributes.size(); ++i)
            bricks.attributes[i] = uint32_t(i % 4096 % 3) << 16;
        grids.push_back(bricks.upload(device));
    }
    const int priorities[] = {5, 9, 5, -2};
    std::vector<size_t> order = {0, 1, 2, 3};
    do {
        std::vector<PlacedObject> objects;
        for (const size_t i : order)
            objects.push_back({.grid = &grids[i],
                               .object = uint32_t(10 + i),
                               .priority = priorities[i],
                               .material_of_group = {uint32_t(100 * i), uint32_t(100 * i + 7)}});
        const ReadBricks world(place(device, objects, grids[0].frame));
        for (glm::ivec3 v{0}; v.z < size.z; ++v.z)
            for (v.y = 0; v.y < size.y; ++v.y)
                for (v.x = 0; v.x < size.x; ++v.x) {
                    const PlacedObject* winner = nullptr;
                    for (const PlacedObject& object : objects)
                        if (lumps[object.object - 10].contains(v) &&
                            (!winner || object.priority > winner->priority))
                            winner = &object;
                    ASSERT_EQ(world.is_set(v), winner != nullptr);
                    if (!winner) continue;
                    const uint32_t group = uint32_t(HostBricks::index_in_brick(v) % 3);
                    ASSERT_EQ(world.word(v), winner->material_of_group[std::min(group, 1u)] << 16 |
                                                 winner->object);
                }
    } while (std::ranges::next_permutation(order).found);
}

}  // namespace
}  // namespace voxelume
