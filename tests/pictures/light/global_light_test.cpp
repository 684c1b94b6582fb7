// SPDX-License-Identifier: Apache-2.0
// Global light against what is known exactly: furnaces, closed spheres, form factors.
#include "tests/pictures/light/global_light.hpp"

#include <gmock/gmock.h>

#include "runtime/stages/trace/sight.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/golden_hash.hpp"

namespace voxelume {
namespace {

Json json_ball(double radius, const char* surface) {
    Json model = {{"shape", "sphere"}, {"radius", radius}, {"surface", surface}};
    if (std::string(surface) == "cubes") model["set"] = "solid";
    return model;
}

class EverySurface : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(GlobalLight, EverySurface, testing::Values("cubes", "smooth", "exact"));

TEST_P(EverySurface, WhatReturnsAllLightIsInvisibleUnderAWhiteSky) {
    Json scene = open_furnace(16);
    add_thing(scene, json_ball(0.2, GetParam()), "chalk", {0.25, 0.25, 0.1});
    add_thing(scene, json_ball(0.2, GetParam()), "mirror", {-0.25, 0.25, 0.1});
    add_thing(scene, json_ball(0.2, GetParam()), "lacquer", {0.25, -0.25, 0.1});
    // A path inside of veiled cubes is scattered more often than paths are followed.
    if (std::string(GetParam()) != "cubes")
        add_thing(scene, json_ball(0.2, GetParam()), "veil", {-0.25, -0.25, 0.1});
    send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 1, 48);
    const std::vector<SensedRay> rays = sense(scene);
    for (int c = 0; c < 3; ++c)
        expect_mean(estimate_of(channel_of(rays, c)), 1, "channel " + std::to_string(c));
    for (const SensedRay& ray : rays) EXPECT_NEAR(ray.color[0], 1, 1e-5);
}

TEST_P(EverySurface, GlassIsInvisibleUnderAWhiteSky) {
    Json scene = open_furnace(64);
    add_thing(scene, json_ball(0.3, GetParam()), "glass", {0.1, 0.05, 0.1});
    add_thing(scene, json_ball(0.1, GetParam()), "chalk", {-0.35, -0.3, 0.1});
    send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 1, 32);
    const Estimate e = estimate_of(channel_of(sense(scene), 1));
    // Cubes reflect some light totally within for ever, which the limit of bounces takes.
    if (std::string(GetParam()) == "cubes") {
        EXPECT_LE(e.mean, 1 + 3 * e.error);
        EXPECT_GE(e.mean, 0.9);
    } else {
        expect_mean(e, 1, "glass");
    }
}

TEST_P(EverySurface, AClosedRoomThatGivesHalfAndReturnsHalfIsWhite) {
    Json scene = open_furnace(64);
    scene["world"]["background"] = {1e6, 1e6, 1e6};
    scene["materials"]["half"] = {{"color", {0.5, 0.5, 0.5}}, {"emission", {0.5, 0.5, 0.5}}};
    add_thing(scene, json_ball(0.2, GetParam()), "half", {0.1, 0.05, 0.1});
    add_thing(scene, json_ball(0.1, GetParam()), "chalk", {-0.2, -0.15, 0});
    Json room = hollow_sphere(GetParam());
    if (std::string(GetParam()) == "cubes") room["set"] = "solid";
    add_thing(scene, room, "half", {0, 0, 0});
    send_rays(scene, {0, 0, -0.2}, {0, 0, 1}, 0.6, 32);
    expect_mean(estimate_of(channel_of(sense(scene), 2)), 1, "closed room");
}

TEST(GlobalLight, ALightInAClosedSphereIsTheGeometricSeries) {
    // Every point of a sphere sees all others alike. A light of intensity I in the middle gives
    // I/R^2, and each bounce adds the albedo's share of it.
    constexpr double kAlbedo = 0.75, kRadius = 0.5, kIntensity = 0.125;
    for (const int bounces : {0, 1, 2, 7}) {
        Json scene = open_furnace(16);
        scene["materials"]["wall"] = {{"color", {kAlbedo, kAlbedo, kAlbedo}}};
        scene["lights"] = {{{"type", "point"}, {"position", {0, 0, 0}}, {"intensity", kIntensity}}};
        scene["render"]["bounces"] = bounces;
        add_thing(scene, hollow_sphere("exact"), "wall", {0, 0, 0});
        send_rays(scene, {0, 0, -0.2}, {0, 0, 1}, 0.6, 32);
        double expected = 0;
        for (int k = 1; k <= bounces + 1; ++k)
            expected += kIntensity / (kRadius * kRadius) * std::pow(kAlbedo, k);
        expect_mean(estimate_of(channel_of(sense(scene), 0)), expected,
                    std::to_string(bounces) + " bounces");
    }
}

