// SPDX-License-Identifier: Apache-2.0
// Scenes of plain structs, each with its text as a scene file.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "runtime/api/border/handles.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "tests/api/api_environment.hpp"

namespace voxelume {

/// The scene without its positions in files and texts and without its tracks, so that scenes from
/// different sources compare equal.
inline Scene without_source_positions(Scene scene) {
    const auto strip = [](auto& parts) {
        for (auto& part : parts) part.where = {};
    };
    scene.file.clear();
    scene.world.where = scene.observer.where = {};
    strip(scene.models);
    strip(scene.objects);
    strip(scene.lights);
    for (Object& object : scene.objects) strip(object.groups);
    if (auto* const grid = std::get_if<GridDensity>(&scene.world.medium.density)) {
        grid->where = {};
        strip(grid->others);
    }
    scene.motion = nullptr;
    return scene;
}

/// Expects that both scenes have the same values in the first frame and at a later time.
inline void expect_same(const v1::SceneDescription& description, const std::string& text,
                        const v1::SceneOptions& options = {}) {
    const Scene built = api::inside(v1::Scene::build(description, options));
    const Scene read = api::inside(v1::Scene::parse(text, "scene", options));
    EXPECT_EQ(without_source_positions(built), without_source_positions(read));
    EXPECT_EQ(moves(built), moves(read));
    EXPECT_EQ(without_source_positions(scene_at(built, 2.5)),
              without_source_positions(scene_at(read, 2.5)));
}

/// The parts that every scene needs.
inline v1::SceneDescription empty_scene() {
    v1::SceneDescription scene;
    scene.world = {.voxel_size = {0.5, 0.25, 0.125}, .min = {-1, -2, -3}, .max = {3, 2, 1}};
    scene.observer.emplace().position = {0.5, 1, -6};
    return scene;
}

/// A scene text with empty_scene()'s members and the given ones.
inline std::string text_with(
    const std::string& members,
    const std::string& observer = R"({"position": [0.5, 1, -6], "display": {"shape": "pyramid"}})",
    const std::string& world = "") {
    return R"({"voxelume": 1, "world": {"voxel_size": [0.5, 0.25, 0.125],
               "bounds": {"min": [-1, -2, -3], "max": [3, 2, 1]})" +
           world + "}, \"observer\": " + observer + (members.empty() ? "" : ", ") + members + "}";
}

}  // namespace voxelume
