// SPDX-License-Identifier: Apache-2.0
// Parts of an image's light: they add up to it, and each is what a scene with that part alone
// shows.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "runtime/render/light_passes.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// A ball of glass and a mirror on a checkered floor, in two groups of lights, one more light, a
/// lamp, ambient light and a sky.
constexpr const char* kStage = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
          "ambient": [0.1, 0.05, 0.02], "sky": {"kind": "constant", "color": [0.2, 0.3, 0.4]},
          "medium": {"absorption": [0.1, 0.2, 0.1], "color": [0.1, 0.1, 0.2]}},
"materials": {"floor": {"color": [0.9, 0.6, 0.3], "checker": {"color": [0.2, 0.4, 0.8], "size": 0.25}},
              "steel": {"color": [0.7, 0.7, 0.6], "diffuse": 0.3, "reflection": 0.6, "specular": 0.4},
              "glass": {"diffuse": 0.2, "refraction": 0.7, "ior": 1.4},
              "lamp": {"color": [1, 1, 1], "emission": [3, 2, 1]}},
"models": {"floor": {"shape": "box", "size": [1.9, 0.1, 1.9], "surface": "cubes"},
           "ball": {"shape": "sphere", "radius": 0.35, "surface": "exact"},
           "bulb": {"shape": "sphere", "radius": 0.1, "surface": "cubes"}},
"objects": [{"model": "floor", "material": "floor", "position": [0, -0.7, 0]},
            {"model": "ball", "material": "steel", "position": [-0.4, -0.2, 0.2]},
            {"model": "ball", "material": "glass", "position": [0.45, -0.2, -0.1]},
            {"model": "bulb", "material": "lamp", "position": [0.1, 0.6, 0.4]}],
"lights": [{"name": "k", "group": "key", "type": "point", "position": [0.9, 0.9, -0.9], "intensity": 2},
           {"group": "fill", "type": "directional", "direction": [1, -1, 0.3], "intensity": 0.3},
           {"group": "key", "type": "disk", "position": [-0.8, 0.9, 0], "look_at": [0, -0.5, 0],
            "radius": 0.2, "intensity": 0.7, "spots": 4},
           {"type": "spot", "position": [0, 0.9, 0], "look_at": [0, -1, 0], "intensity": 0.5}],
"observer": {"position": [0.1, 0.4, -3], "look_at": [0, -0.3, 0],
             "display": {"shape": "pyramid", "angle": 42, "far": 9}},
"render": {"size": [26, 19], "samples": 2, "depth": 3}})";

class LightPasses : public testing::Test {
  protected:
    static Image shown(Scene scene, const ImageChannels& channels) {
        scene.render.channels = channels;
        RenderReport report;
        return render(shared_device(), scene, report);
    }

    static Scene stage() { return parse_scene(kStage, "stage.json", {}); }

    static float value(const Image& image, const std::string& pass, const char* color, size_t i) {
        return image.planes.at(pass + "." + color)[i];
    }

    static constexpr const char* kColors[] = {"R", "G", "B"};
    static constexpr ImageChannels kColor{true, false, false, false, false};
};

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

/// The stage without what lets light through: no pass differs in what sight rays meet.
Scene opaque(Scene scene) {
    for (Material& material : scene.materials) material.refraction = 0;
    return scene;
}

/// Global light compiles as many kernels again.
std::vector<LightMode> modes() {
    if (!is_exhaustive()) return {LightMode::local};
    return {LightMode::local, LightMode::global};
}

/// Two batches of sight rays, the second of which isn't full.
Scene of_two_batches(Scene scene) {
    scene.render.size = {90, 70};
    scene.render.samples = 11;
    return scene;
}

TEST_F(LightPasses, WithoutThemNoFurtherLightIsTraced) {
    RenderReport bare, with;
    Scene scene = opaque(stage());
    scene.render.channels = kColor;
    render(shared_device(), scene, bare);
    scene.render.channels.albedo = true;
    render(shared_device(), scene, with);
    EXPECT_EQ(bare.sight_rays, with.sight_rays);
    EXPECT_EQ(bare.shadow_rays, with.shadow_rays);
}

