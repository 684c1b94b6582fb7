// SPDX-License-Identifier: Apache-2.0
// A scene whose every value a track may change.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace voxelume {

/// A scene with every number that a track may change, except for those of `other_parts`.
inline nlohmann::json full_scene() {
    return nlohmann::json::parse(R"({"voxelume": 1,
        "world": {"voxel_size": 0.1, "bounds": {"min": [-1, -0.7, -1.2], "max": [1, 0.7, 1.2]},
                  "background": [0.1, 0.2, 0.3], "ambient": [0.4, 0.5, 0.6],
                  "medium": {"absorption": [0.1, 0.2, 0.3], "color": [0.5, 0.4, 0.7], "scattering": [0.3, 0.2, 0.1], "anisotropy": 0.4,
                             "density": {"kind": "height", "base": -0.5, "scale_height": 0.4}}},
        "materials": {"red": {"color": [0.8, 0.1, 0.2], "diffuse": 0.9, "specular": 0.3,
            "shininess": 40, "reflection": 0.2, "refraction": 0.3, "ior": 1.4, "opacity": 0.7,
            "absorption": [1, 2, 3], "emission": [4, 5, 6],
            "checker": {"color": [0.1, 0.2, 0.3], "size": [0.5, 0.6, 0.7], "origin": [1, 2, 3]}},
            "brass": {"base_color": [0.7, 0.6, 0.3], "metallic": 0.9, "roughness": 0.3,
                      "transmission": 0.5, "coat": 0.4, "coat_roughness": 0.2}},
        "models": {
            "block": {"shape": "difference", "parts": [
                {"shape": "box", "size": [0.9, 0.5, 0.7]},
                {"shape": "union", "position": [0.1, 0.2, 0.3], "turn": [10, 20, 30], "parts": [
                    {"shape": "cone", "radius": 0.15, "height": 0.6, "top_radius": 0.1,
                     "position": [0.2, 0.3, 0.1], "turn": [40, 50, 60], "scale": [1, 2, 3]}]}], "surface": "smooth"},
            "ring": {"shape": "torus", "radius": 0.4, "tube": 0.1, "surface": "smooth"},
            "egg": {"shape": "ellipsoid", "radii": [0.2, 0.3, 0.25], "surface": "smooth"},
            "floor": {"shape": "slab", "thickness": 0.1, "surface": "smooth"},
            "cut": {"mesh": "m.obj", "cut": [{"shape": "sphere", "radius": 0.2},
                    {"shape": "cylinder", "radius": 0.1, "height": 3, "scale": 2}],
                    "morph": {"amount": 0.4, "center": [0.1, 0.2, 0.3], "radius": 0.5}, "surface": "smooth"}},
        "objects": [{"name": "egg", "model": "egg", "position": [0.5, 0.3, -0.4],
                     "turn": [10, 20, 30], "scale": [1, 2, 3], "placement": "world"},
                    {"model": "ring", "scale": 0.5, "placement": "world"}],
        "lights": [{"type": "point", "position": [1, 2, 3], "color": [0.2, 0.3, 0.4], "intensity": 2},
            {"type": "spot", "position": [-1, 2, -3], "look_at": [0.1, 0.2, 0.3], "angle": 50, "inner_angle": 20},
            {"type": "directional", "direction": [1, -1, 2], "intensity": 0.4},
            {"type": "disk", "position": [1, 2, 3], "direction": [1, -2, 1], "radius": 0.3},
            {"type": "rectangle", "position": [1, 2, 3], "direction": [1, -2, 1], "up": [0.2, 0.1, 1], "size": [0.3, 0.4]}],
        "observer": {"position": [0.3, 0.4, -3], "look_at": [0.1, 0.2, 0.3], "up": [0.1, 1, 0.2],
                     "display": {"shape": "pyramid", "angles": [44, 34], "near": 0.5, "far": 6}},
        "animation": {"frames": 9}, "render": {"size": [48, 36]}})");
}

/// Densities, displays and views that the full scene doesn't have, each with its path in a
/// document.
inline std::vector<std::pair<std::string, nlohmann::json>> other_parts() {
    const auto parsed = [](const char* text) { return nlohmann::json::parse(text); };
    return {
        {"/world/medium/density",
         parsed(R"({"kind": "ball", "center": [0.1, 0.2, 0.3], "radius": 0.8, "falloff": 0.3})")},
        {"/world/medium/density",
         parsed(R"({"kind": "grid", "file": "m.vdb", "position": [1, 2, 3], "turn": [10, 20, 30],
                    "scale": [1, 2, 3]})")},
        {"/models/cut", parsed(R"({"mesh": "m.glb", "part": 1, "surface": "smooth",
                                   "morph": {"weights": [0.5, -2, 3], "skin": 1,
                                             "time": 0.25}})")},
        {"/observer/display", parsed(R"({"shape": "pyramid", "angle": 40})")},
        {"/observer/display",
         parsed(R"({"shape": "sector", "angle": 240, "near": 0.1, "far": 3})")},
        {"/observer/display", parsed(R"({"shape": "ball", "radius": 2})")},
        {"/observer/display", parsed(R"({"shape": "box", "size": [1, 2, 3], "near": 0.5})")},
        {"/observer", parsed(R"({"position": [0, 0, -3], "turn": [10, 20, 30],
                                 "display": {"shape": "ball", "radius": 2}})")},
        {"/observer", parsed(R"({"position": [0, 0, -3], "projection": "orthographic",
                                 "width": 2})")},
        {"/observer", parsed(R"({"position": [0, 0, -3], "projection": "orthographic",
                                 "height": 2})")},
        {"/observer", parsed(R"({"position": [0, 0, -3], "aperture": 0.2, "focus": 2.5,
                                 "display": {"shape": "pyramid", "angle": 40}})")},
    };
}

}  // namespace voxelume
