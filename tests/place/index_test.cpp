// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/index/index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <random>

#include "tests/place/pyramid_reader.hpp"
#include "tests/support/brick_grids.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using ::testing::ElementsAre;

TEST(Index, PinsTheOrderOfBitsAndNumbersOfOneHandWrittenBrick) {
    const Device device = test_device();
    // In the brick at (16,32,48), record 1 | 2 << 2 | 3 << 4 = 57 of sector 0: voxels (1,0,0),
    // (0,2,0), (0,0,3) of leaf 0 have bits 1, 8, 48; (5,0,0) is in leaf 1, (0,9,0) in leaf 8,
    // (0,0,14) in leaf 48.
    const glm::ivec3 b{16, 32, 48};
    const VoxelMap voxels = {{b + glm::ivec3{1, 0, 0}, 11}, {b + glm::ivec3{0, 2, 0}, 12},
                             {b + glm::ivec3{0, 0, 3}, 13}, {b + glm::ivec3{5, 0, 0}, 14},
                             {b + glm::ivec3{0, 9, 0}, 15}, {b + glm::ivec3{0, 0, 14}, 16}};
    const Pyramid p =
        build_index(device, occupied_bricks(frame_of({70, 45, 130}), voxels).upload(device));
    EXPECT_THAT(p.sectors.read(),
                ElementsAre(0u, 0x80000006u, 0x80000006u, 0x80000006u, 0x80000006u, 0x80000006u));
    EXPECT_THAT(p.bricks.read(57 * 4, 4), ElementsAre(0x103u, 0x10000u, 0u, 3u));
    EXPECT_THAT(p.bricks.read(56 * 4, 4), ElementsAre(0u, 0u, 0x80000004u, 0x80000004u))
        << "in 57's aligned 32³";
    EXPECT_THAT(p.bricks.read(58 * 4, 4), ElementsAre(0u, 0u, 0x80000005u, 0x80000005u));
    EXPECT_THAT(p.bricks.read(0, 4), ElementsAre(0u, 0u, 0x80000005u, 0x80000005u));
    EXPECT_THAT(p.leaves.read(), ElementsAre(0x102u, 0x10000u, 2u, 0u, 16u, 0u, 0u, 1u));
    EXPECT_THAT(p.leaf_voxels.read(), ElementsAre(0u, 3u, 4u, 5u));
    EXPECT_THAT(p.attributes.read(), ElementsAre(11u, 12u, 13u, 14u, 15u, 16u));
}

TEST(Index, FindsEveryVoxelOfARandomAsymmetricGridAndNothingElse) {
    const Device device = test_device();
    constexpr uint32_t kSeed = 20261121;
    std::mt19937 random(kSeed);
    const glm::ivec3 size{70, 37, 130};
    VoxelMap voxels;
    for (int i = 0; i < 3000; ++i)
        voxels[{random() % 70, random() % 37, random() % 40 + random() % 2 * 90}] =
            random() & 0x3FFFFFFFu;
    expect_holds(build_index(device, occupied_bricks(frame_of(size), voxels).upload(device)),
                 voxels);
    EXPECT_FALSE(HasFailure()) << "seed " << kSeed;
}

TEST(Index, HoldsAFullBrick) {
    const Device device = test_device();
    VoxelMap voxels;
    for (int z = 16; z < 32; ++z)
        for (int y = 0; y < 16; ++y)
            for (int x = 32; x < 48; ++x) voxels[{x, y, z}] = uint32_t(x + 100 * y + 10000 * z);
    const Pyramid p =
        build_index(device, occupied_bricks(frame_of({55, 17, 40}), voxels).upload(device));
    expect_holds(p, voxels);
    EXPECT_EQ(p.leaf_count, 64u);
}

TEST(Index, SkipsEmptyGroupsOfSectorsOnTheWayToAVoxelAtTheFarCorner) {
    const Device device = test_device();
    const glm::ivec3 size{600, 20, 17};
    const VoxelMap voxels = {{{599, 19, 16}, 5}};
    const Pyramid p = build_index(device, occupied_bricks(frame_of(size), voxels).upload(device));
    expect_holds(p, voxels);
    std::vector<uint32_t> expected(8, 0x80000008u);
    expected.insert(expected.end(), {0x80000006u, 0u});
    EXPECT_EQ(p.sectors.read(), expected);
}

