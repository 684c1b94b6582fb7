// SPDX-License-Identifier: Apache-2.0
// Cameras and render settings of MagicaVoxel files, as observers and light of scenes.
#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "tests/support/vox_fixture.hpp"

namespace voxelume {

using testing::HasSubstr;
using testing::Not;

class VoxLightTest : public VoxFileTest {
  protected:
    static VoxWriter with_model() {
        const VoxSample sample;
        VoxWriter writer;
        writer.model(sample.size, sample.voxels);
        return writer;
    }
    static void camera(VoxWriter& writer, const VoxPairs& values) {
        writer.chunk("rCAM", VoxWriter::number(0) + VoxWriter::dictionary(values));
    }
    static void settings(VoxWriter& writer, const VoxPairs& values) {
        writer.chunk("rOBJ", VoxWriter::dictionary(values));
    }
    std::string text_of_scene(const VoxWriter& writer, const ImportOptions& options = {}) const {
        AssetStore assets;
        return scene_of_file(put(writer.bytes()), "a.vox", options, assets);
    }
    Scene scene_of_writer(const VoxWriter& writer) const {
        AssetStore assets;
        return scene_of(put(writer.bytes()), assets);
    }
};

// In local light each point would send rays to each emissive object.
TEST_F(VoxLightTest, ManyEmissiveObjectsShineInGlobalLight) {
    for (const int visible : {1, 16, 17}) {
        VoxWriter writer;
        writer.model({1, 1, 1}, {{0, 0, 0, 3}});
        writer.material(3, {{"_type", "_emit"}, {"_emit", "1"}});
        std::vector<int> children;
        writer.transform(0, 1, 0, {}, {{}});
        for (int i = 0; i < 20; ++i) {
            const VoxPairs hidden = {{"_hidden", i < visible ? "0" : "1"}};
            const VoxPairs at = {{"_t", std::to_string(3 * i) + " 0 0"}};
            writer.transform(2 + 2 * i, 3 + 2 * i, 0, hidden, {at});
            writer.shape(3 + 2 * i, {{0, {}}});
            children.push_back(2 + 2 * i);
        }
        writer.group(1, children);
        const Scene scene = scene_of_writer(writer);
        EXPECT_EQ(scene.render.light, visible > 16 ? LightMode::global : LightMode::local)
            << visible;
        EXPECT_EQ(scene.render.samples, visible > 16 ? 64 : 4) << visible;
        EXPECT_THAT(text_of_scene(writer, {.is_lattice = true}), Not(HasSubstr("global")));
    }
}

// Measured in monu2.png, MagicaVoxel's picture of monu2.vox: the camera looks along
// (sin 40, cos 40) and 30 degrees downwards.
TEST_F(VoxLightTest, ACameraLooksAtItsFocus) {
    VoxWriter writer = with_model();
    camera(writer, {{"_mode", "pers"}, {"_radius", "0"}, {"_angle", "1 2 3"}});
    camera(writer, {{"_mode", "pers"},
                    {"_focus", "1 2 3"},
                    {"_angle", "-30 320 0"},
                    {"_radius", "10"},
                    {"_fov", "60"}});
    const Observer observer = scene_of_writer(writer).observer;
    const double flat = std::cos(glm::radians(30.0)), yaw = glm::radians(40.0);
    const glm::dvec3 forward(flat * std::sin(yaw), flat * std::cos(yaw), -0.5);  // Z is up
    const glm::dvec3 position = glm::dvec3(1, 2, 3) - 10.0 * forward;
    EXPECT_LT(glm::distance(observer.position, {position.x, position.z, -position.y}), 1e-5);
    const glm::dvec3 looks = observer.world_from_observer[2];
    EXPECT_LT(glm::distance(looks, {forward.x, forward.z, -forward.y}), 1e-6);
    EXPECT_NEAR(observer.world_from_observer[0].y, 0, 1e-6);
    EXPECT_NEAR(std::tan(observer.display.half_angles.y), std::tan(glm::radians(30.0)), 1e-6);
    EXPECT_NEAR(std::tan(observer.display.half_angles.x), 4 / 3.0 * std::tan(glm::radians(30.0)),
                1e-6);
}

TEST_F(VoxLightTest, CamerasOfAllKindsBecomeObservers) {
    for (const auto& [mode, projection, shape] :
         {std::tuple{"orth", Projection::orthographic, DisplayShape::box},
          std::tuple{"iso", Projection::orthographic, DisplayShape::box},
          std::tuple{"pano", Projection::panoramic, DisplayShape::ball},
          std::tuple{"free", Projection::display, DisplayShape::pyramid},
          std::tuple{"sg", Projection::display, DisplayShape::pyramid}}) {
        VoxWriter writer = with_model();
        camera(writer, {{"_mode", mode}, {"_radius", "20"}, {"_frustum", "6"}});
        const Observer observer = scene_of_writer(writer).observer;
        EXPECT_EQ(observer.projection, projection) << mode;
        EXPECT_EQ(observer.display.shape, shape) << mode;
        if (shape == DisplayShape::box) {
            EXPECT_NEAR(observer.display.half_size.y, 6, 1e-6);
        }
    }
    // The view and angle of the command line win over the file's camera.
    VoxWriter writer = with_model();
    camera(writer, {{"_mode", "pano"}, {"_radius", "20"}});
    EXPECT_THAT(text_of_scene(writer), HasSubstr("panoramic"));
    EXPECT_THAT(text_of_scene(writer, {.has_own_camera = false}), Not(HasSubstr("panoramic")));
}

TEST_F(VoxLightTest, SunSkyGroundAndBackgroundAreThoseOfTheFile) {
    VoxWriter writer = with_model();
    settings(writer, {{"_type", "_inf"}, {"_i", "0.5"}, {"_k", "255 0 0"}, {"_angle", "30 50"}});
    settings(writer, {{"_type", "_uni"}, {"_i", "2"}, {"_k", "0 255 0"}});
    settings(writer, {{"_type", "_film"}, {"_expo", "0.5"}});
    settings(writer, {{"_type", "_ground"}, {"_color", "255 0 255"}});
    settings(writer, {{"_type", "_bg"}, {"_color", "0 0 255"}});
    settings(writer, {{"_type", "_setting"}, {"_ground", "1"}, {"_bg_c", "1"}});
    const Scene scene = scene_of_writer(writer);
    ASSERT_TRUE(scene.world.sky);
    EXPECT_FALSE(scene.world.sky->visible);
    EXPECT_LT(glm::distance(scene.world.sky->color, {0, 1.3f, 0}), 1e-5f);
    EXPECT_LT(glm::distance(scene.world.background, {0, 0, 0.5f}), 1e-5f);
    EXPECT_EQ(scene.world.ambient, glm::vec3(0));
    EXPECT_LT(glm::distance(scene.materials.back().color, {1, 0, 1}), 1e-5f);
    ASSERT_EQ(scene.lights.size(), 1u);
    const Light& sun = scene.lights.front();
    EXPECT_GT(sun.intensity.r, 0);
    EXPECT_EQ(sun.intensity.g, 0);
    // Shadows of monu2.png fall along (-sin 50, cos 50).
    const double flat = std::cos(glm::radians(30.0)), yaw = glm::radians(50.0);
    const glm::dvec3 falls(-flat * std::sin(yaw), flat * std::cos(yaw), -0.5);
    EXPECT_LT(glm::distance(sun.direction, {falls.x, falls.z, -falls.y}), 1e-5);

    EXPECT_THAT(text_of_scene(writer, {.has_ground = false}), Not(HasSubstr("\"ground\"")));
    EXPECT_THAT(text_of_scene(writer, {.background = glm::vec3(0.25f)}),
                HasSubstr("\"background\": [0.25, 0.25, 0.25]"));
    settings(writer, {{"_type", "_setting"}, {"_ground", "0"}});
    EXPECT_THAT(text_of_scene(writer), Not(HasSubstr("\"ground\"")));
    EXPECT_THAT(text_of_scene(writer, {.has_ground = true}), HasSubstr("\"ground\""));
}

TEST_F(VoxLightTest, FogIsAMediumAndDarkLightsAreLeftOut) {
    VoxWriter writer = with_model();
    settings(writer, {{"_type", "_fog_uni"}, {"_d", "0.5"}, {"_k", "255 255 0"}});
    const Medium medium = scene_of_writer(writer).world.medium;
    EXPECT_GT(medium.absorption.x, 0);
    EXPECT_GT(medium.color.g, 0);
    EXPECT_EQ(medium.color.b, 0);
    AssetStore assets;
    const Scene small = scene_of(put(writer.bytes()), assets, {.fit = 3.5});  // of seven voxels
    EXPECT_NEAR(small.world.medium.absorption.x, 2 * medium.absorption.x, 1e-6)
        << "there is half as much of it before a model of half the size";
    settings(writer, {{"_type", "_inf"}, {"_i", "0"}});
    settings(writer, {{"_type", "_uni"}, {"_i", "0"}});
    const Scene dark = scene_of_writer(writer);
    EXPECT_FALSE(dark.world.sky);
    EXPECT_TRUE(dark.lights.empty());
    EXPECT_FALSE(dark.has_default_light);
}

TEST_F(VoxLightTest, WhatIsSwitchedOnAndNotShownIsNamed) {
    VoxWriter writer = with_model();
    settings(writer, {{"_type", "_edge"}, {"_width", "0.2"}});
    settings(writer, {{"_type", "_film"}, {"_vig", "0"}, {"_aces", "0"}});
    EXPECT_TRUE(read_vox_file(put(writer.bytes())).render.not_shown.empty());
    settings(writer, {{"_type", "_film"}, {"_vig", "0.2"}, {"_aces", "1"}});
    settings(writer, {{"_type", "_bloom"}, {"_scale", "0.5"}});
    settings(writer, {{"_type", "_setting"}, {"_edge", "1"}, {"_grid", "1"}});
    const VoxRender render = read_vox_file(put(writer.bytes())).render;
    EXPECT_THAT(render.not_shown, testing::ElementsAre("bloom", "the film's tone curve (ACES)",
                                                       "the grid", "vignetting", "voxels' edges"));
}

// Numbers that are none, far too large or missing leave usable scenes.
TEST_F(VoxLightTest, NonsenseStaysWithinLimits) {
    const std::vector<std::string> values = {"nan",   "inf", "-inf", "1e39",  "-1e39",      "",
                                             "x y z", "1",   "-1 2", "0 0 0", "9e9 9e9 9e9"};
    std::mt19937 random(7);
    const auto any = [&] { return values[random() % values.size()]; };
    for (int round = 0; round < 60; ++round) {
        VoxWriter writer = with_model();
        camera(writer, {{"_mode", round % 2 ? "orth" : "pers"},
                        {"_focus", any()},
                        {"_angle", any()},
                        {"_radius", any()},
                        {"_frustum", any()},
                        {"_fov", any()}});
        settings(
            writer,
            {{"_type", "_inf"}, {"_i", any()}, {"_k", any()}, {"_angle", any()}, {"_area", any()}});
        settings(writer, {{"_type", "_uni"}, {"_i", any()}, {"_k", any()}});
        settings(writer, {{"_type", "_fog_uni"}, {"_d", any()}, {"_k", any()}});
        settings(writer, {{"_type", "_film"}, {"_expo", any()}});
        settings(writer, {{"_type", "_lens"}, {"_fov", any()}});
        settings(writer, {{"_type", "_env"}, {"_mode", any()}});
        EXPECT_NO_THROW(scene_of_writer(writer)) << "round " << round;
    }
}

}  // namespace voxelume
