// SPDX-License-Identifier: Apache-2.0
// How far the edges of convex solids recede in fields that know distances only at nodes.
#include "tests/oracles/rounded_edges.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>

namespace voxelume {
namespace {

/// A world of cubes of this edge, metres.
World world_of(double voxel) {
    World world;
    world.voxel_size = glm::dvec3(voxel);
    world.bounds = {glm::dvec3(-2), glm::dvec3(2)};
    return world;
}

/// A frustum whose foot has an edge of this angle, radians.
Solid cone_of(double angle) {
    Solid solid;
    solid.kind = SolidKind::cone;
    solid.height = 0.5;
    solid.radius = 1;
    solid.top_radius = 1 - 0.5 / std::tan(angle);
    return solid;
}

TEST(RoundedEdges, AFieldOfWholeMetresHasTheMeanOfItsEightCorners) {
    Solid box;
    box.kind = SolidKind::box;
    box.size = {1, 3, 3};
    const oracle::LatticeDistance field(world_of(1), box, glm::dmat4(1));
    // Corners at x = 0 are 0.5 inside, those at x = 1 are 0.5 outside.
    EXPECT_DOUBLE_EQ(field.at({0.5, 0.5, 0.5}), 0);
    EXPECT_DOUBLE_EQ(field.at({0.25, 0.25, 0.75}), -0.25);
}

// The bound of the manual. The rim's own curve adds to it: 1/64 of a voxel's bend.
TEST(RoundedEdges, RecedeByHalfTheCotangentOfHalfTheirAngle) {
    constexpr uint32_t kSeed = 22;
    std::mt19937 random(kSeed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> part(0, 1);
    constexpr double kVoxel = 1 / 32.0;
    for (const double degrees : {45.0, 60.0, 90.0, 120.0}) {
        const double angle = glm::radians(degrees), bound = 0.5 / std::tan(angle / 2);
        double worst = 0;
        for (int i = 0; i < 400; ++i) {
            const glm::dquat turn = glm::normalize(
                glm::dquat(normal(random), normal(random), normal(random), normal(random)));
            glm::dmat4 map = glm::mat4_cast(turn);
            map[3] = {part(random) * kVoxel, part(random) * kVoxel, part(random) * kVoxel, 1};
            const oracle::LatticeDistance field(world_of(kVoxel), cone_of(angle), map);
            // From the foot's rim along the bisector, into the solid.
            const double around = part(random) * 6.2831853, rise = angle / 2;
            const glm::dvec3 out(std::cos(around), 0, std::sin(around));
            const glm::dvec3 in = -std::cos(rise) * out + std::sin(rise) * glm::dvec3(0, 1, 0);
            double receded = 0;  // voxels
            const auto value = [&](double voxels) {
                const glm::dvec3 p = out - glm::dvec3(0, 0.25, 0) + voxels * kVoxel * in;
                return field.at(glm::dvec3(map * glm::dvec4(p, 1)));
            };
            while (value(receded) > 0) receded += 1 / 64.0;
            worst = std::max(worst, receded);
        }
        fmt::print("{} degrees: at most {:.2f} of {:.2f} voxels\n", degrees, worst, bound);
        EXPECT_LE(worst, bound * (1 + 1 / 64.0) + 1 / 64.0) << degrees << ", seed " << kSeed;
        EXPECT_GE(worst, 0.6 * bound) << "the bound is met nearly";
    }
}

}  // namespace
}  // namespace voxelume
