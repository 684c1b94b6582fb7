// SPDX-License-Identifier: Apache-2.0
// A scene in which the observer sees only one object, for tests of what is potentially visible.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume::culling_scene {

/// A scene of five balls, each of its own model: one in view, one left and one right of it, one
/// behind the observer, and one beyond what the display shows.
inline constexpr const char* kScene = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-4, -1, -4], "max": [4, 1.5, 4]},
          "background": [0.2, 0.3, 0.5], "ambient": [0.1, 0.1, 0.1]},
"materials": {"red": {"color": [0.8, 0.2, 0.2]}, "special": {}},
"models": {"a": {"shape": "sphere", "radius": 0.30, "surface": "smooth"},
           "b": {"shape": "sphere", "radius": 0.31, "surface": "cubes"},
           "c": {"shape": "sphere", "radius": 0.32, "surface": "exact"},
           "d": {"shape": "sphere", "radius": 0.33, "surface": "smooth", "voxel_size": 0.02},
           "e": {"shape": "sphere", "radius": 0.34, "surface": "cubes"}},
"objects": [{"name": "seen", "model": "a", "material": "red", "position": [0, 0.1, 0]},
            {"name": "left", "model": "b", "position": [-2.5, 0.1, 0]},
            {"name": "right", "model": "c", "position": [2.5, 0.1, 0.2]},
            {"name": "behind", "model": "d", "position": [0, 0.2, -3.4]},
            {"name": "beyond", "model": "e", "position": [0, 0, 3]}],
"lights": [LIGHTS],
"observer": {"position": [0, 0.3, -2], "look_at": [0, 0.1, 0],
             "display": {"shape": "pyramid", "angle": 24, "far": 2.7, "voxels": [12, 12, 9]}},
"animation": {"frames": 3, "tracks": [TRACKS]},
"render": {"size": [40, 30], "depth": 2}})";

inline Scene scene_of(const std::string& lights = "", const std::string& tracks = "") {
    std::string text = kScene;
    text.replace(text.find("LIGHTS"), 6, lights);
    text.replace(text.find("TRACKS"), 6, tracks);
    return parse_scene(text, "s.json", {});
}

/// The hash of the image of a world that holds all objects.
inline uint64_t hash_of_all(const Scene& scene) {
    RenderReport report;
    const BuiltWorld world = WorldBuilder(shared_device(), false).build(scene, report.world);
    EXPECT_EQ(report.world.culled, 0u);
    return oracle::image_hash(Renderer(shared_device(), false).new_image(scene, world, report));
}

}  // namespace voxelume::culling_scene
