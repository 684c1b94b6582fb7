// SPDX-License-Identifier: Apache-2.0
// Media that scatter light, against integrals of the light that is scattered once, and in white
// surroundings, where nothing may be seen.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "runtime/analysis/scene_features.hpp"
#include "runtime/scene/predicates.hpp"
#include "tests/pictures/light/medium_cube.hpp"

namespace voxelume {
namespace {

Json directional(const glm::dvec3& way, double intensity) {
    return Json::array({{{"type", "directional"},
                         {"direction", {way.x, way.y, way.z}},
                         {"intensity", intensity}}});
}

struct Once {
    glm::dvec3 scattering, absorption;
    double anisotropy;
    glm::dvec3 way;  ///< of the light
};

class ScatteredOnce : public testing::TestWithParam<Once> {};

/// The light comes from above, in front, or both, to the line of sight y = 0.1875.
TEST_P(ScatteredOnce, FollowsTheIntegralInEachColour) {
    const auto [scattering, absorption, g, way] = GetParam();
    const auto json_of = [](const glm::dvec3& v) { return Json{v.x, v.y, v.z}; };
    const Image image = image_of_medium(cube_of_medium({{"scattering", json_of(scattering)},
                                                        {"absorption", json_of(absorption)},
                                                        {"anisotropy", g}},
                                                       directional(way, 2), 0, 256));
    const double to_viewer = phase(g, glm::dot(glm::normalize(way), glm::dvec3(0, 0, 1)));
    constexpr const char* kChannels[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        const double extinction = scattering[c] + absorption[c];
        double sum = 0;
        constexpr int kSteps = 4000;
        for (int i = 0; i < kSteps; ++i) {
            const double z = 1 - 2 * (i + 0.5) / kSteps;
            const glm::dvec3 back = -glm::normalize(way);
            double metres = 0.8125 / back.y;
            if (back.z > 0) metres = std::min(metres, (1 - z) / back.z);
            if (back.z < 0) metres = std::min(metres, (1 + z) / -back.z);
            sum += std::exp(-extinction * (1 - z + metres)) * 2 / kSteps;
        }
        const double expected = scattering[c] * sum * to_viewer * std::numbers::pi * 2;
        expect_mean(estimate_of_channel(image, kChannels[c]), expected, kChannels[c]);
    }
}

INSTANTIATE_TEST_SUITE_P(Media, ScatteredOnce,
                         testing::Values(Once{{1, 1, 1}, {0, 0, 0}, 0, {0, -1, 0}},
                                         Once{{1.5, 0.7, 3}, {0.4, 0.2, 0}, 0.6, {0, -1, 0}},
                                         Once{{0, 2, 0.5}, {1, 1, 1}, -0.8, {0, -0.6, -0.8}},
                                         Once{{1, 1, 1}, {0.5, 0.5, 0.5}, 0.9, {0, -0.28, 0.96}}));

/// Voxels have the density at their middles, and the sight ray and the light pass along rows of
/// them, so that the integral is a sum over voxels.
TEST(Scattering, FollowsTheDensityOfEachVoxel) {
    const Json medium = {
        {"scattering", {2, 2, 2}},
        {"absorption", {0.5, 0.5, 0.5}},
        {"anisotropy", 0.25},
        {"density", {{"kind", "ball"}, {"center", {0, 0, 0}}, {"radius", 0.8}, {"falloff", 0.5}}}};
    const Image image = image_of_medium(cube_of_medium(medium, directional({0, -1, 0}, 3), 0, 256));
    constexpr double kEdge = 0.125, kX = 0.0625, kY = 0.1875;
    const auto density = [](double y, double z) {
        const double distance = std::sqrt(kX * kX + y * y + z * z);
        const double s = std::clamp((0.8 - distance) / 0.5, 0.0, 1.0);
        return s * s * (3 - 2 * s);
    };
    double seen = 0, before = 0;
    for (int k = 0; k < 16; ++k) {
        const double z = 1 - (k + 0.5) * kEdge;
        double above = density(kY, z) * kEdge / 2;  // the line is in the middle of its voxels
        for (double y = kY + kEdge; y < 1; y += kEdge) above += density(y, z) * kEdge;
        const double own = 2.5 * density(kY, z) * kEdge;
        seen += std::exp(-2.5 * (above + before)) * (1 - std::exp(-own)) * 0.8;
        before += density(kY, z) * kEdge;
    }
    expect_mean(estimate_of_channel(image, "R"), seen * phase(0.25, 0) * std::numbers::pi * 3,
                "ball");
}

/// A disk of radius 0.8 m that shines down from 0.7 m above the cube: the mean over its points of
/// cosine / distance^2, integrated along the line of sight.
TEST(Scattering, SeesLightsWithAnArea) {
    constexpr double kRadius = 0.8, kHeight = 1.7, kIntensity = 2, kG = 0.3, kExtinction = 1.5;
    const Json disk = Json::array({{{"type", "disk"},
                                    {"position", {0.0625, kHeight, 0}},
                                    {"direction", {0, -1, 0}},
                                    {"radius", kRadius},
                                    {"intensity", kIntensity}}});
    const Image image = image_of_medium(cube_of_medium(
        {{"scattering", {1, 1, 1}}, {"absorption", {0.5, 0.5, 0.5}}, {"anisotropy", kG}}, disk, 0,
        256));
    constexpr int kSteps = 200, kRings = 40, kTurns = 80;
    double sum = 0;
    for (int i = 0; i < kSteps * kRings * kTurns; ++i) {
        const double z = 1 - 2 * (i % kSteps + 0.5) / kSteps;
        const double radius = kRadius * std::sqrt((i / kSteps % kRings + 0.5) / kRings);
        const double angle = 2 * std::numbers::pi * (i / kSteps / kRings + 0.5) / kTurns;
        const glm::dvec3 to(radius * std::cos(angle), kHeight - 0.1875,
                            radius * std::sin(angle) - z);
        // The way out of the cube is by the side that comes first.
        double part = 0.8125 / to.y;
        if (to.x != 0) part = std::min(part, (to.x > 0 ? 0.9375 : -1.0625) / to.x);
        if (to.z != 0) part = std::min(part, (to.z > 0 ? 1 - z : -1 - z) / to.z);
        const double distance = glm::length(to);
        sum += std::exp(-kExtinction * (1 - z + distance * part)) * phase(kG, -to.z / distance) *
               to.y / distance / (distance * distance);
    }
    // The middle rule is off by less than 2e-5 with these steps.
    expect_mean(estimate_of_channel(image, "R"),
                sum / kRings / kTurns * 2 / kSteps * std::numbers::pi * kIntensity, "disk", 2e-5);
}

/// White surroundings of radiance 1 stay white, whatever scatters their light.
TEST(Scattering, IsNotSeenInAWhiteFurnace) {
    for (const double g : {0.0, 0.7, -0.4}) {
        Json scene = open_furnace(16);
        scene["world"]["medium"] = {{"scattering", {3, 2, 1}}, {"anisotropy", g}};
        add_thing(scene, {{"shape", "sphere"}, {"radius", 0.2}}, "chalk", {-0.2, 0, 0.1});
        add_thing(scene, {{"shape", "sphere"}, {"radius", 0.15}}, "glass", {0.2, 0.1, 0});
        add_thing(scene, {{"shape", "box"}, {"size", {0.3, 0.1, 0.2}}, {"surface", "exact"}},
                  "veil", {0.2, -0.2, 0}, {{"placement", "instance"}});
        send_rays(scene, {0, 0, -0.55}, {0.05, 0.1, 1}, 0.8, 36);
        for (int channel = 0; channel < 3; ++channel)
            expect_mean(estimate_of(channel_of(sense(scene), channel)), 1,
                        fmt::format("anisotropy {}, channel {}", g, channel));
    }
}

/// A medium whose own radiance is that of its surroundings, 1, is not seen either, though it
/// absorbs light and scatters colours differently.
TEST(Scattering, WeighsTheMediumsOwnLight) {
    Json scene = cube_of_medium(
        {{"scattering", {0.1, 0.2, 0.8}}, {"absorption", {0.3, 0.3, 0.3}}, {"color", {1, 1, 1}}},
        Json::array(), 16, 256);
    scene["world"]["background"] = {1, 1, 1};
    const Image image = image_of_medium(scene);
    for (const char* channel : {"R", "G", "B"})
        expect_mean(estimate_of_channel(image, channel), 1, channel);
}

/// Emissive objects in mist, found by rays that are sent to them, by paths that run into them, or
/// by both.
TEST(Scattering, FindsEmittersByAllWays) {
    std::array<Estimate, 3> found;
    constexpr const char* kWays[] = {"both", "rays", "paths"};
    for (size_t i = 0; i < 3; ++i) {
        Json scene =
            cube_of_medium({{"scattering", {1, 1, 1}}, {"anisotropy", 0.4}}, Json::array(), 4, 256);
        scene["materials"] = {{"lamp", {{"diffuse", 0}, {"emission", {5, 5, 5}}}}};
        scene["render"]["emitters"] = kWays[i];
        add_thing(scene, {{"shape", "sphere"}, {"radius", 0.4}, {"surface", "cubes"}}, "lamp",
                  {0, -0.5, 0});
        found[i] = estimate_of_channel(image_of_medium(scene), "R");
        fmt::print("{}: {:.5f} +- {:.5f}\n", kWays[i], found[i].mean, found[i].error);
    }
    for (size_t i = 1; i < 3; ++i)
        EXPECT_NEAR(found[i].mean, found[0].mean, 3 * (found[i].error + found[0].error));
}

/// Fog before nothing isn't coverage, whether or not some material lets light through.
TEST(Scattering, CoversNothing) {
    Json scene = cube_of_medium({{"scattering", {3, 3, 3}}}, directional({0, -1, 0}, 1), 1, 4);
    scene["materials"] = {{"veil", {{"opacity", 0.5}}}, {"matt", Json::object()}};
    scene["render"]["transparent"] = true;
    for (const char* material : {"matt", "veil"}) {
        Json with = scene;
        add_thing(with, {{"shape", "sphere"}, {"radius", 0.2}}, material, {0.5, 0.5, 0.5});
        EXPECT_EQ(estimate_of_channel(image_of_medium(with), "A").mean, 0) << material;
    }
}

TEST(Scattering, HasTheSameBitsForAllLanes) {
    Json scene = open_furnace(4);
    scene["world"]["medium"] = {
        {"scattering", {3, 2, 1}},
        {"anisotropy", 0.3},
        {"density", {{"kind", "height"}, {"base", -0.2}, {"scale_height", 0.3}}}};
    scene["materials"]["lamp"] = {{"emission", {4, 3, 2}}};
    scene["lights"] = directional({0.3, -1, 0.2}, 2);
    scene["lights"].push_back({{"type", "point"}, {"position", {0, 0.4, 0}}, {"intensity", 0.5}});
    scene["render"]["shadow"] = "filtered";  // rays end after different numbers of surfaces
    add_thing(scene, {{"shape", "sphere"}, {"radius", 0.2}}, "glass", {-0.2, 0, 0.1});
    add_thing(scene, {{"shape", "sphere"}, {"radius", 0.15}}, "lamp", {0.2, 0.1, 0});
    add_thing(scene, {{"shape", "box"}, {"size", {0.3, 0.1, 0.2}}, {"surface", "cubes"}}, "chalk",
              {0.2, -0.2, 0}, {{"placement", "instance"}});
    send_rays(scene, {0, 0, -0.55}, {0.05, 0.1, 1}, 0.8, 10);
    const Image image = image_of_medium(scene);
    for (const int lanes : {1, 4, 16})
        EXPECT_TRUE(image_of_medium(scene, lanes).planes == image.planes);
}

TEST(Scattering, CostsNothingWhereItIsNotFollowed) {
    const auto features = [](const Json& json) {
        const Scene scene = parse_scene(json.dump(), "medium", {});
        Pyramid world;
        return features_of(scene, world);
    };
    Json scene = cube_of_medium({{"scattering", {1, 1, 1}}}, Json::array(), 4, 1);
    EXPECT_TRUE(features(scene).scattering);
    EXPECT_TRUE(features(scene).medium);
    scene["render"]["light"] = "local";
    EXPECT_FALSE(features(scene).scattering);
    EXPECT_FALSE(features(scene).medium);
    scene["render"]["light"] = "global";
    scene["world"]["medium"]["scattering"] = {0, 0, 0};
    EXPECT_FALSE(features(scene).scattering);
}

}  // namespace
}  // namespace voxelume
