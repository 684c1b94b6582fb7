// SPDX-License-Identifier: Apache-2.0
// The order at which refracted rays converge to the analytic ones as voxels get smaller.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "runtime/scene_file/read_scene.hpp"
#include "tests/pictures/glass/refracted_rays.hpp"

namespace voxelume {
namespace {

constexpr double kIor = 1.5;
constexpr uint32_t kWidth = 32, kHeight = 32;

/// A `smooth` ball of radius 0.9 around (0.013, -0.021, 0.017), inside which the whole view lies,
/// up to an incidence of 60 degrees.
Scene ball_scene(double voxel_size) {
    return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": {}, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}}}},
"materials": {{"glass": {{"diffuse": 0, "refraction": 1, "ior": {}}}}},
"models": {{"ball": {{"shape": "sphere", "radius": 0.9, "surface": "smooth"}}}},
"objects": [{{"model": "ball", "material": "glass", "position": [0.013, -0.021, 0.017]}}],
"lights": [],
"observer": {{"position": [1.9, 1.4, 3.1], "look_at": [0.013, -0.021, 0.017],
             "display": {{"shape": "pyramid", "angle": 15.4}}}},
"render": {{"size": [{}, {}]}}}})",
                                   voxel_size, kIor, kWidth, kHeight),
                       "ball.json", {});
}

/// The point and direction with which a ray leaves the unit ball around the origin, by Snell's law
/// at both surfaces.
glm::dvec3 direction_behind_ball(const glm::dvec3& o, const glm::dvec3& d) {
    const auto bend = [](const glm::dvec3& in, const glm::dvec3& n, double ratio) {
        const double cosine = -glm::dot(in, n);
        const double bent = std::sqrt(1 - ratio * ratio * (1 - cosine * cosine));
        return ratio * in + (ratio * cosine - bent) * n;
    };
    const double b = glm::dot(o, d);
    const glm::dvec3 entry = o + d * (-b - std::sqrt(b * b - glm::dot(o, o) + 1));
    const glm::dvec3 inside = bend(d, entry, 1 / kIor);
    const glm::dvec3 exit = entry - inside * (2 * glm::dot(entry, inside));
    return bend(inside, -exit, kIor);
}

/// RMS of the directions' errors, in radians, in a world of `voxels` along each edge.
double direction_error(int voxels) {
    const double voxel_size = 2.0 / voxels;
    RefractedRays rays(ball_scene(voxel_size), kWidth * kHeight);
    const glm::dvec3 center = (glm::dvec3(0.013, -0.021, 0.017) + 1.0) / voxel_size;
    std::vector<glm::dvec3> expected;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i)
        expected.push_back(direction_behind_ball((rays.origin(i) - center) * (voxel_size / 0.9),
                                                 rays.direction(i)));
    rays.refract();
    rays.refract();
    double squares = 0;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
        const glm::dvec3 off = rays.direction(i) - expected[i];
        squares += glm::dot(off, off);
    }
    const double error = std::sqrt(squares / (kWidth * kHeight));
    fmt::print("{} voxels: RMS {:.3g} rad\n", voxels, error);
    return error;
}

TEST(RefractionOrder, TheDirectionBehindASmoothBallConvergesQuadratically) {
    const double slope = std::log2(direction_error(8) / direction_error(32)) / 2;
    fmt::print("slope {:.3f}\n", slope);
    EXPECT_GE(slope, 1.9);
}

TEST(RefractionOrder, TheRoundingOfDistancesIsItsFloor) {
    // 1/8192 voxel gives about 5e-5 rad. The world's bounds, three voxels away, don't add to it.
    EXPECT_LT(direction_error(128), 6e-5);
}

}  // namespace
}  // namespace voxelume
