// SPDX-License-Identifier: Apache-2.0
// Parts of an image's light: they add up to it, and each is what a scene with that part alone
// shows.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "runtime/render/light_passes.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/array_writer.hpp"
#include "tests/world/light_passes_fixture.hpp"

namespace voxelume {
namespace {

TEST_F(LightPasses, GroupsOfLightsAddUpToTheImageInLocalAndInGlobalLight) {
    for (const LightMode mode : {LightMode::local, LightMode::global}) {
        Scene scene = stage();
        scene.render.light = mode;
        ImageChannels channels = kColor;
        channels.light_groups = true;
        const Image image = shown(scene, channels);
        ASSERT_EQ(image.planes.size(), 4u + 3 * 3);
        EXPECT_EQ(image.planes.at("R"), shown(scene, kColor).planes.at("R"));
        double key = 0, fill = 0;
        for (const char* color : kColors)
            for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
                float sum = 0;
                for (const char* group : {"light_key", "light_fill", "light_rest"})
                    sum += value(image, group, color, i);
                const float all = image.planes.at(color)[i];
                ASSERT_NEAR(sum, all, 1e-4f * std::max(all, 1.0f)) << color << i;
                key += double(value(image, "light_key", color, i));
                fill += double(value(image, "light_fill", color, i));
            }
        EXPECT_GT(key, 20);
        EXPECT_GT(fill, 5);
    }
}

/// Scans that no light brings out are in the rest alone; those that the lights do, in each group.
TEST_F(LightPasses, GroupsOfLightsAddUpToTheImageOfScansAndOfAScatteringMedium) {
    std::string path = (std::filesystem::temp_directory_path() / "voxelume-XXXXXX.npy").string();
    const int file = mkstemps(path.data(), 4);
    ASSERT_GE(file, 0);
    close(file);
    const std::vector<float> values = {0, 1, 1, 2, 1, 2, 2, 3};
    put_bytes(path, npy_bytes("<f4", "2, 2, 2", bytes_of_values(values)));
    Scene scene = stage();
    scene.render.light = LightMode::global;
    scene.render.bounces = 2;
    scene.world.medium.scattering = {0.3f, 0.1f, 0.2f};
    GridDensity scan;
    scan.file = path;
    scan.transfer = {{0, 0, {1, 1, 1}}, {3, 2, {0.9f, 0.5f, 0.3f}}};
    GridDensity lit = scan;
    lit.is_lit_by_scene = true;
    scan.others = {lit};
    scene.world.medium.density = scan;
    ImageChannels channels = kColor;
    channels.light_groups = true;
    const Image image = shown(scene, channels);
    std::filesystem::remove(path);
    for (const char* color : kColors)
        for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
            const float all = image.planes.at(color)[i];
            const float sum = value(image, "light_key", color, i) +
                              value(image, "light_fill", color, i) +
                              value(image, "light_rest", color, i);
            ASSERT_NEAR(sum, all, 1e-4f * std::max(all, 1.0f)) << color << i;
        }
}

TEST_F(LightPasses, AGroupIsWhatASceneWithItsLightsAloneShows) {
    Scene scene = stage(), alone = stage();
    ImageChannels channels = kColor;
    channels.light_groups = true;
    alone.lights = {alone.lights[1]};
    alone.world.ambient = alone.world.medium.color = glm::vec3(0);
    alone.world.sky.reset();
    alone.materials.back().emission = glm::vec3(0);
    const Image image = shown(scene, channels), expected = shown(alone, kColor);
    for (const char* color : kColors)
        EXPECT_EQ(image.planes.at(std::string("light_fill.") + color), expected.planes.at(color));
}

