// SPDX-License-Identifier: Apache-2.0
// Light that mirrors and glass pass on is neither lost nor created. Cases O7 and O11.
#include <fmt/format.h>

#include <algorithm>

#include "tests/pictures/light/sensor_room.hpp"

namespace voxelume {
namespace {

/// O7: a corridor 0.1 m wide between two mirrors, which reflect 31/32 of the light.
Json corridor(const char* surface, int depth) {
    Json scene = sensor_room();
    scene["materials"]["mirror"] = {{"diffuse", 0}, {"reflection", 0.96875}};
    const Json mirror = {{"shape", "box"}, {"size", {0.7, 0.2, 1.4}}, {"surface", surface}};
    add_thing(scene, mirror, "mirror", {0, 0.15, 0});
    add_thing(scene, mirror, "mirror", {0, -0.15, 0});
    send_rays(scene, {0.05, 0.003, -0.45}, {0.1, 5.3, 1}, 0.07, 24);
    scene["render"]["depth"] = depth;
    return scene;
}

class Corridor : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(Corridor, O7FiftyReflectionsEndWhereTheUnfoldedRayDoes) {
    constexpr double kWidth = 0.1;
    const auto& [surface, bound] = GetParam();
    size_t shown = 0, ended = 0;
    int maximum = 0;
    double worst = 0, worst_excess = 0;
    for (const SensedRay& ray : sense(corridor(surface, 50))) {
        const glm::dvec3 unfolded =
            ray.origin + ray.direction * ((kWall - ray.origin.z) / ray.direction.z);
        const double storey = std::floor(unfolded.y / kWidth + 0.5);
        if (std::abs(std::abs(unfolded.y / kWidth - storey) - 0.5) < 10 * bound) continue;
        const int reflections = int(std::abs(storey));
        if (reflections > 50) {
            ++ended;
            EXPECT_EQ(ray.color, glm::dvec3(0)) << reflections << " reflections";
            continue;
        }
        ++shown;
        maximum = std::max(maximum, reflections);
        const double y = unfolded.y - storey * kWidth;
        const WallPoint end{{unfolded.x, reflections % 2 ? -y : y, kWall}, 2};
        const Reading reading = read_color(ray.color / std::pow(0.96875, reflections), end);
        worst = std::max(worst, glm::length(reading.position - end.position));
        worst_excess = std::max(worst_excess, std::abs(reading.excess - 1));
    }
    fmt::print("{}: {} rays with up to {} reflections, off by {:.2g} m at most, light by {:.2g}\n",
               surface, shown, maximum, worst, worst_excess);
    EXPECT_EQ(maximum, 50);
    EXPECT_GT(shown, 100u);
    EXPECT_GT(ended, 20u);
    EXPECT_LE(worst, bound);
    EXPECT_LE(worst_excess, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Mirrors, Corridor,
                         testing::Values(std::pair("exact", 50 * 1e-6),
                                         std::pair("smooth", 50 * 1e-6)),
                         [](const auto& way) { return std::string(way.param.first); });

/// O11: a closed room whose walls send out 1 in all directions, without lights.
Json furnace(int depth) {
    Json scene = sensor_room(0.02);
    scene["lights"] = Json::array();
    scene["world"]["ambient"] = {1, 1, 1};
    scene["materials"] = {
        {"wall", {{"diffuse", 0}, {"emission", {1, 1, 1}}}},
        {"glass",
         {{"diffuse", 0}, {"reflection", 1}, {"refraction", 1}, {"fresnel", true}, {"ior", 1.5}}},
        {"matt", {{"color", {1, 1, 1}}, {"diffuse", 0.625}, {"reflection", 0.375}}},
        {"veil", {{"color", {1, 1, 1}}, {"diffuse", 1}, {"opacity", 0.375}}}};
    scene["objects"][0]["spots"] = 0;
    scene["render"]["depth"] = depth;
    return scene;
}

Json ball(double radius, const char* surface) {
    return {{"shape", "sphere"}, {"radius", radius}, {"surface", surface}};
}

/// The largest differences of a furnace's image from 1.
struct Furnace {
    double above = 0, below = 0, mean_below = 0;
};

Furnace heat(const Json& scene) {
    Furnace f;
    const std::vector<SensedRay> rays = sense(scene);
    for (const SensedRay& ray : rays)
        for (int c = 0; c < 3; ++c) {
            f.above = std::max(f.above, ray.color[c] - 1);
            f.below = std::max(f.below, 1 - ray.color[c]);
            f.mean_below += (1 - ray.color[c]) / double(3 * rays.size());
        }
    fmt::print("above 1 by {:.2g}, below by {:.2g}, {:.2g} on average\n", f.above, f.below,
               f.mean_below);
    return f;
}

class BothSurfaces : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Energy, BothSurfaces, testing::Values("exact", "smooth"));

TEST_P(BothSurfaces, O11WhatReturnsAllLightIsInvisibleInAWhiteFurnace) {
    Json scene = furnace(64);
    add_thing(scene, ball(0.2, GetParam()), "matt", {0.1, 0.05, 0.1});
    add_thing(scene, {{"shape", "torus"}, {"radius", 0.2}, {"tube", 0.07}, {"surface", GetParam()}},
              "matt", {-0.2, -0.1, 0}, {{"turn", {20, 50, 10}}});
    add_thing(scene, ball(0.1, GetParam()), "veil", {0.05, -0.1, -0.25});
    send_rays(scene, {0, 0, -0.47}, {0, 0, 1}, 0.8, 64);
    const Furnace f = heat(scene);
    EXPECT_LE(f.above, 1e-6);
    EXPECT_LE(f.below, 1e-6);
}

TEST_P(BothSurfaces, O11GlassInAWhiteFurnaceLosesOnlyPathsThatEnd) {
    // The scene has balls, because rings of glass keep some rays inside for ever by total
    // reflection. Between two balls paths multiply without end, so small weights end them.
    Json scene = furnace(64);
    scene["render"]["least_weight"] = 1e-5;
    add_thing(scene, ball(0.2, GetParam()), "glass", {0.1, 0.05, 0.15});
    add_thing(scene, ball(0.12, GetParam()), "glass", {-0.15, -0.1, -0.1});
    send_rays(scene, {0, 0, -0.47}, {0, 0, 1}, 0.8, 48);
    const Furnace f = heat(scene);
    EXPECT_LE(f.above, 1e-6);
    EXPECT_LE(
        f.below,
        1e-2);  // at grazing angles; for one ball (1-R) R^63 < 0.006 is beyond the depth limit
    EXPECT_LE(f.mean_below, 1e-5);
}

/// The reflectance of glass in air, as the mean of the fluxes of both polarisations.
double reflectance(double incidence, double ior) {
    const double within = std::asin(std::sin(incidence) / ior);
    const double rs = std::sin(incidence - within) / std::sin(incidence + within);
    const double rp = std::tan(incidence - within) / std::tan(incidence + within);
    return (rs * rs + rp * rp) / 2;
}

TEST(Energy, O11ADepthLimitTakesFromABallOfGlassWhatTheSeriesSays) {
    // Each meeting with the ball reflects R. The whole is R + (1-R)^2 (1 + R + ...); the depth
    // limit n keeps 1 - (1-R) R^(n-1) of it.
    const glm::dvec3 center(0.017, -0.028, 0.05);
    for (const int depth : {2, 3, 6}) {
        Json scene = furnace(depth);
        add_thing(scene, ball(0.3, "exact"), "glass", center);
        send_rays(scene, {0.01, 0.02, -0.47}, {0, 0, 1}, 0.62, 64);
        size_t met = 0;
        for (const SensedRay& ray : sense(scene)) {
            const double b = glm::length(glm::cross(ray.origin - center, ray.direction)) / 0.3;
            double expected = 1;
            if (b > 0.999 && b < 1.001) continue;
            if (b < 0.999) {
                ++met;
                const double r = reflectance(std::asin(std::max(b, 1e-4)), 1.5);
                expected = 1 - (1 - r) * std::pow(r, depth - 1);
            }
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(ray.color[c], expected, b < 0.99 ? 3e-6 : 3e-5)
                    << "depth " << depth << ", " << b << " beside the axis";
        }
        EXPECT_GT(met, 1000u);
    }
}

}  // namespace
}  // namespace voxelume
