// SPDX-License-Identifier: Apache-2.0
// Rays that begin on instances neither meet the surface that they leave nor slip through closed
// ones. Each kind is tested with more than 100,000 rays, by default 30,000.
#include <glm/geometric.hpp>

#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/instance_scenes.hpp"

namespace voxelume {
namespace {

const uint64_t kMinRays = is_exhaustive() ? 100'000 : 30'000;

class InstanceRays : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, InstanceRays, testing::Values("cubes", "smooth", "exact"));

/// A turned room of mirrors with a turned ball and a turned block in it. Its background and the
/// light outside are far too bright: 1e6, against 1 for its walls.
Scene closed_room(const std::string& surface) {
    const std::string set = surface == "cubes" ? R"(, "set": "solid")" : "";
    return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.02, "bounds": {{"min": [-1.9, -1.9, -1.9], "max": [1.9, 1.9, 1.9]}},
          "background": [1e6, 1e6, 1e6], "ambient": [1, 1, 1]}},
"materials": {{"wall": {{"color": [0.5, 0.5, 0.5], "reflection": 0.5}},
              "mirror": {{"diffuse": 0, "reflection": 1}}}},
"models": {{"room": {{"shape": "difference", "voxel_size": 0.03, "surface": "{0}"{1}, "parts": [
              {{"shape": "box", "size": [2.1, 2.1, 2.1]}}, {{"shape": "box", "size": [1.8, 1.8, 1.8]}}]}},
           "ball": {{"shape": "sphere", "radius": 0.3, "voxel_size": 0.03, "surface": "{0}"{1}}},
           "block": {{"shape": "box", "size": [0.4, 0.5, 0.3], "voxel_size": 0.03, "surface": "{0}"{1}}}}},
"objects": [{{"model": "room", "material": "wall", "turn": [31, 17, 5], "placement": "instance"}},
            {{"model": "ball", "material": "mirror", "position": [0.4, -0.4, 0.3], "turn": [3, 2, 1],
              "placement": "instance"}},
            {{"model": "block", "material": "wall", "position": [-0.3, -0.3, 0.2], "turn": [33, 20, 0],
              "placement": "instance"}}],
"lights": [{{"type": "point", "position": [1.85, 1.85, 1.85], "intensity": 1e7}}],
"observer": {{"position": [0.1, 0.05, -0.6], "look_at": [0, 0, 0.3],
             "display": {{"shape": "pyramid", "angle": 90}}}},
"render": {{"size": [160, 160], "depth": 12}}}})",
                                   surface, set),
                       "test.json", {});
}

TEST_P(InstanceRays, NoneGetsThroughClosedWalls) {
    RenderReport report;
    Scene room = closed_room(GetParam());
    if (!is_exhaustive()) resize(room, {92, 92});
    const Image image = render(test_device(), room, report);
    EXPECT_GT(report.secondary_rays, kMinRays);
    EXPECT_GT(report.shadow_rays, kMinRays);
    size_t leaks = 0;
    for (size_t i = 0; i < image.planes.at("R").size(); ++i)
        leaks += image.planes.at("R")[i] > 2.5 || image.id_planes.at("objectId")[i] == 0;
    EXPECT_EQ(leaks, 0u);
}

TEST_P(InstanceRays, LitSidesOfConvexObjectsAreLit) {
    const bool is_cubes =
        std::string(GetParam()) == "cubes";  // the steps of cubes shadow one another
    const std::string object = is_cubes ? R"("model": "block", "turn": [33, 25, 12], "scale": 2)"
                                        : R"("model": "ball", "turn": [33, 25, 12], "scale": 2)";
    Scene scene = instance_scene(GetParam(), "instance", {object});
    scene.objects.pop_back();
    scene.render.size = is_exhaustive() ? glm::ivec2(720, 576) : glm::ivec2(420, 336);
    size_t lit = 0, acne = 0;
    for (const double height : {0.05, 1.0}) {
        scene.lights.resize(2);
        scene.lights[1].direction = -glm::normalize(glm::dvec3(0.8, height, -0.6));
        scene.lights.erase(scene.lights.begin());
        scene.render.shadows = false;
        const Image bare = image_of_scene(scene);
        scene.render.shadows = true;
        const Image shadowed = image_of_scene(scene);
        for (size_t i = 0; i < bare.planes.at("R").size(); ++i) {
            if (bare.id_planes.at("objectId")[i] == 0) continue;
            const double cosine = -glm::dot(vector_at(bare, "N", i), scene.lights[0].direction);
            if (cosine < 1e-3) continue;
            ++lit;
            acne += shadowed.planes.at("R")[i] != bare.planes.at("R")[i];
        }
        scene.lights.push_back(scene.lights[0]);
    }
    EXPECT_EQ(acne, 0u) << "of " << lit;
    EXPECT_GT(lit, kMinRays);
}

}  // namespace
}  // namespace voxelume
