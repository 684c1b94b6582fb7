// SPDX-License-Identifier: Apache-2.0
// Open edges, lids and volumes of meshes that are known by hand.
#include "runtime/geometry/mesh_topology.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

Mesh tetrahedron() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.7f, 0}, {0, 0, 0.5f}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return mesh;
}

/// A box of 7 x 5 x 3 without the faces across x, as a pipe.
Mesh pipe() {
    Mesh mesh = box({0, 0, 0}, {7, 5, 3});
    mesh.triangles.resize(8);
    return mesh;
}

Mesh turned_inside_out(Mesh mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
    return mesh;
}

}  // namespace

TEST(MeshTopology, OfATetrahedronIsClosedAndHasItsVolume) {
    const MeshTopology topology = mesh_topology(tetrahedron());
    EXPECT_EQ(topology.open_edges, 0u);
    EXPECT_EQ(topology.hole_area, 0);
    EXPECT_NEAR(topology.volume, 1 * 0.7 * 0.5 / 6, 1e-8);
    EXPECT_NEAR(mesh_topology(turned_inside_out(tetrahedron())).volume, -0.35 / 6, 1e-8);
}

TEST(MeshTopology, AMissingFaceIsAHoleOfItsArea) {
    Mesh mesh = tetrahedron();
    mesh.triangles.erase(mesh.triangles.begin() + 1);  // in the plane y = 0
    const MeshTopology topology = mesh_topology(mesh);
    EXPECT_EQ(topology.open_edges, 3u);
    EXPECT_NEAR(topology.hole_area, 0.5 * 1 * 0.5, 1e-8);
}

TEST(MeshTopology, TwoHolesThatFaceEachOtherAddUp) {
    const MeshTopology topology = mesh_topology(pipe());
    EXPECT_EQ(topology.open_edges, 8u);
    EXPECT_NEAR(topology.hole_area, 2 * 5 * 3, 1e-6);
}

TEST(MeshTopology, CornersAtOnePlaceAreOneWhateverTheSignOfZero) {
    Mesh soup;
    const Mesh whole = tetrahedron();
    for (const glm::uvec3& t : whole.triangles) {
        const auto first = uint32_t(soup.positions.size());
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 p = whole.positions[t[i]];
            soup.positions.push_back(
                first % 2 == 0 ? p
                               : glm::vec3(p.x == 0 ? -0.0f : p.x, p.y, p.z == 0 ? -0.0f : p.z));
        }
        soup.triangles.emplace_back(first, first + 1, first + 2);
    }
    EXPECT_EQ(mesh_topology(soup), mesh_topology(whole));
}

TEST(MeshTopology, FacesThatAreDoubledBothWaysAreClosed) {
    EXPECT_EQ(mesh_topology(doubled(pipe(), true)).open_edges, 0u);
    EXPECT_EQ(mesh_topology(doubled(pipe(), false)).open_edges, 0u);
}

TEST(MeshTopology, FindsOneMissingTriangleAmongManyWhereverItIs) {
    const Mesh whole = wavy_ring(40, 30);
    EXPECT_EQ(mesh_topology(whole).open_edges, 0u);
    EXPECT_GT(mesh_topology(whole).volume, 0);
    for (size_t missing = 0; missing < whole.triangles.size(); missing += 97) {
        Mesh mesh = whole;
        const glm::uvec3 t = mesh.triangles[missing];
        mesh.triangles.erase(mesh.triangles.begin() + std::ptrdiff_t(missing));
        const MeshTopology topology = mesh_topology(mesh);
        EXPECT_EQ(topology.open_edges, 3u) << missing;
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        EXPECT_NEAR(topology.hole_area, glm::length(glm::cross(b - a, c - a)) / 2, 1e-9) << missing;
    }
}

TEST(MeshTopology, OfNoTrianglesIsEmpty) {
    EXPECT_EQ(mesh_topology(Mesh()), MeshTopology());
}

}  // namespace voxelume
