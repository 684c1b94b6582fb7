// SPDX-License-Identifier: Apache-2.0
// A ball that moves past another one, for tests of several frames.
#pragma once

#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {

/// The scene with the first ball at `x`, metres.
inline Scene scene_with(double x) {
    constexpr const char* kText = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]}},
"models": {"ball": {"shape": "sphere", "radius": 0.4, "voxel_size": 0.05, "surface": "smooth"}},
"objects": [{"name": "a", "model": "ball"}, {"name": "b", "model": "ball", "position": [0.5, 0, 0]}],
"lights": [{"type": "point", "position": [1, 3, -3], "intensity": 20}],
"observer": {"position": [0, 0.5, -5], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angles": [50, 40], "near": 0.5, "far": 20,
                         "voxels": [8, 8, 8]}},
"render": {"size": [48, 32]}})";
    Scene scene = parse_scene(kText, "test.json", {});
    scene.objects[0].world_from_object[3].x = x;
    return scene;
}

}  // namespace voxelume
