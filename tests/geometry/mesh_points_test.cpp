// SPDX-License-Identifier: Apache-2.0
// Points and lines as triangles without area: how many there are, and how large their voxels are.
#include "runtime/geometry/mesh_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <tuple>

#include "runtime/geometry/shape/mesh_shape.hpp"

namespace voxelume {
namespace {

/// Points at random on a sphere of radius 1.
Mesh sphere_of_points(size_t count, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Mesh mesh;
    for (size_t i = 0; i < count; ++i) {
        const double x = normal(random), y = normal(random), z = normal(random);
        const double r = std::sqrt(x * x + y * y + z * z);
        mesh.positions.emplace_back(x / r, y / r, z / r);
    }
    show_vertices(mesh);
    return mesh;
}

/// The cells with points of a lattice that begins at the mesh's lowest coordinates.
size_t filled_cells(const Mesh& mesh, double edge) {
    const Bounds box = mesh_bounds(mesh);
    std::set<std::tuple<int64_t, int64_t, int64_t>> cells;
    for (const glm::vec3& p : mesh.positions)
        cells.emplace(int64_t((double(p.x) - box.min.x) / edge),
                      int64_t((double(p.y) - box.min.y) / edge),
                      int64_t((double(p.z) - box.min.z) / edge));
    return cells.size();
}

TEST(MeshPoints, AreCountedAlongsideLinesAndTriangles) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {point_triangle(2), line_triangle(0, 1), {0, 1, 2}, point_triangle(0)};
    const PointCounts counts = count_points(mesh);
    EXPECT_EQ(counts.points, 2u);
    EXPECT_EQ(counts.lines, 1u);
}

TEST(MeshPoints, HaveTheFinestVoxelsThatThreePointsEachFill) {
    constexpr double kFinest = 2.0 / 256;
    for (const size_t count : {3000u, 30000u, 300000u}) {
        constexpr unsigned kSeed = 7;
        SCOPED_TRACE(testing::Message() << count << " points, seed " << kSeed);
        const Mesh mesh = sphere_of_points(count, kSeed);
        const double edge = voxel_edge_of_points(mesh, kFinest);
        const double filled = double(filled_cells(mesh, edge));
        const double finer = double(filled_cells(mesh, edge / 2));
        EXPECT_TRUE(double(count) >= kPointsPerVoxel * filled || edge >= 2.0 / 64);
        EXPECT_TRUE(double(count) < kPointsPerVoxel * finer || edge == kFinest);
        EXPECT_EQ(std::exp2(std::round(std::log2(edge / kFinest))), edge / kFinest);
    }
}

TEST(MeshPoints, OfAFewHaveVoxelsOfASixtiethOfTheirBox) {
    const Mesh mesh = sphere_of_points(50, 1);
    EXPECT_EQ(voxel_edge_of_points(mesh, 2.0 / 256), 2.0 / 64);
}

TEST(MeshPoints, ThatAreNamedAgainCountOnce) {
    Mesh mesh = sphere_of_points(50, 1);
    const std::vector<glm::uvec3> once = mesh.triangles;
    for (int i = 0; i < 9; ++i)
        mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
    EXPECT_EQ(voxel_edge_of_points(mesh, 2.0 / 256), 2.0 / 64);
}

TEST(MeshPoints, NextToALineHaveVoxelsThatShow) {
    Mesh mesh = sphere_of_points(50, 1);
    mesh.triangles.push_back(line_triangle(0, 1));
    EXPECT_EQ(voxel_edge_of_points(mesh, 0.01), 0.02);
    mesh.triangles.emplace_back(0, 1, 2);
    EXPECT_EQ(voxel_edge_of_points(mesh, 0.01), 0.01) << "a real triangle";
}

TEST(MeshPoints, AreCubesAndTakeAVoxelEach) {
    Mesh mesh = sphere_of_points(100, 3);
    mesh.triangles.push_back(line_triangle(0, 1));
    const MeshSummary summary = summary_of(mesh);
    EXPECT_FALSE(has_area(summary));
    EXPECT_EQ(surface_for(summary, shape_of(mesh), 0.01).surface, Surface::cubes);
    EXPECT_EQ(summary.area.triangles, 101);
    EXPECT_EQ(summary.min_area.triangles, 0) << "all may lie in one voxel";
}

}  // namespace
}  // namespace voxelume
