// SPDX-License-Identifier: Apache-2.0
// The maps of the stress cases P4 to P7 (tests/CASES.md).
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/stages/place/placement_map.hpp"

namespace voxelume {
namespace {

double largest_difference(const glm::dmat3& a, const glm::dmat3& b) {
    double largest = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(a[c][r] - b[c][r]));
    return largest;
}

TEST(PlaceCases, P4ComposedQuarterTurnsAndGimbalLock) {
    // The columns are the images of X, Y and Z.
    EXPECT_EQ(rotation_from_turn({90, 90, 90}), glm::dmat3(1, 0, 0, 0, 0, 1, 0, -1, 0));
    // With theta at 90 degrees only psi - gamma matters, and at -90 degrees only their sum.
    for (const double psi : {0.0, 17.0, 133.0})
        for (const double gamma : {-40.0, 5.0, 250.0}) {
            EXPECT_LT(largest_difference(rotation_from_turn({psi, 90, gamma}),
                                         rotation_from_turn({psi - gamma, 90, 0})),
                      1e-15);
            EXPECT_LT(largest_difference(rotation_from_turn({psi, -90, gamma}),
                                         rotation_from_turn({psi + gamma, -90, 0})),
                      1e-15);
        }
}

TEST(PlaceCases, P4AQuaternionsRoundTripLosesNothing) {
    for (int i = 0; i < 1000; ++i) {
        const glm::dmat3 turn = rotation_from_turn({i * 0.7, i * 1.3 - 500, i * 2.9});
        EXPECT_LT(largest_difference(glm::mat3_cast(glm::quat_cast(turn)), turn), 1.5e-15) << i;
    }
}

TEST(PlaceCases, P5ThreeHundredAndSixtyDegreesComposedAreTheIdentity) {
    glm::dmat3 turn(1.0);
    for (int i = 0; i < 360; ++i) turn = rotation_from_turn({0, 1, 0}) * turn;
    const GridFrame frame{.origin = {-8, -9, -7}, .voxel_edge = {1, 1, 1}, .size = {16, 18, 14}};
    EXPECT_EQ(placement_map(frame, frame, glm::dmat4(turn), Reach::none, 0),
              placement_map(frame, frame, glm::dmat4(1.0), Reach::none, 0));
}

TEST(PlaceCases, P6AMillionTurnsOfAnObjectDoNotDrift) {
    // Objects keep their angles and matrices are computed from them each time, so the millionth
    // matrix is as good as the first.
    double worst = 0;
    for (int i = 1; i <= 1000000; ++i) {
        const glm::dmat3 turn = rotation_from_turn({i * 0.37, i * 0.11, i * -0.73});
        worst = std::max(worst, largest_difference(turn * glm::transpose(turn), glm::dmat3(1.0)));
    }
    EXPECT_LT(worst, 1e-12);
}

TEST(PlaceCases, P7UnevenScalesComeBackToTheirVoxels) {
    for (const double scale : {1e-3, 0.03, 1.0, 40.0, 1e3})
        for (const double uneven : {1.0, 100.0, 1e4}) {
            const glm::dmat4 map = affine_from_factors({0.3, -0.2, 0.1}, {33, -21, 57},
                                                       {scale, scale * uneven, scale});
            const GridFrame object{.origin = {-.5, -.5, -.5},
                                   .voxel_edge = glm::dvec3(1.0 / 256),
                                   .size = glm::ivec3(256)};
            GridFrame world{.origin = glm::dvec3(-scale * uneven),
                            .voxel_edge = glm::dvec3(scale * uneven / 500),
                            .size = glm::ivec3(1000)};
            const PlacementMap inverse = placement_map(object, world, map, Reach::none, 0);
            for (int i = 0; i < 200;
                 ++i) {  // voxels of the object are mapped to the world and back
                const glm::dvec3 voxel(i % 7 * 36 + 0.5, i % 11 * 23 + 0.25, i % 13 * 19 + 0.75);
                const glm::dvec3 there(map *
                                       glm::dvec4(object.origin + voxel * object.voxel_edge, 1));
                const glm::dvec3 w = (there - world.origin) / world.voxel_edge;
                for (size_t a = 0; a < 3; ++a) {
                    double back = double(inverse.rows[4 * a + 3]);
                    for (size_t b = 0; b < 3; ++b)
                        back += double(inverse.rows[4 * a + b]) * w[int(b)];
                    back = std::ldexp(back, -inverse.fraction_bits);
                    EXPECT_NEAR(back, voxel[int(a)], 0.01) << scale << " times " << uneven;
                }
            }
        }
}

}  // namespace
}  // namespace voxelume