TEST_F(LightPasses, DirectAndIndirectLightAddUpToTheImage) {
    for (const LightMode mode : {LightMode::local, LightMode::global}) {
        Scene scene = stage();
        scene.render.light = mode;
        ImageChannels channels = kColor;
        channels.direct = channels.indirect = true;
        const Image image = shown(scene, channels);
        double indirect = 0;
        for (const char* color : kColors)
            for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
                ASSERT_FLOAT_EQ(
                    value(image, "direct", color, i) + value(image, "indirect", color, i),
                    image.planes.at(color)[i]);
                indirect += double(value(image, "indirect", color, i));
            }
        EXPECT_GT(indirect, 10);
        channels = {false, false, false, false, false};
        channels.indirect = true;
        const Image bare = shown(scene, channels);
        ASSERT_EQ(bare.planes.size(), 3u);
        EXPECT_EQ(bare.planes.at("indirect.G"), image.planes.at("indirect.G"));
    }
}

/// A floor under a sky and an emissive ball, and another ball that hides a part of both.
Scene overcast(const std::string& ball) {
    return parse_scene(R"({"voxelume": 1,
        "world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
                  "sky": {"kind": "constant", "color": [0.4, 0.5, 0.6]}},
        "materials": {"ball": )" +
                           ball + R"(, "lamp": {"diffuse": 0, "emission": [9, 6, 3]},
                      "floor": {"color": [0.8, 0.7, 0.6]}},
        "models": {"floor": {"shape": "box", "size": [2, 0.2, 2], "surface": "exact"},
                   "ball": {"shape": "sphere", "radius": 0.3, "surface": "exact"}},
        "objects": [{"model": "floor", "material": "floor", "position": [0, -0.9, 0]},
                    {"model": "ball", "material": "ball", "position": [-0.4, -0.5, 0]},
                    {"model": "ball", "material": "lamp", "position": [0.5, -0.3, 0]}],
        "lights": [{"type": "point", "position": [0, 0.9, 0.5], "intensity": 0.4}],
        "observer": {"position": [0, 0.6, 3], "look_at": [0, -0.5, 0],
                     "display": {"shape": "pyramid", "angle": 40}},
        "render": {"size": [32, 24], "samples": 16, "light": "global"}})",
                       "overcast.json", {});
}

TEST_F(LightPasses, DirectLightIsThatOfAllThatShinesWhateverOtherThingsReflect) {
    ImageChannels channels{true, false, false, false, true};
    channels.direct = channels.indirect = true;
    const Image dark = shown(overcast(R"({"color": [0.001, 0.001, 0.001]})"), channels);
    const Image bright = shown(overcast(R"({"color": [0.9, 0.9, 0.9]})"), channels);
    // No sample of these pixels shows anything but the floor.
    const auto& objects = dark.id_planes.at("objectId");
    const auto shows_floor = [&](size_t pixel) {
        const auto width = size_t(dark.width);
        if (pixel < width || pixel + width >= objects.size()) return false;
        for (const size_t row : {pixel - width, pixel, pixel + width})
            for (const size_t i : {row - 1, row, row + 1})
                if (i >= objects.size() || objects[i] != 1) return false;
        return true;
    };
    double sum = 0, returned = 0;
    for (const char* color : kColors)
        for (size_t i = 0; i < objects.size(); ++i) {
            if (!shows_floor(i)) continue;
            // Only the ball sends indirect light to the floor: a thousandth of what falls on the
            // ball, which next to the emissive object is several times what falls on the floor.
            const float all = dark.planes.at(color)[i];
            EXPECT_NEAR(value(dark, "direct", color, i), all, 1e-2f * all) << color << i;
            EXPECT_EQ(value(dark, "direct", color, i), value(bright, "direct", color, i))
                << color << i;
            EXPECT_GE(value(bright, "indirect", color, i), -1e-6f);
            sum += double(all);
            returned += double(value(bright, "indirect", color, i));
        }
    EXPECT_GT(sum, 100);
    EXPECT_GT(returned, 0.02 * sum);
}

