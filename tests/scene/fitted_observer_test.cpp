// SPDX-License-Identifier: Apache-2.0
// The observer and the light of a scene that leaves them out are found from its objects.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>

#include "runtime/scene/fitted.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "tests/scene/fitted_scenes.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

/// The position of a point in the image: -1..1 across and down.
glm::dvec2 position_in_image(const Observer& observer, const glm::dvec3& p) {
    const glm::dvec3 e = glm::transpose(observer.world_from_observer) * (p - observer.position);
    EXPECT_GT(e.z, 0);
    return {-e.x / e.z / std::tan(observer.display.half_angles.x),
            -e.y / e.z / std::tan(observer.display.half_angles.y)};
}

/// The middle, in the image, of what all corners of a box reach.
glm::dvec2 middle_in_image(const Observer& observer, const Bounds& box) {
    glm::dvec2 low(INFINITY), high(-INFINITY);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec2 position = position_in_image(observer, corner(box, i));
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    return (low + high) / 2.0;
}

/// The largest coordinate, in the image, of all corners of a box.
double farthest_in_image(const Observer& observer, const Bounds& box) {
    double farthest = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec2 position = position_in_image(observer, corner(box, i));
        farthest = std::max({farthest, std::abs(position.x), std::abs(position.y)});
    }
    return farthest;
}

}  // namespace

TEST(FittedObserver, ShowsTheWholeOfTheObjectsInEverySize) {
    for (const char* radii :
         {"[1, 2, 3]", "[0.01, 4, 0.02]", "[5, 0.1, 5]", "[1e-3, 1e-3, 2e-3]", "[1e6, 2e6, 1e6]"}) {
        Scene scene = parse_members(fmt::format(
            R"("models": {{"egg": {{"shape": "ellipsoid", "radii": {}, "surface": "smooth"}}}},
               "objects": [{{"model": "egg", "position": [7, -5, 3]}}])",
            radii));
        for (const glm::ivec2 size : {glm::ivec2(640, 480), glm::ivec2(100, 900),
                                      glm::ivec2(1920, 200), glm::ivec2(1, 1)}) {
            SCOPED_TRACE(fmt::format("{} in {}x{}", radii, size.x, size.y));
            resize(scene, size);
            const double farthest = farthest_in_image(scene.observer, scene.fitted.shown);
            EXPECT_LT(farthest, 0.94);
            EXPECT_GT(farthest, 0.91);
            const glm::dvec2 middle = middle_in_image(scene.observer, scene.fitted.shown);
            EXPECT_LT(std::abs(middle.x), 0.01);
            EXPECT_LT(std::abs(middle.y), 0.01);
        }
    }
}

TEST(FittedObserver, LooksFromTheRightOfTheFrontAndFromAbove) {
    const Scene scene = parse_members(kBall);
    const glm::dvec3 from = scene.observer.position - glm::dvec3(1, -2, 3);
    EXPECT_GT(from.x, 0);
    EXPECT_GT(from.y, 0);
    EXPECT_GT(from.z, from.x);
    EXPECT_NEAR(scene.observer.world_from_observer[0].y, 0, 1e-12) << "the horizon is level";
    EXPECT_EQ(scene.observer.display.voxels, glm::ivec3(640, 480, 256));
    const double nearest = depth_of_nearest_corner(scene, scene.observer);
    EXPECT_LE(scene.observer.display.near, nearest) << "nothing is cut off";
    EXPECT_GT(scene.observer.display.near, 0.99 * nearest);
    const glm::dvec2 middle = position_in_image(scene.observer, {1, -2, 3});
    EXPECT_LT(glm::length(middle), 0.15);
}

TEST(FittedObserver, ShowsTheObjectsOfAllFramesThatLieInTheWorld) {
    const Scene scene = parse_members(
        R"("models": {"ball": {"shape": "sphere", "radius": 0.5, "surface": "smooth"}},
"objects": [{"name": "a", "model": "ball"}], "animation": {"frames": 3, "tracks": [
  {"target": "objects.a.position", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                            {"frame": 3, "value": [4, 0, 0]}]}]},
"world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [3, 1, 1]}})");
    EXPECT_EQ(scene.fitted.shown, (Bounds{{-0.5, -0.5, -0.5}, {3, 0.5, 0.5}}));
    EXPECT_EQ(scene_at(scene, 3).observer, scene.observer);
}

TEST(DefaultLight, ComesFromTheObserversUpperLeft) {
    const Scene scene = parse_members(kBall);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_TRUE(scene.has_default_light);
    EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(1));
    const glm::dvec3 to_light =
        glm::transpose(scene.observer.world_from_observer) * -scene.lights[0].direction;
    EXPECT_GT(to_light.x, 0.3) << "the image's left is +X_E";
    EXPECT_GT(to_light.y, 0.3);
    EXPECT_LT(to_light.z, -0.3);
    EXPECT_EQ(scene.world.ambient, glm::vec3(0.15f));
}

TEST(DefaultLight, FollowsAnObserverThatMoves) {
    const Scene scene = parse_members(fmt::format(R"({}, "observer": {{"position": [1, -2, 9],
 "look_at": [1, -2, 3], "display": {{"shape": "pyramid"}}}}, "animation": {{"frames": 2, "tracks": [
 {{"target": "observer.position", "keys": [{{"frame": 1, "value": [1, -2, 9]}},
                                         {{"frame": 2, "value": [1, -2, -9]}}]}}]}})",
                                                  kBall));
    const glm::dvec3 first = scene.lights[0].direction;
    const glm::dvec3 second = scene_at(scene, 2).lights[0].direction;
    EXPECT_NEAR(first.x, -second.x, 1e-9);
    EXPECT_NEAR(first.y, second.y, 1e-9);
    EXPECT_NEAR(first.z, -second.z, 1e-9);
}

