// SPDX-License-Identifier: Apache-2.0
// Scenes of exact solids with all kinds of materials and lights, for comparisons of whole images.
#pragma once

namespace voxelume {

/// A scene of a glass of water with a bubble of glass in it, nested by priority; all surfaces have
/// Fresnel's reflectance.
inline constexpr const char* kNestedScene = R"({"voxelume": 1,
 "world": {"voxel_size": 0.02, "bounds": {"min": [-1.5, -0.1, -1.3], "max": [1.7, 2, 1.4]}, "background": [0.3, 0.4, 0.6],
           "ambient": [0.2, 0.1, 0.3], "medium": {"absorption": [0.1, 0.05, 0.2], "color": [0.5, 0.4, 0.3]}},
 "materials": {
  "floor": {"color": [0.7, 0.6, 0.5], "checker": {"color": [0.1, 0.2, 0.3], "size": [0.3, 0, 0.4], "origin": [0.05, 0, 0.1]}},
  "glass": {"color": [0.9, 1, 0.8], "diffuse": 0.05, "specular": 0.4, "shininess": 80, "reflection": 1, "refraction": 1, "fresnel": true, "ior": 1.5, "absorption": [0.4, 0.1, 0.5]},
  "water": {"diffuse": 0, "reflection": 1, "refraction": 1, "fresnel": true, "ior": 1.33, "absorption": [2, 0.5, 0.25]},
  "brass": {"color": [0.8, 0.6, 0.2], "diffuse": 0.6, "specular": 0.6, "shininess": 40, "reflection": 0.4}},
 "models": {
  "floor": {"shape": "box", "size": [3, 0.06, 2.5], "surface": "exact"},
  "cup": {"shape": "cylinder", "radius": 0.5, "height": 1, "surface": "exact"},
  "fill": {"shape": "cylinder", "radius": 0.42, "height": 0.7, "surface": "exact"},
  "bubble": {"shape": "sphere", "radius": 0.15, "surface": "exact"},
  "ring": {"shape": "torus", "radius": 0.4, "tube": 0.12, "surface": "exact"}},
 "objects": [
  {"model": "floor", "material": "floor", "position": [0.1, -0.04, 0]},
  {"model": "cup", "material": "glass", "position": [0.05, 0.6, 0.2], "turn": [0, 4, 3]},
  {"model": "fill", "material": "water", "position": [0.05, 0.55, 0.2], "turn": [0, 4, 3], "priority": 2},
  {"model": "bubble", "material": "glass", "position": [0.15, 0.7, 0.3], "priority": 5},
  {"model": "ring", "material": "brass", "position": [-0.2, 0.6, -0.7], "turn": [20, 70, 10]}],
 "lights": [{"type": "spot", "position": [1, 3, 2], "look_at": [0, 0.3, 0], "angle": 50, "inner_angle": 20, "intensity": 20},
            {"type": "directional", "direction": [1, -2, -1.5], "color": [0.5, 0.6, 0.4]}],
 "observer": {"position": [0.5, 1.4, 3.3], "look_at": [0, 0.5, 0], "display": {"shape": "pyramid", "angle": 42, "near": 1.2}},
 "render": {"size": [240, 180], "depth": 7}})";