TEST_F(LightPasses, IndirectLightOfFrostedGlassIsNeverNegative) {
    ImageChannels channels = kColor;
    channels.indirect = true;
    Scene scene = overcast(R"({"base_color": [1, 1, 1], "transmission": 1, "roughness": 0.3})");
    for (int step = 0; step < 2; ++step) {
        const Image image = shown(scene, channels);
        for (const char* color : kColors)
            for (const float rest : image.planes.at(std::string("indirect.") + color))
                ASSERT_GE(rest, -1e-5f);
        // Then no path runs into what shines, and direct light needs no bounces.
        scene.world.sky.reset();
        scene.objects.pop_back();
    }
}

TEST_F(LightPasses, AlbedoIsTheColorOfTheSurface) {
    Scene scene = stage();
    scene.render.samples = 1;
    ImageChannels channels{false, false, false, false, true};
    channels.albedo = true;
    const Image image = shown(scene, channels);
    const auto& objects = image.id_planes.at("objectId");
    std::set<glm::vec3, decltype([](const glm::vec3& a, const glm::vec3& b) {
                 return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
             })>
        of_floor;
    for (size_t i = 0; i < objects.size(); ++i) {
        const glm::vec3 albedo(value(image, "albedo", "R", i), value(image, "albedo", "G", i),
                               value(image, "albedo", "B", i));
        if (objects[i] == 1) of_floor.insert(albedo);
        if (objects[i] != 0 && objects[i] != 2) continue;
        EXPECT_EQ(albedo, objects[i] == 0 ? glm::vec3(0) : glm::vec3(0.7f, 0.7f, 0.6f)) << i;
    }
    EXPECT_EQ(of_floor.size(), 2u);
    EXPECT_TRUE(of_floor.contains(glm::vec3(0.9f, 0.6f, 0.3f)));
}

TEST_F(LightPasses, ShadowIsThePartOfTheLightThatIsHidden) {
    Scene scene = stage();
    scene.lights = {scene.lights[3]};  // the spot above: nothing hides it but the objects
    scene.lights[0].position = {0.45, 0.95, -0.1};
    ImageChannels channels{false, false, true, false, true};
    channels.shadow = true;
    scene.render.samples = 1;
    const Image image = shown(scene, channels);
    int hidden = 0, lit = 0;
    for (size_t i = 0; i < image.planes.at("P.X").size(); ++i) {
        if (image.id_planes.at("objectId")[i] != 1) continue;
        const double away =
            std::hypot(image.planes.at("P.X")[i] - 0.45f, image.planes.at("P.Z")[i] + 0.1f);
        const float shadow = value(image, "shadow", "R", i);
        if (away < 0.35) {
            EXPECT_EQ(shadow, 1) << i;
            ++hidden;
        } else if (away > 0.6 && away < 0.84 && image.planes.at("P.X")[i] > 0.5f) {
            EXPECT_EQ(shadow, 0) << i;
            ++lit;
        }
    }
    EXPECT_GT(hidden, 3);
    EXPECT_GT(lit, 0);
}

TEST_F(LightPasses, WhatCastsAShadowOutOfViewIsThereWithoutColorsToo) {
    Scene scene = stage();
    scene.lights = {scene.lights[0]};
    scene.lights[0].position = {-0.4, 0.9, 0.6};  // behind the ball of steel
    scene.observer.display.half_angles = glm::dvec2(0.05);
    const glm::dvec3 ahead =
        glm::normalize(glm::dvec3(-0.4, -0.65, -0.4) - scene.observer.position);
    const glm::dvec3 left = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), ahead));
    scene.observer.world_from_observer = {left, glm::cross(ahead, left), ahead};
    ImageChannels channels{false, false, false, false, false};
    channels.shadow = channels.albedo = channels.light_groups = true;
    const Image bare = shown(scene, channels);
    channels.color = true;
    const Image image = shown(scene, channels);
    double hidden = 0;
    for (const auto& [name, plane] : bare.planes) EXPECT_EQ(plane, image.planes.at(name)) << name;
    for (const float shadow : bare.planes.at("shadow.R")) hidden += double(shadow);
    EXPECT_GT(hidden, 10);
}

}  // namespace
}  // namespace voxelume
