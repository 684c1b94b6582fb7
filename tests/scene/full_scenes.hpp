// SPDX-License-Identifier: Apache-2.0
// Scenes that together contain every key of the format.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace voxelume {

/// Scenes that together contain every key of the format; the parser and the schema accept each.
inline std::vector<nlohmann::json> full_scenes() {
    const char* const texts[] = {
        R"({"$schema": "x", "voxelume": 1,
            "world": {"voxel_size": [0.1, 0.2, 0.3], "bounds": {"min": [-1, -2, -3], "max": [1, 2, 3]},
                      "background": [1, 2, 3], "ambient": [0, 1, 2],
                      "medium": {"absorption": [1, 2, 3], "color": [0, 0, 1],
                                 "density": {"kind": "height", "base": -1, "scale_height": 2}}},
            "materials": {"a": {"color": [0, 0.5, 1], "diffuse": 0.5, "specular": 0.5, "shininess": 7,
                                "reflection": 0.5, "refraction": 0.5, "ior": 1.5, "fresnel": true,
                                "opacity": 0.5, "checker": {"color": [0, 0, 0], "size": [1, 0, 1], "origin": [0, 0, 0]}, "absorption": [3, 2, 1],
                                "emission": [4, 5, 6]},
                          "b": {"base_color": [0, 0.5, 1], "metallic": 0.5, "roughness": 0.25}},
            "models": {"m": {"mesh": "m.obj", "voxel_size": 0.1, "surface": "cubes", "set": "thin"},
                       "r": {"mesh": "m.obj", "resolution": 64, "surface": "exact",
                             "shading": "smooth", "crease_angle": 45},
                       "v": {"voxels": "smoke.vdb", "surface": "cubes", "iso": 0.25},
                       "sphere": {"shape": "sphere", "radius": 0.5, "surface": "smooth"},
                       "ellipsoid": {"shape": "ellipsoid", "radii": [1, 2, 3], "surface": "smooth"},
                       "box": {"shape": "box", "size": [1, 2, 3], "surface": "smooth"},
                       "cylinder": {"shape": "cylinder", "radius": 1, "height": 2, "surface": "smooth"},
                       "cone": {"shape": "cone", "radius": 1, "height": 2, "top_radius": 0.5, "surface": "smooth"},
                       "torus": {"shape": "torus", "radius": 2, "tube": 1, "surface": "smooth"},
                       "capsule": {"shape": "capsule", "radius": 1, "height": 2, "surface": "smooth"},
                       "slab": {"shape": "slab", "thickness": 0.1, "surface": "smooth"}},
            "objects": [{"name": "o", "model": "m", "material": "a", "materials": {"lid": "a"}, "priority": 3, "spots": 8, "placement": "world",
                         "position": [1, 2, 3], "turn": [10, 20, 30], "scale": 2},
                        {"model": "sphere", "scale": [1, -2, 3]},
                        {"model": "box", "matrix": [[2, 1, 0, 5], [0, 3, 1, 6], [1, 0, 4, 7]]}],
            "lights": [{"name": "p", "type": "point", "position": [1, 2, 3], "color": [1, 1, 1], "intensity": 2},
                       {"type": "spot", "position": [1, 2, 3], "direction": [0, -1, 2], "angle": 50,
                        "inner_angle": 20, "group": "warm"},
                       {"type": "spot", "position": [1, 2, 3], "look_at": [0, 0, 9]},
                       {"type": "directional", "direction": [1, 2, 3]},
                       {"type": "disk", "position": [1, 2, 3], "direction": [0, -1, 0], "radius": 2, "spots": 9},
                       {"type": "rectangle", "position": [1, 2, 3], "look_at": [0, 0, 9], "up": [1, 0, 0],
                        "size": [2, 3], "spots": 7}],
            "observer": {"position": [0, 1, -3], "look_at": [0.5, 0, 0], "up": [0, 1, 0], "aperture": 0.1, "focus": 3,
                         "display": {"shape": "pyramid", "angles": [40, 30], "near": 0.5, "far": 10,
                                     "voxels": [64, 48, 32]}},
            "animation": {"frames": 5, "fps": 24, "tracks": []},
            "render": {"size": [64, 48], "samples": 4, "depth": 3, "light": "global", "bounces": 4, "lamps": "paths", "shadows": false,
                       "shadow": "filtered", "least_weight": 0.001}})",
        R"({"voxelume": 1, "world": {"voxel_size": 0.5, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}},
            "models": {"u": {"shape": "union", "parts": [{"shape": "sphere", "radius": 1}], "surface": "smooth"},
                       "i": {"shape": "intersection", "resolution": 9, "parts": [
                           {"shape": "ellipsoid", "radii": [1, 2, 3], "position": [1, 2, 3]},
                           {"shape": "box", "size": [1, 2, 3], "turn": [1, 2, 3]},
                           {"shape": "cylinder", "radius": 1, "height": 2, "scale": 3},
                           {"shape": "cone", "radius": 1, "height": 2, "scale": [1, 2, 3]}], "surface": "smooth"},
                       "d": {"shape": "difference", "parts": [
                           {"shape": "torus", "radius": 2, "tube": 1,
                            "matrix": [[1, 0, 0, 1], [0, 2, 0, 2], [0, 0, 3, 3]]},
                           {"shape": "capsule", "radius": 1, "height": 2},
                           {"shape": "slab", "thickness": 2},
                           {"shape": "union", "parts": [{"shape": "sphere", "radius": 1}]}], "surface": "smooth"}},
            "observer": {"position": [0, 0, 0], "turn": [1, 2, 3],
                         "display": {"shape": "sector", "angle": 200, "near": 1, "far": 2}}})",
        R"({"voxelume": 1, "world": {"voxel_size": 0.5, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]},
            "medium": {"density": {"kind": "grid", "file": "s.#.vdb", "sequence": {"first": 1, "last": 2}}}},
            "materials": {"a": {"ior": 1.5}},
            "models": {"m": {"mesh": "m.obj", "fit": 2, "morph": {"mesh": "m.obj", "amount": 0.5}, "surface": "smooth"},
                       "b": {"mesh": "m.obj", "morph": {"center": [1, 2, 3], "radius": 1}, "surface": "smooth",
                             "cut": [{"shape": "sphere", "radius": 1, "position": [1, 2, 3]}]},
                       "s": {"voxels": "s.#.vdb", "part": 7, "unit": "mm", "label": "each", "sequence": {"first": 1, "last": 2, "start": 3, "loop": true}},
                       "ball": {"shape": "sphere", "radius": 1, "surface": "smooth"}},
            "objects": [{"name": "o", "model": "m", "visible": true}],
            "lights": [{"type": "point", "position": [1, 2, 3]}],
            "observer": {"position": [0, 0, 0], "display": {"shape": "ball", "radius": 2}},
            "animation": {"frames": 5, "tracks": [
                {"target": "objects.o.position", "interpolation": "cubic",
                 "keys": [{"frame": 1, "value": [1, 2, 3]}, {"time": 0.5, "value": [3, 2, 1]}]},
                {"target": "objects.o.visible", "keys": [{"frame": 2, "value": false}]},
                {"target": "objects.o.model", "keys": [{"frame": 2, "value": "ball"}]},
                {"target": "lights[0].intensity", "keys": [{"frame": 2, "value": 5}]}]}})",
        R"({"voxelume": 1, "world": {"voxel_size": 0.5, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]},
            "sky": {"kind": "constant", "color": [1, 2, 3], "strength": 2, "samples": 4},
            "medium": {"density": {"kind": "ball", "center": [1, 2, 3], "radius": 2, "falloff": 1}}},
            "observer": {"position": [0, 0, 0], "display": {"shape": "ball", "radius": 2, "voxels": [5, 6, 7],
                                                                   "layout": "lattice", "visibility": "all", "seen_along": "z",
                                                                   "clip": "cylinder"}}})",
        R"({"voxelume": 1, "world": {"voxel_size": 0.5, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]},
            "sky": {"kind": "gradient", "zenith": [1, 2, 3], "horizon": [3, 2, 1], "ground": [0, 0, 0], "strength": 2, "samples": 4},
            "medium": {"density": {"kind": "grid", "file": "smoke.vdb", "grid": "d", "position": [1, 2, 3],
                                   "turn": [10, 20, 30], "scale": 2}}},
            "observer": {"position": [0, 0, 0], "display": {"shape": "pyramid", "angle": 40}}})",
        R"({"voxelume": 1, "world": {"voxel_size": 0.5, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]},
            "sky": {"kind": "sun", "direction": [1, -2, 3], "angle": 2, "color": [1, 2, 3], "intensity": 4, "turbidity": 5, "ground": [0, 0, 0], "strength": 2, "samples": 4},
            "medium": {"density": {"kind": "grid", "file": "smoke.vdb",
                                   "matrix": [[2, 1, 0, 5], [0, 3, 1, 6], [1, 0, 4, 7]]}}},
            "observer": {"position": [0, 0, 0], "display": {"shape": "box", "size": [1, 2, 3], "near": 1}}})",
        R"({"voxelume": 1, "world": {"resolution": 32, "background": [1, 2, 3]},
            "models": {"ball": {"shape": "sphere", "radius": 1, "surface": "smooth"}, "m": {"mesh": "m.obj", "unit": "in", "surface": "smooth"}},
            "objects": [{"model": "ball"}, {"model": "m", "position": [1, 2, 3]}]})",
    };
    std::vector<nlohmann::json> scenes;
    for (const char* text : texts) scenes.push_back(nlohmann::json::parse(text));
    return scenes;
}

}  // namespace voxelume
