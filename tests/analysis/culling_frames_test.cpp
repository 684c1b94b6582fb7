// SPDX-License-Identifier: Apache-2.0
// Objects that no ray of several frames, or of a frame's moments, reaches.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "runtime/analysis/culling.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/scene_parts.hpp"
#include "tests/analysis/culling_scene.hpp"

namespace voxelume {
namespace {

using culling_scene::scene_of;

TEST(Culling, OfSeveralFramesIsThatOfAnyOfThem) {
    const auto visible_names_in = [](Scene scene, std::vector<int> frames) {
        AssetStore meshes;
        find_potentially_visible(scene, frames, meshes);
        std::string names;
        for (const Object& object : scene.objects)
            if (object.potentially_visible) names += object.name + " ";
        return names;
    };
    const Scene turning = scene_of("", R"({"target": "observer.look_at", "interpolation": "step",
"keys": [{"frame": 1, "value": [0, 0.1, 0]}, {"frame": 2, "value": [0, 0.1, -4]},
         {"frame": 3, "value": [0, 0.1, 0]}]})");
    EXPECT_EQ(visible_names_in(turning, {1}), "seen ");
    EXPECT_EQ(visible_names_in(turning, {2}), "behind ");
    EXPECT_EQ(visible_names_in(turning, {1, 2, 3}), "seen behind ");
    EXPECT_EQ(visible_names_in(turning, {1, 3}), "seen ");
    const Scene growing = scene_of("", R"({"target": "models.e.radius", "interpolation": "step",
"keys": [{"frame": 1, "value": 0.3}, {"frame": 2, "value": 0.4}]})");
    EXPECT_EQ(visible_names_in(growing, {2}), "seen ");
    EXPECT_EQ(visible_names_in(growing, {1, 2}), "seen beyond ")
        << "its models aren't looked at ahead";
    const Scene glossy = scene_of("", R"({"target": "materials.red.reflection",
"interpolation": "step", "keys": [{"frame": 1, "value": 0}, {"frame": 2, "value": 0.5}]})");
    EXPECT_EQ(visible_names_in(glossy, {1}), "seen ");
    EXPECT_EQ(visible_names_in(glossy, {1, 2}), "seen left right behind beyond ");
}

/// The observer turns while a shutter is open, and back.
TEST(Culling, OfMomentsIsThatOfAnyOfThemUnlessTheyAreVeryMany) {
    Scene scene = scene_of("", R"({"target": "observer.look_at", "interpolation": "step",
"keys": [{"frame": 1, "value": [0, 0.1, 0]}, {"frame": 1.5, "value": [0, 0.1, -4]},
         {"frame": 2, "value": [0, 0.1, 0]}]})");
    const auto visible_with = [&](double shutter, int samples, std::vector<int> frames) {
        scene.observer.shutter = shutter;
        scene.render.samples = samples;
        Scene found = scene;
        AssetStore meshes;
        find_potentially_visible(found, frames, meshes);
        return std::ranges::count_if(found.objects, &Object::potentially_visible);
    };
    EXPECT_EQ(visible_with(0, 4, {1}), 1);
    EXPECT_EQ(visible_with(0.25, 4, {1}), 1);
    EXPECT_EQ(visible_with(0.75, 4, {1}), 2);
    const std::vector<int> many(17, 1);  // 17 times 4,096 are above 65,536
    EXPECT_EQ(visible_with(0.75, 4096, {1, 1, 1}), 2);
    EXPECT_EQ(visible_with(0.75, 4096, many), std::ssize(scene.objects));
}

TEST(Culling, StaysWithObjectsThatTheirTracksReadAgain) {
    Scene scene = scene_of("", R"({"target": "objects.left.material", "interpolation": "step",
"keys": [{"frame": 1, "value": "red"}, {"frame": 2, "value": "special"}]})");
    AssetStore meshes;
    find_potentially_visible(scene, std::array{1, 2}, meshes);
    EXPECT_FALSE(scene_at(scene, 2).objects[1].potentially_visible);
}

}  // namespace
}  // namespace voxelume