TEST(Index, OfAnEmptyGridHasOnlySectors) {
    const Device device = test_device();
    const Pyramid p = build_index(device, occupied_bricks(frame_of({65, 3, 9}), {}).upload(device));
    expect_holds(p, {});
    EXPECT_THAT(p.sectors.read(), ElementsAre(0x80000008u, 0x80000008u));
    EXPECT_TRUE(p.bricks.empty());
    EXPECT_TRUE(p.leaves.empty());
}

TEST(Index, NeedsAtMostOneAndAHalfBytesPerVoxelOfAShellOfCubes) {
    const Device device = test_device();
    VoxelMap voxels;
    const glm::dvec3 centre{101.3, 95.1, 88.7};
    for (glm::ivec3 v{0}; v.z < 190; ++v.z)
        for (v.y = 0; v.y < 200; ++v.y)
            for (v.x = 0; v.x < 210; ++v.x)
                if (std::abs(glm::length(glm::dvec3(v) + 0.5 - centre) - 80.0) < 0.8) voxels[v] = 0;
    HostBricks bricks = occupied_bricks(frame_of({210, 200, 190}), voxels);
    bricks.attributes.clear();
    BrickGrid grid = bricks.upload(device);
    grid.attribute = 0x00070003u;
    const Pyramid p = build_index(device, grid);
    EXPECT_EQ(p.attribute, 0x00070003u);
    EXPECT_TRUE(p.attributes.empty());
    EXPECT_LE(double(4 * (p.bricks.size() + p.leaves.size() + p.leaf_voxels.size())),
              1.5 * double(p.voxel_count));
}

TEST(Index, CarriesColoursInThePyramidsOrder) {
    const Device device = test_device();
    const VoxelMap voxels = {{{3, 0, 0}, 1}, {{20, 5, 7}, 2}, {{0, 21, 0}, 3}};
    HostBricks bricks = occupied_bricks(frame_of({23, 22, 9}), voxels);
    bricks.colors.assign(bricks.attributes.size(), 0);
    for (const auto& [v, word] : voxels) bricks.colors[bricks.index_of(v)] = 0xABCD00u + word;
    const Pyramid p = build_index(device, bricks.upload(device));
    EXPECT_THAT(p.colors.read(), ElementsAre(0xABCD01u, 0xABCD02u, 0xABCD03u));
}

TEST(Index, RenumbersThePrimitiveListsOfExactVoxels) {
    const Device device = test_device();
    // In the brick's order (x fastest) voxel (5,0,0) comes before (0,1,0); in the pyramid's order
    // it comes after.
    const VoxelMap voxels = {{{5, 0, 0}, 0x80000001u}, {{0, 1, 0}, 0x80000002u}};
    BrickGrid grid = occupied_bricks(frame_of({7, 5, 3}), voxels).upload(device);
    std::vector<uint32_t> first(4097, 0);
    for (size_t v = 6; v < first.size(); ++v) first[v] = v <= 16 ? 2 : 5;
    grid.primitive_first = {device, "first", first};
    grid.primitives = {device, "primitives", std::vector<uint32_t>{70, 71, 80, 81, 0x80000004u}};
    grid.triangle_attributes = {device, "words", std::vector<uint32_t>{9}};
    const Pyramid p = build_index(device, grid);
    EXPECT_THAT(p.attributes.read(), ElementsAre(0x80000002u, 0x80000001u));
    EXPECT_THAT(p.primitive_first.read(), ElementsAre(0u, 3u, 5u));
    EXPECT_THAT(p.primitives.read(), ElementsAre(80u, 81u, 0x80000004u, 70u, 71u));
    EXPECT_EQ(p.triangle_attributes.read(), grid.triangle_attributes.read());
    grid.attributes = {};
    EXPECT_EQ(build_index(device, grid).attribute, 0x80000000u) << "primitives make it exact";
}

}  // namespace
}  // namespace voxelume
