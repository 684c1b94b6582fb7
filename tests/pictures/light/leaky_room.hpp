// SPDX-License-Identifier: Apache-2.0
// A room that no ray can leave, full of objects that send rays everywhere.
#pragma once

#include <string>

#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {

/// A leaky room: its background is far too bright, 1e6 against 1 for its walls.
inline Scene leaky_room(const std::string& surface, int depth) {
    const std::string text = R"({"voxelume": 1,
"world": {"voxel_size": 0.03, "bounds": {"min": [-1.1, -1.1, -1.1], "max": [1.1, 1.1, 1.1]},
          "background": [1e6, 1e6, 1e6], "ambient": [1, 1, 1]},
"materials": {"wall": {"color": [0.5, 0.5, 0.5], "reflection": 0.5},
              "mirror": {"diffuse": 0, "reflection": 1},
              "glass": {"diffuse": 0, "reflection": 1, "refraction": 1, "ior": 1.5, "fresnel": true}},
"models": {"room": {"shape": "difference", "surface": ")" +
                             surface + R"(", "parts": [
              {"shape": "box", "size": [2.1, 2.1, 2.1]}, {"shape": "box", "size": [1.9, 1.9, 1.9]}]},
           "ball": {"shape": "sphere", "radius": 0.3, "surface": ")" +
                             surface + R"("},
           "ring": {"shape": "torus", "radius": 0.25, "tube": 0.1, "surface": ")" +
                             surface + R"("},
           "block": {"shape": "box", "size": [0.4, 0.5, 0.3], "surface": "exact"}},
"objects": [{"model": "room", "material": "wall"},
            {"model": "ball", "material": "glass", "position": [-0.31, 0.22, 0.13]},
            {"model": "ring", "material": "glass", "position": [0.4, 0.35, 0.2], "turn": [20, 50, 10]},
            {"model": "ball", "material": "mirror", "position": [0.4, -0.4, 0.3]},
            {"model": "block", "material": "glass", "position": [-0.3, -0.5, 0.2], "turn": [33, 20, 0]}],
"lights": [],
"observer": {"position": [0.1, 0.05, -0.8], "look_at": [0, 0, 0.3],
             "display": {"shape": "pyramid", "angle": 90}},
"render": {"size": [192, 192], "depth": )" +
                             std::to_string(depth) + "}}";
    return parse_scene(text, "test.json", {});
}

}  // namespace voxelume
