// SPDX-License-Identifier: Apache-2.0
// The voxel sets of the stress cases V3, V4, V6, V14, V17, S2 and S3 (tests/CASES.md).
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/verify/exact/exact_cover.hpp"
#include "runtime/verify/exact/occupancy.hpp"
#include "runtime/verify/stress/stress_triangles.hpp"
#include "runtime/verify/stress/triangle_classes.hpp"
#include "tests/support/test_meshes.hpp"
#include "tests/support/voxelize_fixture.hpp"
#include "tests/voxelize/row_flood.hpp"

namespace voxelume {
namespace {

using glm::ivec3;
using glm::vec3;

/// The voxels that the mesh's triangles meet, row by row.
VoxelSetOf exact_rows(const Mesh& mesh, const ivec3& size) {
    VoxelSetOf voxels;
    for (const TriangleOnLattice& t : lattice_mesh(mesh)) {
        const ivec3 low = glm::max(glm::min(glm::min(t[0], t[1]), t[2]) / 4096 - 1, ivec3(0));
        const ivec3 high = glm::min(glm::max(glm::max(t[0], t[1]), t[2]) / 4096, size - 1);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y) {
                const VoxelRow row = exact_row(t, y, z);
                for (int64_t x = std::max<int64_t>(row.first, 0);
                     x <= std::min<int64_t>(row.last, size.x - 1); ++x)
                    voxels.insert({int(x), y, z});
            }
    }
    return voxels;
}

TEST(VoxelCases, V4ACubeOnTheFramesSidesHasNoHoles) {
    // cuda_voxelizer 61 has a cube of 400 in 256 voxels along each edge.
    const vec3 low(150.100006f, 400.100006f, 150.100006f),
        high(550.099976f, 800.099976f, 550.099976f);
    Mesh mesh = box_mesh(low, high);
    for (vec3& p : mesh.positions) p = vec3((glm::dvec3(p) - glm::dvec3(low)) / 400.0 * 256.0);
    const ivec3 size(256);
    const VoxelSetOf voxels = voxels_of(mesh, size, VoxelSet::supercover);
    EXPECT_EQ(difference(voxels, exact_rows(mesh, size)), "");
    EXPECT_EQ(voxels.size(), 256u * 256 * 256 - 254 * 254 * 254);
}

TEST(VoxelCases, V6FourThousandSliversAreExact) {
    const Device device = test_device();
    for (uint64_t grid = 0; grid < 8; ++grid) {  // slivers are the second class
        const uint64_t first = (kTriangleClasses * grid + 1) * kTrianglesOfOneGrid;
        const StressResult result =
            stress_triangles(VoxelSet::supercover, {device, 6, first, kTrianglesOfOneGrid, {}});
        EXPECT_EQ(result.mismatches, 0u) << result.examples.front().text;
        EXPECT_GT(result.cells, 10000u);
    }
}

TEST(VoxelCases, SliversOfUpTo16384VoxelsAreInEveryBrickThatTheyTouch) {
    // Edges pass exactly through bricks' corners, far from the sliver's ends. Without the margin
    // for rounding in voxelize_bin.cl 20 of these are wrong.
    constexpr uint64_t kFirst = 28 * kTrianglesOfOneGrid;
    const ivec3 region = grid_of_triangle(kFirst).region;
    ASSERT_EQ(std::max({region.x, region.y, region.z}), 16384);
    const StressResult result =
        stress_triangles(VoxelSet::supercover, {test_device(), 3, kFirst, kTrianglesOfOneGrid, {}});
    EXPECT_EQ(result.mismatches, 0u) << result.examples.front().text;
}

/// Expects that the 48 symmetries of a cube of `n` voxels, mirrors included, map the mesh's voxels
/// like the mesh.
void expect_transformed(const Mesh& mesh, int n, VoxelSet set) {
    const VoxelSetOf expected = voxels_of(mesh, ivec3(n), set);
    int axes[3] = {0, 1, 2};
    do {
        for (int mirrored = 0; mirrored < 8; ++mirrored) {
            glm::dmat4 map(0.0);
            VoxelSetOf moved;
            for (int a = 0; a < 3; ++a) {
                const bool mirror = mirrored >> a & 1;
                map[axes[a]][a] = mirror ? -1 : 1;
                map[3][a] = mirror ? n : 0;
            }
            map[3][3] = 1;
            for (const ivec3& v : expected) {
                ivec3 m;
                for (int a = 0; a < 3; ++a)
                    m[a] = mirrored >> a & 1 ? n - 1 - v[axes[a]] : v[axes[a]];
                moved.insert(m);
            }
            EXPECT_EQ(difference(occupied_voxels(shared_voxelizer().voxelize(
                                     mesh, map, unit_frame(ivec3(n)), cubes(set))),
                                 moved),
                      "");
        }
    } while (std::next_permutation(axes, axes + 3));
}

TEST(VoxelCases, V14TheSymmetriesOfTheCubeCarryVoxelsAlong) {
    Mesh mesh;
    add_triangle(mesh, {1.3f, 2.1f, 3.7f}, {9.2f, 4.4f, 5.5f}, {3.1f, 8.7f, 10.2f});
    add_triangle(mesh, {2, 2, 2}, {9, 2, 2}, {2, 8, 2});
    expect_transformed(mesh, 12, VoxelSet::supercover);
}

TEST(VoxelCases, V3TheSymmetriesOfTheCubeLeaveABoxOnGridPlanesAsItIs) {
    const Mesh box = box_mesh({1, 1, 1}, {3, 3, 3});
    EXPECT_EQ(voxels_of(box, ivec3(4), VoxelSet::solid).size(), 8u);
    EXPECT_EQ(voxels_of(box, ivec3(4), VoxelSet::supercover).size(), 64u);
    for (const VoxelSet set : {VoxelSet::solid, VoxelSet::supercover})
        expect_transformed(box, 4, set);
}

VoxelRows rows_of(const Mesh& mesh, const ivec3& size, VoxelSet set) {
    return VoxelRows(
        shared_voxelizer().voxelize(mesh, glm::dmat4(1), unit_frame(size), cubes(set)));
}

/// Expects that no flood through faces passes the THIN shell, and that no flood through faces,
/// edges and corners passes the SUPERCOVER.
void expect_tight(const Mesh& mesh, const ivec3& size) {
    const VoxelRows solid = rows_of(mesh, size, VoxelSet::solid);
    const auto flooded = [&](const VoxelRows& wall, bool through_corners) {
        return solid.common(RowFlood(wall, through_corners).reached());
    };
    EXPECT_GT(solid.common(solid), 400u);
    EXPECT_EQ(flooded(VoxelRows(size), false), solid.common(solid));  // without walls
    const VoxelRows thin = rows_of(mesh, size, VoxelSet::thin);
    EXPECT_EQ(flooded(thin, false), 0u) << size.z;
    EXPECT_GT(flooded(thin, true), 0u)
        << size.z;  // THIN doesn't promise to stop floods through corners
    EXPECT_EQ(flooded(rows_of(mesh, size, VoxelSet::supercover), true), 0u) << size.z;
}

TEST(VoxelCases, V17FloodsDoNotComeThroughShells) {
    for (const int n : {16, 29, 64, 512}) {
        const float s = float(n) / 32;
        const ivec3 size(n + 2, n + 1, n);
        expect_tight(ball_mesh(vec3(16.3f, 15.9f, 15.7f) * s, 14.1f * s, 31, 17), size);
        expect_tight(torus_mesh(vec3(16.4f, 15.6f, 15.9f) * s, 9.7f * s, 4.3f * s, 31, 17), size);
    }
}

TEST(VoxelCases, V17FloodsDoNotComeThroughTheShellOfTheBunny) {
    const Mesh bunny = read_mesh("/usr/share/glmark2/models/bunny.obj");  // closed, 2 m long
    for (const int n : {16, 64, 512}) {
        Mesh mesh = bunny;
        for (vec3& p : mesh.positions) p = (p + vec3(1.03f, 1.02f, 0.81f)) * (float(n) / 2.1f);
        expect_tight(mesh, ivec3(n + 1, n, n * 4 / 5));
    }
}

TEST(VoxelCases, S2ColumnsThroughEdgesAndCornersDoNotLeak) {
    Mesh mesh = ball_mesh({13, 13, 13}, 11, 24, 12);
    for (vec3& p : mesh.positions) p = glm::round(p * 2.0f) / 2.0f;
    const ivec3 size(27, 26, 27);
    EXPECT_EQ(difference(voxels_of(mesh, size, VoxelSet::solid), exact_solid(mesh, size)), "");
}

/// The content of a column of voxels along z.
struct Column {
    int lowest = 1 << 20, highest = -1, count = 0;