/// A scene of objects with opacity, with and without refraction, that overlap by priority, some
/// squeezed or mirrored. It has filtered shadows, a light inside an object, and voxels that aren't
/// cubes.
inline constexpr const char* kVeiledScene = R"({"voxelume": 1,
 "world": {"voxel_size": [0.03, 0.02, 0.025], "bounds": {"min": [-1.5, -0.1, -1.3], "max": [1.7, 2, 1.4]}, "background": [0.3, 0.4, 0.6],
           "ambient": [0.2, 0.1, 0.3], "medium": {"absorption": [0.1, 0.05, 0.2], "color": [0.5, 0.4, 0.3]}},
 "materials": {
  "floor": {"color": [0.7, 0.6, 0.5], "reflection": 0.2, "checker": {"color": [0.1, 0.2, 0.3], "size": [0.3, 0, 0.4], "origin": [0.05, 0, 0.1]}},
  "veil": {"color": [0.9, 0.5, 0.2], "diffuse": 0.7, "specular": 0.3, "opacity": 0.4, "absorption": [0.2, 0.6, 1], "ior": 1.2},
  "jelly": {"color": [0.3, 0.9, 0.5], "diffuse": 0.3, "specular": 0.5, "shininess": 90, "opacity": 0.7, "refraction": 0.6, "reflection": 0.1, "ior": 1.3, "absorption": [1, 0.2, 1]},
  "gem": {"diffuse": 0.1, "specular": 0.5, "reflection": 0.9, "refraction": 0.8, "fresnel": true, "ior": 2.2, "absorption": [0.2, 0.6, 0.3]},
  "paint": {"color": [0.8, 0.3, 0.2], "specular": 0.4}},
 "models": {
  "floor": {"shape": "slab", "thickness": 0.06, "surface": "exact"},
  "box": {"shape": "box", "size": [0.8, 0.7, 0.6], "surface": "exact"},
  "egg": {"shape": "ellipsoid", "radii": [0.3, 0.45, 0.25], "surface": "exact"},
  "pill": {"shape": "capsule", "radius": 0.12, "height": 0.3, "surface": "exact"},
  "ring": {"shape": "torus", "radius": 0.3, "tube": 0.13, "surface": "exact"}},
 "objects": [
  {"model": "floor", "material": "floor", "position": [0.1, -0.04, 0]},
  {"model": "box", "material": "veil", "position": [-0.6, 0.55, 0.3], "turn": [25, 10, 5]},
  {"model": "pill", "material": "paint", "position": [-0.65, 0.5, 0.25], "turn": [10, 40, 60]},
  {"model": "egg", "material": "jelly", "position": [-0.2, 0.6, 0.5], "turn": [0, 15, 30], "priority": 1},
  {"model": "ring", "material": "gem", "position": [0.6, 0.5, 0.2], "turn": [20, 50, 10], "scale": [1, 1.4, 0.9]},
  {"model": "pill", "material": "paint", "position": [0.5, 0.5, -0.6], "turn": [10, 40, -60], "scale": -1.5}],
 "lights": [{"type": "point", "position": [1, 1.8, 1.2], "intensity": 3},
            {"type": "point", "position": [-0.45, 0.7, 0.35], "intensity": 0.1, "color": [1, 0.8, 0.5]},
            {"type": "directional", "direction": [1, -2, -1.5], "color": [0.5, 0.6, 0.4]}],
 "observer": {"position": [0.5, 1.4, 3.3], "look_at": [0, 0.5, 0], "display": {"shape": "pyramid", "angle": 42, "near": 1.2}},
 "render": {"size": [240, 180], "depth": 5, "shadow": "filtered"}})";

/// A scene of water that the sides of the world cut, with sight rays and background below its
/// surface.
inline constexpr const char* kPoolScene = R"({"voxelume": 1,
 "world": {"voxel_size": 0.02, "bounds": {"min": [-1.5, -1, -1.3], "max": [1.7, 1.2, 1.4]}, "background": [0.3, 0.4, 0.6],
           "ambient": [0.2, 0.1, 0.3]},
 "materials": {
  "floor": {"color": [0.7, 0.6, 0.5], "checker": {"color": [0.1, 0.2, 0.3], "size": [0.3, 0, 0.4], "origin": [0.05, 0, 0.1]}},
  "water": {"diffuse": 0, "reflection": 1, "refraction": 1, "fresnel": true, "ior": 1.33, "absorption": [0.6, 0.2, 0.1]},
  "paint": {"color": [0.8, 0.3, 0.2], "specular": 0.4, "reflection": 0.3}},
 "models": {
  "floor": {"shape": "box", "size": [3, 0.06, 2.5], "surface": "exact"},
  "pool": {"shape": "slab", "thickness": 0.9, "surface": "exact"},
  "ring": {"shape": "torus", "radius": 0.3, "tube": 0.13, "surface": "exact"}},
 "objects": [
  {"model": "floor", "material": "floor", "position": [0.1, -0.9, 0]},
  {"model": "pool", "material": "water", "position": [0, -0.35, 0]},
  {"model": "ring", "material": "paint", "position": [0.2, 0, 0.2], "turn": [20, 50, 10]}],
 "lights": [{"type": "directional", "direction": [1, -2, -1.5], "color": [0.5, 0.6, 0.4]}],
 "observer": {"position": [0.5, 0.3, 3.3], "look_at": [0, -0.1, 0], "display": {"shape": "pyramid", "angle": 42, "near": 1.2}},
 "render": {"size": [240, 180], "depth": 4, "shadow": "filtered"}})";

}  // namespace voxelume
