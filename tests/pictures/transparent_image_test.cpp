// SPDX-License-Identifier: Apache-2.0
// Transparent images: laid over the background they are the opaque ones, and what mirrors and paths
// see of the outside stays.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kernels/shared/sky.h"
#include "runtime/analysis/scene_features.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

namespace {

using Json = nlohmann::json;

constexpr double kBackground[3] = {0.25, 0.5, 1};
constexpr const char* kColors[3] = {"R", "G", "B"};

/// Balls of one material each in a row, before a background.
Json row_of(const std::vector<const char*>& materials) {
    Json scene = {
        {"voxelume", 1},
        {"world",
         {{"voxel_size", 0.1},
          {"bounds", {{"min", {-2, -1, -1}}, {"max", {2, 1, 1}}}},
          {"background", kBackground},
          {"ambient", {0.1, 0.1, 0.1}}}},
        {"materials",
         {{"chalk", {{"color", {1, 0.5, 0.25}}}},
          {"mirror", {{"diffuse", 0.25}, {"reflection", 0.75}}},
          {"veil", {{"color", {1, 1, 1}}, {"opacity", 0.375}}}}},
        {"models", {{"ball", {{"shape", "sphere"}, {"radius", 0.5}, {"surface", "exact"}}}}},
        {"objects", Json::array()},
        {"lights", {{{"type", "directional"}, {"direction", {1, -2, 3}}}}},
        {"observer",
         {{"position", {0, 0, -5}}, {"display", {{"shape", "pyramid"}, {"angles", {44, 24}}}}}},
        {"render", {{"size", {44, 24}}, {"samples", 4}}}};
    for (const char* material : materials)
        scene["objects"].push_back(
            {{"model", "ball"},
             {"material", material},
             {"position", {1.2 * double(scene["objects"].size()) - 1.2, 0, 0}}});
    return scene;
}

Image shown(Json scene, bool transparent, double frame = 1) {
    scene["render"]["transparent"] = transparent;
    RenderReport report;
    return render(test_device(), scene_at(parse_scene(scene.dump(), "row", {}), frame), report);
}

/// Fails where an image laid over `background` isn't the opaque one.
void expect_over(const Image& image, const double* background, const Image& opaque) {
    const Plane<float>& alpha = image.planes.at("A");
    EXPECT_EQ(alpha, opaque.planes.at("A"));
    size_t empty = 0, whole = 0;
    for (size_t i = 0; i < alpha.size(); ++i) {
        empty += alpha[i] == 0;
        whole += alpha[i] == 1;
        for (int c = 0; c < 3; ++c) {
            const float color = image.planes.at(kColors[c])[i];
            const float expected = opaque.planes.at(kColors[c])[i];
            if (alpha[i] == 0) {
                ASSERT_EQ(color, 0) << i;
            }
            if (alpha[i] == 1) {
                ASSERT_EQ(color, expected) << i;
            }
            ASSERT_NEAR(color + (1.0 - alpha[i]) * background[c], expected, 1e-6) << i;
        }
    }
    EXPECT_GT(empty, alpha.size() / 4);
    EXPECT_GT(whole, alpha.size() / 20);
    EXPECT_LT(empty + whole, alpha.size());
}

TEST(TransparentImage, OverTheBackgroundItIsTheOpaqueImage) {
    const Json scene = row_of({"chalk", "veil", "mirror"});
    expect_over(shown(scene, true), kBackground, shown(scene, false));
}

TEST(TransparentImage, MirrorsShowTheBackgroundAsItMoves) {
    Json scene = row_of({"mirror"});
    scene["animation"] = {
        {"frames", 9},
        {"tracks",
         {{{"target", "world.background"},
           {"keys",
            {{{"frame", 1}, {"value", kBackground}}, {{"frame", 9}, {"value", {0, 0, 0}}}}}}}}};
    const double half[3] = {0.125, 0.25, 0.5};
    expect_over(shown(scene, true, 5), half, shown(scene, false, 5));
    const double none[3] = {0, 0, 0};
    expect_over(shown(scene, true, 9), none, shown(scene, false, 9));
}

TEST(TransparentImage, GlobalLightIsThatOfTheBackground) {
    Json scene = row_of({"chalk", "mirror"});
    scene["render"]["light"] = "global";
    expect_over(shown(scene, true), kBackground, shown(scene, false));
}

TEST(TransparentImage, ASkyLightsAndIsMirroredWithoutBeingSeen) {
    Json scene = row_of({"chalk", "mirror"});
    scene["world"]["sky"] = {{"kind", "gradient"}, {"samples", 4}};
    const Image opaque = shown(scene, false), image = shown(scene, true);
    const Plane<float>& alpha = image.planes.at("A");
    for (size_t i = 0; i < alpha.size(); ++i)
        for (const char* color : kColors) {
            if (alpha[i] == 0) {
                ASSERT_EQ(image.planes.at(color)[i], 0) << i;
            }
            if (alpha[i] == 1) {
                ASSERT_EQ(image.planes.at(color)[i], opaque.planes.at(color)[i]) << i;
            }
        }
}

TEST(TransparentImage, TakesNoSkyWhereOnlyObserversWouldSeeIt) {
    const auto sky_of = [](const std::vector<const char*>& materials, const char* light) {
        Json scene = row_of(materials);
        scene["render"]["transparent"] = true;
        scene["render"]["light"] = light;
        return features_of(parse_scene(scene.dump(), "row", {}), {}).sky;
    };
    EXPECT_EQ(sky_of({"chalk"}, "local"), uint32_t(VXL_SKY_NONE));
    EXPECT_NE(sky_of({"mirror"}, "local"), uint32_t(VXL_SKY_NONE));
    EXPECT_NE(sky_of({"chalk"}, "global"), uint32_t(VXL_SKY_NONE));
}

}  // namespace
}  // namespace voxelume
