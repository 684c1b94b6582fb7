// The voxel sets of the stress cases V4, V6, V14, V17, S2 and S3 (tests/CASES.md).
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/stress/exact_cover.hpp"
#include "runtime/stress/stress_triangles.hpp"
#include "tests/test_meshes.hpp"
#include "tests/voxelize_fixture.hpp"

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
    // cuda_voxelizer 61: a cube of 400 in 256 voxels along each edge, here 64.
    const vec3 low(150.100006f, 400.100006f, 150.100006f),
        high(550.099976f, 800.099976f, 550.099976f);
    Mesh mesh = box_mesh(low, high);
    for (vec3& p : mesh.positions) p = vec3((glm::dvec3(p) - glm::dvec3(low)) / 400.0 * 64.0);
    const ivec3 size(64);
    const VoxelSetOf voxels = voxels_of(mesh, size, VoxelSet::supercover);
    EXPECT_EQ(difference(voxels, exact_rows(mesh, size)), "");
    EXPECT_EQ(voxels.size(), 64u * 64 * 64 - 62 * 62 * 62);
}

TEST(VoxelCases, V6FourThousandSliversAreExact) {
    const Device device = test_device();
    for (uint64_t grid = 0; grid < 8; ++grid) {  // every eighth grid has slivers
        const StressResult result = stress_triangles(
            {device, 6, (8 * grid + 1) * kTrianglesOfOneGrid, kTrianglesOfOneGrid, {}});
        EXPECT_EQ(result.mismatches, 0u) << result.examples.front().text;
        EXPECT_GT(result.cells, 10000u);
    }
}

TEST(VoxelCases, V14TheSymmetriesOfTheCubeCarryVoxelsAlong) {
    Mesh mesh;
    add_triangle(mesh, {1.3f, 2.1f, 3.7f}, {9.2f, 4.4f, 5.5f}, {3.1f, 8.7f, 10.2f});
    add_triangle(mesh, {2, 2, 2}, {9, 2, 2}, {2, 8, 2});
    const VoxelSetOf expected = voxels_of(mesh, ivec3(12), VoxelSet::supercover);
    int axes[3] = {0, 1, 2};
    do {
        for (int mirrored = 0; mirrored < 8; ++mirrored) {
            glm::dmat4 map(0.0);
            VoxelSetOf moved;
            for (int a = 0; a < 3; ++a) {
                const bool mirror = mirrored >> a & 1;
                map[axes[a]][a] = mirror ? -1 : 1;
                map[3][a] = mirror ? 12 : 0;
            }
            map[3][3] = 1;
            for (const ivec3& v : expected) {
                ivec3 m;
                for (int a = 0; a < 3; ++a) m[a] = mirrored >> a & 1 ? 11 - v[axes[a]] : v[axes[a]];
                moved.insert(m);
            }
            EXPECT_EQ(
                difference(occupied_voxels(shared_voxelizer().voxelize(
                               mesh, map, unit_frame(ivec3(12)), cubes(VoxelSet::supercover))),
                           moved),
                "");
        }
    } while (std::next_permutation(axes, axes + 3));
}

/// How many voxels of `solid` a flood from a corner of the grid reaches, walls excepted.
size_t flooded(const VoxelSetOf& wall, const VoxelSetOf& solid, const ivec3& size, int reach) {
    VoxelSetOf reached{{0, 0, 0}};
    std::vector<ivec3> open{{0, 0, 0}};
    size_t inside = 0;
    while (!open.empty()) {
        const ivec3 v = open.back();
        open.pop_back();
        inside += solid.count(v);
        for (int i = 0; i < 27; ++i) {
            const ivec3 step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), n = v + step;
            if (std::abs(step.x) + std::abs(step.y) + std::abs(step.z) > reach) continue;
            if (std::min({n.x, n.y, n.z}) < 0 || n.x >= size.x || n.y >= size.y || n.z >= size.z)
                continue;
            if (!wall.count(n) && reached.insert(n).second) open.push_back(n);
        }
    }
    return inside;
}

TEST(VoxelCases, V17FloodsDoNotComeThroughShells) {
    for (const int n : {16, 29}) {
        const float s = float(n) / 32;
        const ivec3 size(n + 2, n + 1, n);
        for (const Mesh& mesh :
             {ball_mesh(vec3(16.3f, 15.9f, 15.7f) * s, 14.1f * s, 31, 17),
              torus_mesh(vec3(16.4f, 15.6f, 15.9f) * s, 9.7f * s, 4.3f * s, 31, 17)}) {
            const VoxelSetOf solid = voxels_of(mesh, size, VoxelSet::solid);
            EXPECT_GT(solid.size(), 400u);
            // Faces, then faces, edges and corners.
            EXPECT_EQ(flooded(voxels_of(mesh, size, VoxelSet::thin), solid, size, 1), 0u) << n;
            EXPECT_EQ(flooded(voxels_of(mesh, size, VoxelSet::supercover), solid, size, 3), 0u)
                << n;
        }
    }
}

TEST(VoxelCases, S2ColumnsThroughEdgesAndCornersDoNotLeak) {
    Mesh mesh = ball_mesh({13, 13, 13}, 11, 24, 12);
    for (vec3& p : mesh.positions) p = glm::round(p * 2.0f) / 2.0f;
    const ivec3 size(27, 26, 27);
    EXPECT_EQ(difference(voxels_of(mesh, size, VoxelSet::solid), exact_solid(mesh, size)), "");
}

TEST(VoxelCases, S3NoColumnOfABallIsInverted) {
    for (const int n : {67, 68, 71, 72}) {
        const float middle = float(n) / 2;
        const VoxelSetOf voxels =
            voxels_of(ball_mesh(vec3(middle), middle - 1, 48, 24), ivec3(n), VoxelSet::solid);
        std::map<std::pair<int, int>, std::array<int, 3>> columns;  // lowest, highest, count
        for (const ivec3& v : voxels) {
            auto& c = columns.try_emplace({v.x, v.y}, std::array{n, -1, 0}).first->second;
            c = {std::min(c[0], v.z), std::max(c[1], v.z), c[2] + 1};
        }
        for (const auto& [column, c] : columns) {
            EXPECT_EQ(c[1] - c[0] + 1, c[2]) << n << ": " << column.first << ' ' << column.second;
            EXPECT_GE(c[0], 0);
        }
        EXPECT_EQ(columns.count({0, 0}), 0u);
        EXPECT_EQ(columns.count({n / 2, n / 2}), 1u);
    }
}

}  // namespace
}  // namespace voxelume