    void add(int z, int voxels = 1) {
        lowest = std::min(lowest, z);
        highest = std::max(highest, z + voxels - 1);
        count += voxels;
    }
};

/// All columns of a cubic grid, x fastest. Bricks that are full or empty are counted as a whole.
std::vector<Column> columns_of(const BrickGrid& grid, int n) {
    const ReadOccupancy read(grid);
    const ivec3 bricks = grid.frame.bricks();
    const std::vector<uint32_t> slots = grid.slots.read();
    std::vector<Column> columns(size_t(n) * size_t(n));
    for (ivec3 b{0}; b.z < bricks.z; ++b.z)
        for (b.y = 0; b.y < bricks.y; ++b.y)
            for (b.x = 0; b.x < bricks.x; ++b.x) {
                const uint32_t slot = slots[brick_number(b, bricks)];
                if (slot == kBrickOutside) continue;
                for (int i = 0; i < 256; ++i) {
                    const int x = 16 * b.x + i % 16, y = 16 * b.y + i / 16;
                    if (x >= n || y >= n) continue;
                    Column& column = columns[size_t(y) * size_t(n) + size_t(x)];
                    if (slot == kBrickInside) {
                        column.add(16 * b.z, 16);
                        continue;
                    }
                    for (int z = 16 * b.z; z < std::min(n, 16 * b.z + 16); ++z)
                        if (read.is_set({x, y, z})) column.add(z);
                }
            }
    return columns;
}

TEST(VoxelCases, S3NoColumnOfABallIsInverted) {
    for (const int n : {67, 68, 671, 672}) {
        const float middle = float(n) / 2;
        const std::vector<Column> columns = columns_of(
            shared_voxelizer().voxelize(ball_mesh(vec3(middle), middle - 1, 48, 24), glm::dmat4(1),
                                        unit_frame(ivec3(n)), cubes(VoxelSet::solid)),
            n);
        size_t inverted = 0;
        for (const Column& c : columns)
            inverted += c.count > 0 && c.highest - c.lowest + 1 != c.count;
        EXPECT_EQ(inverted, 0u) << n;
        EXPECT_EQ(columns.front().count, 0);
        EXPECT_GT(columns[size_t(n / 2) * size_t(n) + size_t(n / 2)].count, n - 4);
    }
}

}  // namespace
}  // namespace voxelume
