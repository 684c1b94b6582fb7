// SPDX-License-Identifier: Apache-2.0
// The smooth half of `index`: the cells of a distance field that are kept, and their field records.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <random>

#include "runtime/stages/index/index.hpp"
#include "tests/place/pyramid_reader.hpp"
#include "tests/support/brick_grids.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr std::array<glm::ivec3, 3> kAxes = {glm::ivec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Twice D of the edge from node `n` along `axis`, as voxel.h defines D.
int twice_d(const NodeDistance& f, const glm::ivec3& n, int axis) {
    const glm::ivec3 a = kAxes[size_t(axis)];
    const int values[] = {f(n - a), f(n), f(n + a), f(n + a + a)};
    for (const int value : values)
        if (std::abs(value) == 32767) return 0;
    return values[2] - values[0] - values[3] + values[1];
}

/// The corner of cell `c` where edge `e` (0..3) of `axis` begins.
glm::ivec3 edge_start(const glm::ivec3& c, int axis, int e) {
    const glm::ivec3 offsets[] = {{0, e % 2, e / 2}, {e % 2, 0, e / 2}, {e % 2, e / 2, 0}};
    return c + offsets[axis];
}

/// True if the documented rule keeps the cell.
bool rule_keeps(const NodeDistance& f, const glm::ivec3& c) {
    int low = 32767, high = -32767, unsaturated = 0;
    for (int i = 0; i < 8; ++i) {
        const int value = f(c + glm::ivec3{i % 2, i / 2 % 2, i / 4});
        low = std::min(low, value);
        high = std::max(high, value);
        unsaturated += std::abs(value) != 32767;
    }
    int twice = 0;  // the sum of the largest |2D|
    for (int axis = 0; axis < 3; ++axis) {
        int largest = 0;
        for (int e = 0; e < 4; ++e)
            largest = std::max(largest, std::abs(twice_d(f, edge_start(c, axis, e), axis)));
        twice += largest;
    }
    const double m = (twice + twice / 128 + 16) / 16.0;
    return unsaturated > 0 && low - m <= 0 && high + m >= 0;
}

VoxelMap cells_by_rule(const glm::ivec3& size, const NodeDistance& f, uint32_t word) {
    VoxelMap cells;
    for (glm::ivec3 c{0}; c.z < size.z; ++c.z)
        for (c.y = 0; c.y < size.y; ++c.y)
            for (c.x = 0; c.x < size.x; ++c.x)
                if (rule_keeps(f, c)) cells[c] = word;
    return cells;
}

/// The value of D in its ten bits.
int second_difference(uint32_t bits) {
    const int size = (64 + int(bits % 64)) * (1 << bits / 64 % 8) - 64;
    return bits / 512 ? -size : size;
}

/// The bits of the second difference nearest to D, given 2D. Searches all; of two equally near
/// takes the even one.
uint32_t nearest_bits(int twice) {
    uint32_t best = twice < 0 ? 512 : 0;
    const uint32_t first = best;
    for (uint32_t bits = first; bits < first + 512; ++bits) {
        const int off = std::abs(2 * second_difference(bits) - twice);
        const int minimum = std::abs(2 * second_difference(best) - twice);
        if (off < minimum || (off == minimum && bits % 2 == 0)) best = bits;
    }
    return best;
}

/// The rounded second differences of cell `c`'s edges, by axis and edge.
using EdgeDifferences = std::array<std::array<int, 4>, 3>;

EdgeDifferences rounded_differences(const NodeDistance& f, const glm::ivec3& c) {
    EdgeDifferences differences;
    for (int axis = 0; axis < 3; ++axis)
        for (int e = 0; e < 4; ++e)
            differences[size_t(axis)][size_t(e)] =
                second_difference(nearest_bits(twice_d(f, edge_start(c, axis, e), axis)));
    return differences;
}

/// The half-Taylor interpolation in cell `c` at `s`, with its `differences` rounded as in records.
double interpolate(const NodeDistance& f, const EdgeDifferences& differences, const glm::ivec3& c,
                   const glm::dvec3& s) {
    const double w[3][2] = {{1 - s.x, s.x}, {1 - s.y, s.y}, {1 - s.z, s.z}};
    double sum = 0;
    for (int i = 0; i < 8; ++i)
        sum += w[0][i % 2] * w[1][i / 2 % 2] * w[2][i / 4] *
               f(c + glm::ivec3{i % 2, i / 2 % 2, i / 4});
    for (int axis = 0; axis < 3; ++axis)
        for (int e = 0; e < 4; ++e) {
            const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
            sum += 0.5 * s[axis] * (1 - s[axis]) * w[first][e % 2] * w[second][e / 2] *
                   differences[size_t(axis)][size_t(e)];
        }
    return sum;
}

/// The distance to a torus in stored units; outside the table it is outside, as in missing bricks.
NodeDistance torus(const glm::ivec3& size) {
    const glm::ivec3 nodes = (size / 16 + 1) * 16;
    return [=](const glm::ivec3& n) -> int16_t {
        if (n.x < 0 || n.y < 0 || n.z < 0 || n.x >= nodes.x || n.y >= nodes.y || n.z >= nodes.z)
            return 32767;
        const glm::dvec3 p = glm::dvec3(n) - glm::dvec3{33.2, 17.7, 29.4};
        const double ring = std::hypot(p.x, p.z) - 20.1;
        return stored_distance(std::hypot(ring, p.y) - 7.3);
    };
}

/// Smooth noise that no distance field is, with steps up to six voxels and saturated nodes.
NodeDistance wild_field(uint32_t seed, const glm::ivec3& nodes, int lowest = -22000) {
    std::mt19937 random(seed);
    std::vector<int16_t> values(size_t(nodes.x * nodes.y * nodes.z));
    for (int16_t& value : values) {
        const int sort = int(random() % 8);
        value = sort == 0 ? int16_t(32767)
                : sort == 1 && lowest < 0
                    ? int16_t(-32767)
                    : int16_t(int(random() % uint32_t(32767 - lowest)) + lowest);
    }
    return [=](const glm::ivec3& n) -> int16_t {
        if (n.x < 0 || n.y < 0 || n.z < 0 || n.x >= nodes.x || n.y >= nodes.y || n.z >= nodes.z)
            return 32767;
        return values[size_t(n.x + nodes.x * (n.y + nodes.y * n.z))];
    };
}

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
        const size_t place = bricks.place(v);
        const size_t leaf = place / 4096 * 64 + size_t(v.x % 16 / 4 + v.y / 4 * 4 + v.z / 4 * 16);
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
