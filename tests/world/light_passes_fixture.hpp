// SPDX-License-Identifier: Apache-2.0
// A stage whose light has all components, and images of it.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {

/// A ball of glass and a mirror on a checkered floor, in two groups of lights, one more light,
/// an emissive ball, ambient light and a sky.
inline constexpr const char* kStage = R"({"voxelume": 1,
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

/// The stage without anything that lets light through, so that passes don't differ in what sight
/// rays meet.
inline Scene opaque(Scene scene) {
    for (Material& material : scene.materials) material.refraction = 0;
    return scene;
}

}  // namespace voxelume
