// SPDX-License-Identifier: Apache-2.0
// Estimates of area against surfaces whose extent is known.
#include "runtime/geometry/surface_extent.hpp"

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

GridFrame frame_of(const glm::dvec3& edge, const glm::ivec3& size) {
    return {glm::dvec3(0), edge, size};
}

/// A rectangle of 3 x 2 m in the plane z = 0.
Mesh rectangle() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

TEST(SurfaceExtent, AFlatPatchTakesItsShadowsVoxels) {
    const SurfaceArea area = mesh_areas(rectangle()).all;
    EXPECT_EQ(area.total, 6);
    EXPECT_EQ(area.shadows, glm::dvec3(0, 0, 6));
    const GridFrame frame = frame_of({0.01, 0.02, 0.05}, {300, 100, 40});
    const SurfaceExtent flat = surface_extent(area, glm::dmat4(1), frame, 0);
    EXPECT_NEAR(flat.voxels, 300 * 100, 1e-6);
    EXPECT_NEAR(flat.bricks, 300 * 100 / 256.0 + 8, 1e-6);
    // Both triangles have boxes of 300 x 100 voxels.
    EXPECT_NEAR(flat.listed, 300 * 100 + 2 + 2 * (300 + 100), 1e-6);
    // The rectangle stands upright after y and z are swapped: 3 m / 0.01 times 2 m / 0.05.
    const glm::dmat4 upright(glm::dmat3({1, 0, 0}, {0, 0, 1}, {0, 1, 0}));
    EXPECT_NEAR(surface_extent(area, upright, frame, 0).voxels, 300 * 40, 1e-6);
}

TEST(SurfaceExtent, ATurnedPatchCrossesMoreVoxels) {
    const SurfaceArea area = mesh_areas(rectangle()).all;
    const glm::dmat4 turn =
        glm::rotate(glm::dmat4(1), glm::quarter_pi<double>(), glm::dvec3(1, 0, 0));
    const GridFrame frame = frame_of(glm::dvec3(0.01), {300, 200, 200});
    const double voxels = surface_extent(area, turn, frame, 0).voxels;
    EXPECT_NEAR(voxels, std::sqrt(2.0) * 300 * 200, 1e-6);
}

/// The mean number of unit cells that segments along axes meet, wherever the cells lie.
double mean_cells(const std::vector<glm::dvec3>& segments) {
    constexpr int kShifts = 64;
    double met = 0;
    for (const glm::dvec3& segment : segments)
        for (int shift = 0; shift < kShifts; ++shift) {
            const glm::dvec3 low((shift + 0.5) / kShifts);
            const glm::dvec3 cells = glm::floor(low + segment) - glm::floor(low) + 1.0;
            met += cells.x * cells.y * cells.z;
        }
    return met / kShifts;
}

TEST(SurfaceExtent, TrianglesOfNoAreaAreListedByTheCellsThatTheyMeet) {
    const std::vector<glm::dvec3> segments = {{0.25, 0, 0}, {0, 3.5, 0}, {0, 0, 10.75}, {0, 0, 0}};
    Mesh mesh;
    for (const glm::dvec3& segment : segments) {
        const auto first = uint32_t(mesh.positions.size());
        mesh.positions.emplace_back(0);
        mesh.positions.emplace_back(segment);
        mesh.positions.emplace_back(segment / 2.0);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    const GridFrame frame = frame_of(glm::dvec3(1), glm::ivec3(16));
    EXPECT_NEAR(surface_extent(mesh_areas(mesh).all, glm::dmat4(1), frame, 0).listed,
                mean_cells(segments), 1e-9);
}

TEST(SurfaceExtent, OnlyThePartInsideTheWorldCounts) {
    const SolidBounds box = {glm::dvec3(-1, 0.5, -1), glm::dvec3(9, 1, 1)};
    EXPECT_NEAR(part_inside(rectangle(), glm::dmat4(1), box), 0.25, 1e-12);
    const SolidBounds below = {glm::dvec3(-1, -1, -2), glm::dvec3(9, 9, -1)};
    EXPECT_EQ(part_inside(rectangle(), glm::dmat4(1), below), 0);
}

TEST(SurfaceExtent, FacesThatTheWorldCutsAreNoSurface) {
    Solid slab;
    slab.kind = SolidKind::slab;
    slab.thickness = 0.5;
    const SolidBounds world = {glm::dvec3(-2, -1, -3), glm::dvec3(2, 1, 3)};
    const SurfaceArea area = solid_area(slab, glm::dmat4(1), world);
    EXPECT_EQ(area.shadows, glm::dvec3(0, 2 * 4 * 6, 0));
}

TEST(SurfaceExtent, TrianglesThatLieOnOneAnotherCountAtLeastOnce) {
    const Mesh ring = wavy_ring(300, 200);
    const double once = mesh_areas(ring).all.total;
    EXPECT_LE(mesh_areas(ring).min.total, once);
    EXPECT_GT(mesh_areas(ring).min.total, 0.95 * once);
    for (const bool has_own_corners : {false, true}) {
        const Mesh twice = doubled(ring, has_own_corners);
        EXPECT_NEAR(mesh_areas(twice).all.total, 2 * once, 1e-9);
        EXPECT_LE(mesh_areas(twice).min.total, once);
        EXPECT_GT(mesh_areas(twice).min.total, 0.95 * once);
    }
    EXPECT_EQ(mesh_areas(rectangle()).min.total, 6);
    EXPECT_EQ(mesh_areas(doubled(rectangle(), true)).min.total, 6);
}

}  // namespace
}  // namespace voxelume
