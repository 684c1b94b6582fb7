// SPDX-License-Identifier: Apache-2.0
// The triangles of a mesh around parts that are too thin for distances.
#include "runtime/geometry/thin_part.hpp"

#include <gtest/gtest.h>

#include <random>

#include "runtime/geometry/shape/mesh_shape.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "tests/support/finned_ball.hpp"

namespace voxelume {
namespace {

constexpr double kVoxel = 0.02;

/// The maximum distance of a triangle's corners from the ball's axis.
double reach_of(const Mesh& mesh, const glm::uvec3& t) {
    double reach = 0;
    for (int i = 0; i < 3; ++i)
        reach = std::max(
            reach, std::hypot(double(mesh.positions[t[i]].x), double(mesh.positions[t[i]].z)));
    return reach;
}

TEST(ThinPart, IsAFinWithFiveVoxelsOfTheBodyAround) {
    const Mesh ball = finned_ball(0.4 * kVoxel, 0.7, 400);
    const ThinPart part = thin_part_of(ball, kVoxel);
    size_t around = 0;
    for (const glm::uvec3& t : ball.triangles) {
        const bool is_kept = std::ranges::find(part.mesh.triangles, t) != part.mesh.triangles.end();
        const double reach = reach_of(ball, t);
        // The fin begins 0.54 from the axis; the fillet is two voxels wide.
        EXPECT_TRUE(is_kept || reach <= 0.49) << reach;  // five voxels above the fin
        EXPECT_FALSE(is_kept && reach < 0.35) << reach;
        around += is_kept && reach < 0.5;
    }
    EXPECT_GT(around, 100u);
    EXPECT_EQ(summary_of(part.mesh).group_names, ball.group_names);
    ASSERT_GT(part.points.size(), 1000u);
    for (const glm::vec3& p : part.points) {
        EXPECT_LT(std::abs(p.y), kVoxel) << "lies in the fin";
        EXPECT_GT(std::hypot(p.x, p.z), 0.5);
    }
}

TEST(ThinPart, IsTheTipOfACone) {
    std::vector<glm::dvec2> outline = {{0, -0.4}};
    for (int i = 1; i <= 40; ++i)
        outline.emplace_back(0.3 * std::sin(i * 0.05), -0.4 + 0.3 * (1 - std::cos(i * 0.05)));
    const glm::dvec2 from = outline.back();
    for (int i = 1; i <= 60; ++i)
        outline.push_back(from + (glm::dvec2(0, 1.4) - from) * (i / 60.0));
    const Mesh drop = turned_outline(outline, 96);
    const ThinPart part = thin_part_of(drop, kVoxel);
    ASSERT_FALSE(part.mesh.triangles.empty());
    for (const glm::uvec3& t : part.mesh.triangles)
        EXPECT_GT(drop.positions[t.x].y, 1.4 - 20 * kVoxel);
    for (const glm::vec3& p : part.points) EXPECT_GT(p.y, 1.4 - 10 * kVoxel);
}

TEST(ThinPart, IsNothingOfBodiesWithoutThinWalls) {
    constexpr unsigned kSeed = 20261126;
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<float> off(-0.002f, 0.002f);
    Mesh noisy = wavy_ring(160, 72);
    for (glm::vec3& p : noisy.positions) p += glm::vec3(off(random), off(random), off(random));
    const Mesh cube = box({-0.3f, -0.2f, -0.1f}, {0.3f, 0.25f, 0.2f});
    Mesh turned = cube;
    for (glm::vec3& p : turned.positions)
        p = glm::vec3(rotation_from_turn(glm::dvec3(25, 11, 40)) * glm::dvec3(p));
    for (const Mesh& mesh :
         {ball({0, 0, 0}, 0.5, 48, 24), noisy, cube, turned, finned_ball(0.05)}) {
        const ThinPart part = thin_part_of(mesh, kVoxel);
        EXPECT_TRUE(part.mesh.triangles.empty()) << part.mesh.triangles.size();
        EXPECT_TRUE(part.points.empty());
    }
}

TEST(ThinPart, IsNothingWhereItCantBeFound) {
    const Mesh ball = finned_ball(0.008);
    EXPECT_TRUE(thin_part_of(ball, 1.2 / 3000).points.empty()) << "too many voxels";
    EXPECT_TRUE(thin_part_of(ball, 0).points.empty());
    Mesh flat;
    flat.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    flat.triangles = {{0, 1, 2}};
    EXPECT_TRUE(thin_part_of(flat, kVoxel).points.empty());
    flat.triangles.assign(30000, {0, 1, 2});
    EXPECT_TRUE(thin_part_of(flat, kVoxel).points.empty());
}

TEST(SurfaceFor, ASmallThinPartIsExactAlone) {
    const auto choice = [](const Mesh& mesh, double voxel) {
        const MeshSummary whole = summary_of(mesh);
        const SurfaceChoice first = surface_for(whole, shape_of(mesh), voxel);
        return first.may_be_thin
                   ? surface_with(first, whole, summary_of(thin_part_of(mesh, voxel).mesh), {})
                   : first;
    };
    const Mesh bladed = bladed_ball(0.008);
    const SurfaceChoice chosen = choice(bladed, kVoxel);
    EXPECT_EQ(chosen.surface, Surface::smooth);
    EXPECT_TRUE(chosen.may_be_thin);
    EXPECT_NE(chosen.reason.find("and is exact"), std::string::npos) << chosen.reason;
    EXPECT_EQ(choice(finned_ball(0.008, 0.6, 200), kVoxel).surface, Surface::exact)
        << "much of it is thin";
    EXPECT_FALSE(choice(bladed, 0.0035).may_be_thin);
    EXPECT_EQ(choice(bladed, 0.0035).surface, Surface::smooth);
    EXPECT_FALSE(choice(ball({0, 0, 0}, 0.5, 48, 24), kVoxel).may_be_thin);
}

}  // namespace
}  // namespace voxelume
