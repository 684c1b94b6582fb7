// SPDX-License-Identifier: Apache-2.0
// The smooth half of `index`: the cells of a distance field that are kept, and their field records.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <random>

#include "runtime/stages/index/index.hpp"
#include "tests/place/index_field_rule.hpp"
#include "tests/place/pyramid_reader.hpp"
#include "tests/support/brick_grids.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

TEST(IndexField, KeepsExactlyTheCellsOfTheRuleOnATorus) {
    const glm::ivec3 size{70, 37, 63};
    const NodeDistance f = torus(size);
    const Device device = test_device();
    const Pyramid p = build_index(device, distance_bricks(frame_of(size), f).upload(device));
    expect_holds(p, cells_by_rule(size, f, 0x40000000u));
    EXPECT_TRUE(p.attributes.empty());
}

TEST(IndexField, KeepsExactlyTheCellsOfTheRuleOnAWildField) {
    const glm::ivec3 size{19, 33, 17};
    const Device device = test_device();
    for (const uint32_t seed : {1u, 2u, 3u}) {
        const NodeDistance f = wild_field(seed, (size / 16 + 1) * 16);
        const Pyramid p = build_index(device, distance_bricks(frame_of(size), f).upload(device));
        expect_holds(p, cells_by_rule(size, f, 0x40000000u));
        ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
}

TEST(IndexField, MissesNoCellThatTheStoredInterpolantCrosses) {
    const glm::ivec3 size{19, 33, 17};
    const Device device = test_device();
    const NodeDistance f = wild_field(77, (size / 16 + 1) * 16, 8000);
    const Pyramid p = build_index(device, distance_bricks(frame_of(size), f).upload(device));
    const HostPyramid host(p);
    int missing = 0;
    for (glm::ivec3 c{0}; c.z < size.z; ++c.z)
        for (c.y = 0; c.y < size.y; ++c.y)
            for (c.x = 0; c.x < size.x; ++c.x) {
                if (int log2; host.find(c, log2)) continue;
                ++missing;
                const EdgeDifferences differences = rounded_differences(f, c);
                double low = 1e9, high = -1e9;
                for (int i = 0; i < 343; ++i) {
                    const glm::dvec3 s = glm::dvec3(i % 7, i / 7 % 7, i / 49) / 6.0;
                    const double value = interpolate(f, differences, c, s);
                    low = std::min(low, value);
                    high = std::max(high, value);
                }
                ASSERT_TRUE(low > 0 || high < 0) << c.x << " " << c.y << " " << c.z;
            }
    EXPECT_GT(missing, 1000);
}

TEST(IndexField, RecordsHoldTheEightDistancesAndTwelveRoundedSecondDifferences) {
    const glm::ivec3 size{70, 37, 63};
    const NodeDistance f = torus(size);
    const Device device = test_device();
    const Pyramid p = build_index(device, distance_bricks(frame_of(size), f).upload(device));
    const HostPyramid host(p);
    for (const auto& [c, word] : cells_by_rule(size, f, 0)) {
        int log2 = 0;
        const std::optional<uint32_t> voxel = host.find(c, log2);
        ASSERT_TRUE(voxel);
        const uint32_t* words = &host.fields.at(size_t(*voxel) * 8);
        for (int i = 0; i < 8; ++i) {
            const glm::ivec3 corner{i % 2, i / 2 % 2, i / 4};
            const uint32_t half = words[corner.y + 2 * corner.z] >> (corner.x ? 16 : 0);
            ASSERT_EQ(int16_t(half & 0xFFFF), f(c + corner));
        }
        for (int axis = 0; axis < 3; ++axis)
            for (int e = 0; e < 4; ++e) {
                const int twice = twice_d(f, edge_start(c, axis, e), axis);
                ASSERT_EQ(words[4 + e] >> (10 * axis) & 1023u, nearest_bits(twice));
            }
    }
}

TEST(IndexField, PinsTheWordsOfOneCellWrittenByHand) {
    // f = 100 x² + 10 y + z at cell (1,2,3), shifted to cross zero: D_x = (f1 - f-1 - f2 + f0) / 2
    // with x = 0,1,2,3: (400 - 0 - 900 + 100) / 2 = -200, so e = 2 and m = 2; the others are 0.
    const glm::ivec3 size{7, 6, 5};
    const NodeDistance f = [](const glm::ivec3& n) {
        return int16_t(100 * n.x * n.x + 10 * n.y + n.z - 200);
    };
    const Device device = test_device();
    const Pyramid p = build_index(device, distance_bricks(frame_of(size), f).upload(device));
    const HostPyramid host(p);
    int log2 = 0;
    const size_t first = size_t(host.find({1, 2, 3}, log2).value()) * 8;
    const auto pair = [](int a, int b) {
        return uint32_t(uint16_t(a)) | uint32_t(uint16_t(b)) << 16;
    };
    const std::vector<uint32_t> expected = {
        pair(-77, 223), pair(-67, 233), pair(-76, 224), pair(-66, 234), 0x282, 0x282, 0x282, 0x282};
    EXPECT_EQ(std::vector(host.fields.begin() + long(first), host.fields.begin() + long(first) + 8),
              expected);
}

TEST(IndexField, NeverKeepsACellOfEightSaturatedCorners) {
    const glm::ivec3 size{40, 20, 18};  // x < 16 inside, beyond outside, nothing stored
    const NodeDistance f = [](const glm::ivec3& n) { return int16_t(n.x < 16 ? -32767 : 32767); };
    const Device device = test_device();
    const HostBricks bricks = distance_bricks(frame_of(size), f);
    ASSERT_TRUE(bricks.coordinates.empty());
    EXPECT_EQ(build_index(device, bricks.upload(device)).voxel_count, 0u);
}

TEST(IndexField, ReadsMissingBricksAsSaturatedWithTheirSign) {
    const glm::ivec3 size{48, 16, 16};
    const NodeDistance f = [](const glm::ivec3& n) -> int16_t {
        if (n.x < 0 || n.y < 0 || n.z < 0) return 32767;
        if (n.x < 16) return -32767;
        if (n.x >= 32) return 32767;
        return n.x < 24 ? -32000 : 30000;
    };
    const Device device = test_device();
    const Pyramid p = build_index(device, distance_bricks(frame_of(size), f).upload(device));
    expect_holds(p, cells_by_rule(size, f, 0x40000000u));
    int log2 = 0;
    EXPECT_TRUE(HostPyramid(p).find({23, 3, 5}, log2));
    EXPECT_FALSE(HostPyramid(p).find({15, 3, 5}, log2)) << "both ends inside";
}

TEST(IndexField, DropsCellsBeyondTheGrid) {
    const glm::ivec3 size{16, 16, 16};
    const NodeDistance f = [](const glm::ivec3& n) { return stored_distance(n.x - 16.5); };
    const Device device = test_device();
    EXPECT_EQ(build_index(device, distance_bricks(frame_of(size), f).upload(device)).voxel_count,
              0u);
}

TEST(IndexField, CubesWinOverTheFieldInTheirVoxelAndTheKindsAreWritten) {
    const glm::ivec3 size{21, 9, 7};
    const NodeDistance f = [](const glm::ivec3& n) { return stored_distance(n.y - 3.5); };
    const Device device = test_device();
    HostBricks bricks = distance_bricks(frame_of(size), f);
    bricks.occupancy.assign(bricks.coordinates.size() * 64, 0);
    VoxelMap expected = cells_by_rule(size, f, 0x40050002u);
    for (const glm::ivec3 v : {glm::ivec3{5, 3, 2}, glm::ivec3{17, 8, 6}}) {
        const size_t index = bricks.index_of(v);
        const size_t leaf = index / 4096 * 64 + size_t(v.x % 16 / 4 + v.y / 4 * 4 + v.z / 4 * 16);
        bricks.occupancy[leaf] |= uint64_t{1} << (v.x % 4 + v.y % 4 * 4 + v.z % 4 * 16);
        expected[v] = 0x00050002u;
    }
    BrickGrid grid = bricks.upload(device);
    grid.attribute = 0x00050002u;
    expect_holds(build_index(device, grid), expected);
    const Pyramid p = build_index(device, grid);
    const HostPyramid host(p);
    int log2 = 0;
    const size_t cube = host.find({5, 3, 2}, log2).value();
    EXPECT_EQ(std::count(host.fields.begin() + long(cube * 8),
                         host.fields.begin() + long(cube * 8) + 8, 0u),
              8);
}

TEST(IndexField, IsTheSameForEveryBuild) {
    const glm::ivec3 size{70, 37, 63};
    const Device device = test_device();
    const BrickGrid grid = distance_bricks(frame_of(size), torus(size)).upload(device);
    const Pyramid a = build_index(device, grid), b = build_index(device, grid);
    EXPECT_EQ(a.bricks.read(), b.bricks.read());
    EXPECT_EQ(a.leaves.read(), b.leaves.read());
    EXPECT_EQ(a.fields.read(), b.fields.read());
}

}  // namespace
}  // namespace voxelume