TEST(DefaultLight, IsThereOnlyWhereASceneSaysNothingOfLight) {
    const auto lights_of = [&](const std::string& members) {
        const Scene scene = parse_members(fmt::format("{}, {}", kBall, members));
        EXPECT_EQ(scene.has_default_light, scene.lights.size() == 1);
        EXPECT_EQ(scene.world.ambient, glm::vec3(scene.has_default_light ? 0.15f : 0.0f));
        return scene.lights.size();
    };
    EXPECT_EQ(lights_of(R"("render": {})"), 1u);
    EXPECT_EQ(lights_of(R"("lights": [])"), 0u);
    EXPECT_EQ(lights_of(R"("materials": {"lamp": {"emission": [0, 1, 0]}})"), 1u)
        << "no object has it";
    const Scene lit =
        parse_members(fmt::format(R"({}, "world": {{"ambient": [0, 0, 0.5]}})", kBall));
    EXPECT_TRUE(lit.has_default_light);
    EXPECT_EQ(lit.world.ambient, glm::vec3(0, 0, 0.5f)) << "given ambient light stays";
    EXPECT_THAT(message_about(fmt::format(R"({}, "animation": {{"tracks": [
        {{"target": "lights[0].color", "keys": [{{"frame": 2, "value": [1, 1, 1]}}]}}]}})",
                                          kBall)),
                HasSubstr("the scene has no \"lights\" to change"));
}

/// The emissive object of a scene whose other object is plain, and the tracks of their values.
Scene emissive_scene(const std::string& emissive, const std::string& tracks) {
    return parse_members(fmt::format(
        R"("materials": {{"plain": {{}}, "bright": {{"emission": [0, 1, 0]}}, "dark": {{}}}},
"models": {{"ball": {{"shape": "sphere", "radius": 0.5, "surface": "smooth"}}}},
"objects": [{{"model": "ball", "material": "plain"}}, {{"name": "lamp", "model": "ball", {}}}],
"animation": {{"frames": 3, "tracks": [{}]}})",
        emissive, tracks));
}

TEST(DefaultLight, IsLeftOutForEmissionThatIsVisibleInSomeFrame) {
    const std::string bright = R"("material": "bright")", dark = R"("material": "dark")",
                      hidden = R"(, "visible": false)";
    const auto track = [](const char* target, const char* first, const char* second) {
        return fmt::format(R"({{"target": "{}", "keys": [{{"frame": 1, "value": {}}},
                                                       {{"frame": 2, "value": {}}}]}})",
                           target, first, second);
    };
    const auto has_light = [](const std::string& emissive, const std::string& tracks) {
        return emissive_scene(emissive, tracks).has_default_light;
    };
    EXPECT_FALSE(has_light(bright, ""));
    EXPECT_TRUE(has_light(bright + hidden, ""));
    EXPECT_TRUE(has_light(dark, ""));
    EXPECT_FALSE(has_light(bright + hidden, track("objects.lamp.visible", "false", "true")));
    EXPECT_TRUE(has_light(bright, track("objects.lamp.visible", "false", "false")));
    EXPECT_FALSE(has_light(dark, track("objects.lamp.material", "\"dark\"", "\"bright\"")));
    EXPECT_FALSE(has_light(dark, track("materials.dark.emission", "[0, 0, 0]", "[0, 0, 2]")));
    EXPECT_TRUE(has_light(dark, track("materials.dark.emission", "[0, 0, 0]", "[0, 0, 0]")));
    EXPECT_TRUE(
        has_light(dark + hidden, track("materials.dark.emission", "[0, 0, 0]", "[0, 0, 2]")));
    EXPECT_TRUE(has_light(dark, track("materials.bright.emission", "[3, 0, 0]", "[0, 0, 2]")));
}

TEST(FittedScene, CanBeCopied) {
    const Scene fitted = parse_members(kBall);
    const std::string text = fitted_text(fitted);
    std::string members = text.substr(0, text.size() - 1);
    for (char& c : members) c = c == '\n' ? ',' : c;
    const Scene copied = parse_members(fmt::format("{}, {}", kBall, members));
    EXPECT_EQ(copied.fitted.voxel_size || copied.fitted.bounds || copied.fitted.observer ||
                  copied.has_default_light,
              false);
    EXPECT_EQ(copied.world.voxel_size, fitted.world.voxel_size);
    EXPECT_EQ(copied.world.bounds, fitted.world.bounds);
    EXPECT_EQ(copied.world.voxels, fitted.world.voxels);
    EXPECT_EQ(copied.world.ambient, fitted.world.ambient);
    EXPECT_EQ(copied.observer.position, fitted.observer.position);
    EXPECT_EQ(copied.observer.world_from_observer, fitted.observer.world_from_observer);
    EXPECT_EQ(copied.observer.display, fitted.observer.display);
    ASSERT_EQ(copied.lights.size(), 1u);
    EXPECT_EQ(copied.lights[0].direction, fitted.lights[0].direction);
    EXPECT_EQ(fitted_text(copied), "");
}

}  // namespace voxelume
