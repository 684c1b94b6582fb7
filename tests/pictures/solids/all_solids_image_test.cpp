// SPDX-License-Identifier: Apache-2.0
// An image of few solids, which rays test all at once, is that of walking rays, to the bit: also
// where rays are reflected and refracted, pass through surfaces to lights and are scattered.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "runtime/analysis/scene_features.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/world/world.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// Solids of several kinds that touch, of glass, a mirror and clay, two lights and a medium.
nlohmann::json touching_solids() {
    return nlohmann::json::parse(R"({"voxelume": 1,
 "world": {"voxel_size": 0.07, "ambient": [0.1, 0.1, 0.12], "background": [0.3, 0.5, 0.8],
           "bounds": {"min": [-2, -0.2, -2], "max": [2, 2, 2]},
           "medium": {"absorption": [0.05, 0.04, 0.03]}},
 "materials": {
  "clay": {"color": [0.8, 0.5, 0.3]}, "mirror": {"diffuse": 0.1, "reflection": 0.9},
  "veil": {"color": [0.9, 0.3, 0.2], "opacity": 0.4},
  "glass": {"diffuse": 0.05, "refraction": 0.9, "reflection": 0.1, "fresnel": true, "ior": 1.5,
            "absorption": [0.4, 0.1, 0.6]},
  "air": {"diffuse": 0, "refraction": 1, "ior": 1}},
 "models": {
  "floor": {"shape": "box", "size": [4, 0.2, 4], "surface": "exact"},
  "ball": {"shape": "sphere", "radius": 0.5, "surface": "exact"},
  "block": {"shape": "box", "size": [0.7, 0.7, 0.7], "surface": "exact"},
  "ring": {"shape": "torus", "radius": 0.4, "tube": 0.15, "surface": "exact"},
  "bored": {"shape": "difference", "surface": "exact",
            "parts": [{"shape": "box", "size": [0.6, 0.6, 0.6]},
                      {"shape": "cylinder", "radius": 0.2, "height": 2}]}},
 "objects": [
  {"model": "floor", "material": "clay", "position": [0, -0.1, 0]},
  {"model": "ball", "material": "glass", "position": [-0.5, 0.5, 0.4]},
  {"model": "ball", "material": "air", "position": [-0.5, 0.5, 0.4], "scale": 0.6, "priority": 1},
  {"model": "ball", "material": "mirror", "position": [0.5, 0.5, 0.4]},
  {"model": "block", "material": "glass", "position": [-1.1, 0.35, -0.6], "turn": [0, 30, 0]},
  {"model": "ring", "material": "veil", "position": [0.4, 0.6, -0.6], "turn": [70, 20, 0]},
  {"model": "bored", "material": "clay", "position": [1.3, 0.3, 0], "turn": [0, 20, 0]}],
 "lights": [
  {"type": "point", "position": [1, 1.9, 1.5], "intensity": 5},
  {"type": "disk", "position": [-1, 1.8, 0.5], "direction": [0.3, -1, -0.2], "radius": 0.2,
   "intensity": 6, "spots": 4}],
 "observer": {"position": [0.4, 1.5, 3.6], "look_at": [0, 0.4, 0],
              "display": {"shape": "pyramid", "angles": [50, 38]}},
 "render": {"size": [96, 72], "samples": 2, "depth": 4, "bounces": 4, "shadow": "filtered"}})");
}

/// Adds more shapes than rays test at once, where nobody sees them: inside the floor.
void add_hidden_shapes(nlohmann::json& scene) {
    nlohmann::json parts = nlohmann::json::array();
    for (int i = 0; i < 130; ++i)
        parts.push_back({{"shape", "sphere"},
                         {"radius", 0.02},
                         {"position", {0.1 * (i % 13) - 0.6, 0, 0.1 * (i / 13) - 0.5}}});
    scene["models"]["hidden"] = {{"shape", "union"}, {"surface", "exact"}, {"parts", parts}};
    scene["objects"].push_back(
        {{"model", "hidden"}, {"material", "clay"}, {"position", {0, -0.1, 0}}});
}

Image image_of(const nlohmann::json& json, bool solids_ahead) {
    const Scene scene = parse_scene(json.dump(), "scene.json", {});
    RenderReport report;
    const BuiltWorld world = WorldBuilder(shared_device(), false).build(scene, report.world);
    EXPECT_EQ(features_of(scene, world.pyramid).solids_ahead, solids_ahead);
    return render(shared_device(), scene, report);
}

class AllSolidsImage : public testing::TestWithParam<const char*> {};

TEST_P(AllSolidsImage, IsThatOfWalkingRays) {
    nlohmann::json scene = touching_solids();
    scene["render"]["light"] = GetParam();
    if (GetParam() == std::string("global"))
        scene["world"]["medium"]["scattering"] = {0.1, 0.1, 0.1};
    const Image ahead = image_of(scene, true);
    add_hidden_shapes(scene);
    EXPECT_EQ(oracle::image_hash(ahead), oracle::image_hash(image_of(scene, false)));
}

INSTANTIATE_TEST_SUITE_P(Lights, AllSolidsImage, testing::Values("local", "global"));

}  // namespace
}  // namespace voxelume