TEST_F(LightPasses, SightRaysAreTracedOnceForAllPasses) {
    for (const LightMode mode : modes()) {
        Scene scene = opaque(stage());
        scene.render.light = mode;
        scene.render.bounces = 1;
        scene.render.channels = kColor;
        RenderReport bare, all;
        render(shared_device(), scene, bare);
        ImageChannels& channels = scene.render.channels;
        channels.albedo = channels.direct = channels.indirect = channels.shadow =
            channels.light_groups = true;
        render(shared_device(), scene, all);
        EXPECT_EQ(bare.sight_rays, uint64_t{7} * 5 * 16 * 2);
        EXPECT_EQ(all.sight_rays, bare.sight_rays);
        EXPECT_EQ(all.beams, bare.beams);
    }
}

/// Compares the passes of an image with images of their scenes alone.
void expect_bits_of_scenes(Scene scene, const std::string& what) {
    const auto shown = [](const Scene& image) {
        RenderReport report;
        return render(shared_device(), image, report);
    };
    ImageChannels& channels = scene.render.channels;
    channels = {true, false, false, false, false};
    channels.albedo = channels.direct = channels.light_groups = true;
    const Image image = shown(scene);
    for (const LightPass& pass : light_passes(scene)) {
        const Image alone = shown(pass.scene);
        for (const char* color : {"R", "G", "B"})
            EXPECT_EQ(image.planes.at(pass.name + "." + color), alone.planes.at(color))
                << pass.name << color << what;
    }
}

TEST_F(LightPasses, TheyHaveTheBitsOfScenesThatTraceTheirOwnSightRays) {
    for (const LightMode mode : modes()) {
        Scene scene = stage();
        scene.render.light = mode;
        scene.render.bounces = 1;
        expect_bits_of_scenes(scene, " before the glass");
        expect_bits_of_scenes(of_two_batches(opaque(scene)), " without glass");
        scene.observer.position = {0.5, -0.25, -0.15};
        expect_bits_of_scenes(scene, " in the glass");
    }
}

/// What is told of the work while a scene is rendered, as parts of it.
std::vector<double> told(const Scene& scene) {
    std::vector<double> parts;
    RenderReport report;
    render(shared_device(), scene, report,
           [&](uint32_t done, uint32_t total) { parts.push_back(double(done) / total); });
    return parts;
}

TEST_F(LightPasses, ProgressIsThatOfAllOfThem) {
    Scene scene = opaque(stage());
    scene.render.channels = kColor;
    EXPECT_EQ(told(scene), std::vector<double>{1});
    scene.render.channels.albedo = scene.render.channels.shadow = true;
    const std::vector<double> parts = told(scene);  // of tiles, so that they are rounded down
    ASSERT_EQ(parts.size(), 4u);
    for (size_t i = 0; i < parts.size(); ++i)
        EXPECT_NEAR(parts[i], double(i + 1) / 4, 1.0 / 35) << i;
    EXPECT_EQ(parts.back(), 1);
}

TEST_F(LightPasses, ProgressCountsTheSamplesThatATargetOfNoiseMayNeed) {
    Scene scene = opaque(stage());
    scene.render.channels = kColor;
    scene.render.samples = 128;
    scene.render.noise.error = 1e-9;  // most tiles have them all
    std::vector<double> parts = told(scene);
    EXPECT_TRUE(std::ranges::is_sorted(parts));
    EXPECT_NEAR(parts.front(), 16.0 / 128, 1.0 / 35);
    EXPECT_EQ(parts.back(), 1);
    scene.render.noise.error = 1e9;  // none has more than 32
    parts = told(scene);
    EXPECT_NEAR(parts.front(), 16.0 / 128, 1.0 / 35);
    EXPECT_EQ(parts.back(), 1);
}

TEST_F(LightPasses, FramesOfAnAnimationHaveTheBitsOfStills) {
    Renderer renderer(shared_device());
    AssetStore meshes;
    Scene scene = stage();
    ImageChannels& channels = scene.render.channels;
    channels = kColor;
    channels.albedo = channels.shadow = channels.light_groups = true;
    RenderReport report;
    const BuiltWorld world =
        WorldBuilder(shared_device(), false, std::move(meshes)).build(scene, report.world);
    for (const float intensity : {1.0f, 0.5f}) {
        scene.lights[1].intensity = glm::vec3(intensity);
        const Image frame = *renderer.image(scene, world, report);
        EXPECT_EQ(frame.planes, shown(scene, channels).planes);
    }
    EXPECT_TRUE(report.hits_are_kept);
}

}  // namespace
}  // namespace voxelume