constexpr double kWidth = 2e-5;  ///< how far off the middle pixels change the light at most

/// A white floor at y = 0 and what lights it, seen from above in its middle 2 mm.
Json lit_floor(int samples) {
    Json scene = open_furnace(samples);
    scene["world"]["background"] = {0, 0, 0};
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "chalk",
              {0, -0.05, 0});
    scene["observer"]["position"] = {0, 0.1, 0};
    scene["observer"]["turn"] = {0, 90, 0};
    scene["observer"]["display"]["size"] = {0.002, 0.002, 9};
    scene["render"]["size"] = {32, 32};
    scene["render"]["bounces"] = 1;
    return scene;
}

TEST(GlobalLight, AnEmissiveDiskLightsTheFloorBelowByItsFormFactor) {
    // A disk of radius r and radiance L at height h: L r^2 / (r^2 + h^2) in the middle.
    Json scene = lit_floor(256);
    scene["materials"]["lamp"] = {{"color", {0, 0, 0}}, {"emission", {3, 3, 3}}};
    add_thing(scene,
              {{"shape", "cylinder"}, {"radius", 0.2}, {"height", 0.1}, {"surface", "exact"}},
              "lamp", {0, 0.35, 0});
    expect_mean(estimate_of(channel_of(sense(scene), 0)), 3 * 0.04 / (0.04 + 0.09), "emission",
                kWidth);
    // A disk light of the same power that isn't seen, at the height of the emissive box's
    // underside.
    scene["materials"]["lamp"]["emission"] = {0, 0, 0};
    scene["objects"][1]["visible"] = false;
    const double area = std::numbers::pi * 0.04;
    scene["lights"] = {{{"type", "disk"},
                        {"position", {0, 0.3, 0}},
                        {"direction", {0, -1, 0}},
                        {"radius", 0.2},
                        {"intensity", 3 * area / std::numbers::pi}}};
    expect_mean(estimate_of(channel_of(sense(scene), 0)), 3 * 0.04 / (0.04 + 0.09), "disk light",
                kWidth);
}

TEST(GlobalLight, ARectangleLightsTheFloorBelowByItsFormFactor) {
    // A quarter of a rectangle a x b at height h: atan(A) ... as in Howell's catalogue, B-3.
    Json scene = lit_floor(256);
    scene["lights"] = {{{"type", "rectangle"},
                        {"position", {0, 0.3, 0}},
                        {"direction", {0, -1, 0}},
                        {"up", {0, 0, 1}},
                        {"size", {0.4, 0.6}},
                        {"intensity", 3 * 0.24 / std::numbers::pi}}};
    const double a = 0.2 / 0.3, b = 0.3 / 0.3;
    const double root_a = std::sqrt(1 + a * a), root_b = std::sqrt(1 + b * b);
    const double quarter =
        (a / root_a * std::atan(b / root_a) + b / root_b * std::atan(a / root_b)) /
        (2 * std::numbers::pi);
    expect_mean(estimate_of(channel_of(sense(scene), 0)), 3 * 4 * quarter, "rectangle light",
                kWidth);
}

/// The error of a pixel with `samples` of a floor that a big emissive box lights, as a root mean
/// square.
double floor_error(int samples) {
    Json scene = lit_floor(samples);
    scene["materials"]["lamp"] = {{"color", {0, 0, 0}}, {"emission", {3, 3, 3}}};
    add_thing(scene,
              {{"shape", "cylinder"}, {"radius", 0.4}, {"height", 0.1}, {"surface", "exact"}},
              "lamp", {0, 0.35, 0});
    const double expected = 3 * 0.16 / (0.16 + 0.09);
    double square = 0;
    const std::vector<double> values = channel_of(sense(scene), 0);
    for (const double v : values) square += (v - expected) * (v - expected);
    return std::sqrt(square / double(values.size())) / expected;
}

TEST(GlobalLight, TheErrorFallsAtLeastWithTheRootOfTheSamples) {
    const double of_4 = floor_error(4), of_64 = floor_error(64), of_1024 = floor_error(1024);
    fmt::print(
        "relative error of a pixel: {:.4f} with 4 samples, {:.4f} with 64, {:.4f} with 1024\n",
        of_4, of_64, of_1024);
    EXPECT_LT(of_64, of_4 / 4);
    EXPECT_LT(of_1024, of_64 / 4);
}

