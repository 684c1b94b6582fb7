// SPDX-License-Identifier: Apache-2.0
// Volume and area of voxels' content against formulas; shadow edges against a ball's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "runtime/render/renderer.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/verify/bench/bench.hpp"
#include "runtime/verify/bench/bench_gyroid.hpp"
#include "runtime/verify/bench/bench_mesh.hpp"
#include "runtime/verify/bench/bench_shadow.hpp"
#include "runtime/world/world.hpp"
#include "tests/support/brick_grids.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr double kPi = std::numbers::pi;

Pyramid pyramid_of(const glm::ivec3& size, const NodeDistance& distance) {
    const Device device = test_device();
    return build_index(device, distance_bricks(frame_of(size), distance).upload(device));
}

TEST(CubesExtent, CountsVoxelsAndWhatTheyShutIn) {
    const Device device = test_device();
    // The voxels are a shell of 7x5x3 around 5x3x1, one voxel next to it, and one that touches it
    // only by an edge.
    VoxelMap voxels;
    for (glm::ivec3 v{0}; v.z < 3; ++v.z)
        for (v.y = 0; v.y < 5; ++v.y)
            for (v.x = 0; v.x < 7; ++v.x)
                if (v.x % 6 == 0 || v.y % 4 == 0 || v.z % 2 == 0) voxels[v + 12] = 0;
    voxels[{30, 20, 70}] = voxels[{19, 17, 12}] = 0;
    const Extent extent = cubes_extent(
        build_index(device, occupied_bricks(frame_of({40, 30, 90}), voxels).upload(device)));
    EXPECT_EQ(extent.volume, 7 * 5 * 3 + 2);
    EXPECT_EQ(extent.area, 2 * (7 * 5 + 5 * 3 + 3 * 7) + 6 + 6);
    voxels.erase({12 + 6, 12 + 2, 12 + 1});  // a hole lets the outside in
    const Extent open = cubes_extent(
        build_index(device, occupied_bricks(frame_of({40, 30, 90}), voxels).upload(device)));
    EXPECT_EQ(open.volume, double(voxels.size()));
    EXPECT_EQ(open.area, extent.area - 1 + 4 + 2 * (5 * 3 + 3 + 5) - 1);
}

TEST(CubesExtent, TakesTheWorldsSidesForTheOutside) {
    const Device device = test_device();
    VoxelMap voxels;
    for (glm::ivec3 v{0}; v.z < 3; ++v.z)
        for (v.y = 0; v.y < 5; ++v.y)
            for (v.x = 0; v.x < 7; ++v.x)
                if (v.x > 0) voxels[v] = 0;
    const Extent extent = cubes_extent(
        build_index(device, occupied_bricks(frame_of({7, 5, 3}), voxels).upload(device)));
    EXPECT_EQ(extent.volume, 6 * 5 * 3);
    EXPECT_EQ(extent.area, 5 * 3);
}

TEST(SmoothExtent, OfABallConvergesToItsFormulas) {
    double last = 1;
    for (const double radius : {5.0, 10.0, 20.0}) {
        const glm::dvec3 middle(27.3, 25.9, 26.6);
        const Extent extent =
            extent_of(pyramid_of({54, 53, 52},
                                 [&](const glm::ivec3& p) {
                                     return stored_distance(glm::distance(glm::dvec3(p), middle) -
                                                            radius);
                                 }),
                      Surface::smooth, 1)
                .value();
        const double volume = extent.volume / (4 * kPi / 3 * std::pow(radius, 3)) - 1;
        const double area = extent.area / (4 * kPi * radius * radius) - 1;
        EXPECT_LT(std::abs(volume), last / 4) << radius;
        EXPECT_LT(std::abs(area), 1e-3 / radius) << radius;
        last = std::max(std::abs(volume), 1e-5);
    }
}

TEST(SmoothExtent, CountsSurfacesInTheSidesOfVoxelsOnce) {
    const Extent extent = smooth_extent(pyramid_of({40, 36, 33}, [](const glm::ivec3& p) {
        const glm::dvec3 q = glm::abs(glm::dvec3(p) - glm::dvec3(18, 17, 16)) - glm::dvec3(9, 8, 7);
        return stored_distance(std::max({q.x, q.y, q.z}));
    }));
    // Faces bulge by at most 1/16 voxel in the voxel next to each edge: 17.3 in all, as counted
    // over 32^3 points in each voxel.
    EXPECT_NEAR(extent.volume, 18 * 16 * 14 + 17.3, 0.3);
    EXPECT_NEAR(extent.area, 2 * (18 * 16 + 16 * 14 + 14 * 18), 10);
}