TEST(GlobalLight, WithoutBouncesIsTheDirectLightOfLocalLight) {
    Json scene = sensor_room(0.05);
    scene["materials"]["wall"] = {{"color", {1, 0.5, 0.25}}, {"specular", 0.5}};
    scene["lights"].push_back(
        {{"type", "spot"}, {"position", {0, 0.4, 0}}, {"direction", {0, -1, 0.3}}});
    scene["lights"].push_back(
        {{"type", "directional"}, {"direction", {0.3, -1, 0.2}}, {"intensity", 0.5}});
    scene["render"]["shadows"] = true;
    add_thing(scene, json_ball(0.2, "smooth"), "wall", {0.1, 0.05, 0.1});
    add_thing(scene, json_ball(0.15, "cubes"), "wall", {-0.2, 0.05, 0.1});
    send_rays(scene, {0, 0, -0.47}, {0, 0, 1}, 0.9, 32);
    const std::vector<SensedRay> local = sense(scene);
    scene["render"]["light"] = "global";
    scene["render"]["bounces"] = 0;
    const std::vector<SensedRay> global = sense(scene);
    ASSERT_EQ(local.size(), global.size());
    for (size_t i = 0; i < local.size(); ++i) EXPECT_EQ(local[i].color, global[i].color) << i;
}

/// Everything that global light treats specially, in 15 x 10 pixels.
Json mixed_scene() {
    Json scene = open_furnace(5);
    scene["world"]["background"] = {0.5, 0.75, 1};
    scene["world"]["medium"] = {{"absorption", {0.2, 0.1, 0.3}}, {"color", {0.5, 0.5, 0.5}}};
    scene["materials"]["glass"]["absorption"] = {0.5, 1, 2};
    scene["materials"]["lamp"] = {{"color", {0, 0, 0}}, {"emission", {3, 2, 1}}};
    scene["render"]["bounces"] = 6;
    scene["render"]["shadow"] = "filtered";
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "lacquer",
              {0, -0.4, 0});
    add_thing(scene, json_ball(0.2, "smooth"), "glass", {0.25, 0.05, 0.1});
    add_thing(scene, json_ball(0.15, "cubes"), "veil", {-0.2, 0, 0});
    add_thing(scene, json_ball(0.1, "exact"), "lamp", {-0.2, 0.35, 0.1});
    add_thing(scene, json_ball(0.12, "exact"), "chalk", {0, -0.2, -0.2},
              {{"placement", "instance"}});
    scene["lights"] = {{{"type", "rectangle"},
                        {"position", {0.2, 0.5, -0.3}},
                        {"direction", {0, -1, 0.3}},
                        {"size", {0.3, 0.2}}},
                       {{"type", "point"}, {"position", {-0.4, 0.4, -0.4}}, {"intensity", 0.1}}};
    send_rays(scene, {0.1, 0.2, -0.55}, {-0.1, -0.3, 1}, 1, 15);
    scene["render"]["size"] = {15, 10};
    return scene;
}

TEST(GlobalLight, HasTheSameBitsOnAnyNumberOfLanes) {
    const Scene scene = parse_scene(mixed_scene().dump(), "mixed", {});
    for (const int lanes : lanes_with_all()) {
        RenderReport report;
        const Image image = render(test_device(lanes), scene, report);
        EXPECT_EQ(report.not_finite, 0u);
        expect_golden("global/mixed", oracle::image_hash(image));
    }
}

TEST(GlobalLight, HasTheSameBitsInAnyTiles) {
    // Tiles that are rendered alone have the pixels that they have in the whole image.
    const Scene scene = parse_scene(mixed_scene().dump(), "mixed", {});
    const Device device = test_device();
    RenderReport report;
    const BuiltWorld world = WorldBuilder(device, false, AssetStore()).build(scene, report.world);
    Renderer renderer(device, false);
    const Image whole = renderer.new_image(scene, world, report, {});
    TileShare share(tile_count(15, 10), {});
    for (int part = 0; part < 3; ++part) share.take(1);
    std::vector<TileRange> taken;
    const Image rest = renderer.part_of_image(scene, world, report, {share, taken});
    for (int row = 4; row < 10; ++row)
        for (int column = 0; column < 15; ++column)
            EXPECT_EQ(whole.planes.at("G")[size_t(row * 15 + column)],
                      rest.planes.at("G")[size_t(row * 15 + column)])
                << column << ", " << row;
}

}  // namespace
}  // namespace voxelume