TEST(TrianglesExtent, OfATetrahedronFarFromTheOrigin) {
    const glm::dvec3 o(1e6, -2e6, 3e6), a = o + glm::dvec3(2, 0, 0), b = o + glm::dvec3(0, 3, 0),
                                        c = o + glm::dvec3(0, 0, 5);
    const std::vector<glm::dvec3> corners = {o, b, a, o, a, c, o, c, b, a, b, c};
    const Extent extent = triangles_extent(corners);
    EXPECT_DOUBLE_EQ(extent.volume, 5);
    EXPECT_NEAR(extent.area, 3 + 5 + 7.5 + std::sqrt(9 + 25 + 56.25), 1e-12);
}

class EveryPlacement : public testing::TestWithParam<Placement> {};
INSTANTIATE_TEST_SUITE_P(Placements, EveryPlacement,
                         testing::Values(Placement::world, Placement::instance));

TEST_P(EveryPlacement, HasTheSolidsVolumeAndArea) {
    const Device device = test_device();
    for (const BenchSolid& solid : bench_solids().first(2)) {
        const BenchSubject subject = subject_of(solid);
        for (const SurfaceKind& kind : kSurfaceKinds) {
            const Surface surface = kind.surface;
            Scene scene = subject.scene(surface, 40, {16, 16});
            scene.objects[0].placement = GetParam();
            scene.models[0].set = VoxelSet::solid;
            WorldReport report;
            const auto extent = extent_of(build_world(device, scene, report), surface, 1);
            ASSERT_TRUE(extent);
            const double bound = surface == Surface::cubes    ? 1e-2
                                 : surface == Surface::smooth ? 2e-5
                                                              : 2e-7;
            EXPECT_NEAR(extent->volume / subject.extent->volume, 1, bound)
                << solid.name << " " << name_of(surface);
            if (surface == Surface::cubes) continue;  // steps never have a slope's area
            EXPECT_NEAR(extent->area / subject.extent->area, 1, bound)
                << solid.name << " " << name_of(surface);
        }
    }
}

TEST(GyroidExtent, IsWhatFinerAndFinerMeshesApproach) {
    const Extent coarse = MeshTruth(gyroid_mesh(40)).extent();
    const Extent fine = MeshTruth(gyroid_mesh(80)).extent();
    const Extent truth = gyroid_subject().extent.value();
    EXPECT_NEAR((4 * fine.volume - coarse.volume) / 3 / truth.volume, 1, 1e-4);
    EXPECT_NEAR((4 * fine.area - coarse.area) / 3 / truth.area, 1, 1e-4);
}

TEST(ShadowEdge, OfABallIsAnEllipseThatExactSurfacesHit) {
    const BenchSubject ball = subject_of(bench_solids()[0]);
    const ShadowTruth truth = shadow_truth(ball, {120, 90});
    EXPECT_GT(truth.edge.length, 60);
    EXPECT_GT(std::ranges::count(truth.sides, PixelSide::inside), 500);
    EXPECT_GT(std::ranges::count(truth.sides, PixelSide::outside), 2000);
    const Device device = test_device();
    const auto measured = [&](Surface surface, int resolution) {
        RenderReport report;
        return measure_shadow(
            truth, render(device, shadow_scene(ball, surface, resolution, {120, 90}), report));
    };
    EXPECT_EQ(measured(Surface::exact, 16).mean, 0);
    EXPECT_LT(measured(Surface::smooth, 16).mean, 0.02);
    const ShadowErrors cubes = measured(Surface::cubes, 16);
    EXPECT_GT(cubes.mean, 1);
    EXPECT_GT(cubes.max, cubes.mean);
    // A supercover's cubes extend up to a diagonal, 0.108 m, beyond the ball; 1 m is 43 pixels.
    EXPECT_LT(cubes.max, 2 * 0.108 * 43);
}

TEST(PixelContour, FollowsALineAndTellsHowFarPixelsAreFromIt) {
    std::vector<PixelSide> sides;
    const auto is_inside = [](const glm::dvec2& p) { return p.x + 2 * p.y < 11.3; };
    for (int row = 0; row < 7; ++row)
        for (int column = 0; column < 9; ++column)
            sides.push_back(is_inside({column + 0.5, row + 0.5}) ? PixelSide::inside
                                                                 : PixelSide::outside);
    const PixelContour contour = contour_of({9, 7}, sides, is_inside);
    // The contour goes from x = 0.5 to x = 8.5, between the outermost centres.
    EXPECT_NEAR(contour.length, 8 * std::sqrt(1.25), 1e-6);
    EXPECT_NEAR(contour.distance_to({3, 1}), (11.3 - 3 - 2) / std::sqrt(5), 1e-6);
    ContourError error(contour);
    EXPECT_EQ(error.max(), 0);
    error.add({3, 1});
    error.add({3.3, 4.5});
    EXPECT_NEAR(error.max(), 6.3 / std::sqrt(5), 1e-6);
    EXPECT_NEAR(error.mean(), 2 / contour.length, 1e-12);
    std::vector<PixelSide> unknown(sides.size(), PixelSide::unknown);
    EXPECT_EQ(contour_of({9, 7}, unknown, is_inside).length, 0);
}

}  // namespace
}  // namespace voxelume
