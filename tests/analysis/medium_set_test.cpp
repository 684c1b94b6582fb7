// SPDX-License-Identifier: Apache-2.0
// Sets of overlapping objects that rays are inside of: how many entries a scene's medium set needs,
// and images against an analytic tracer.
#include "runtime/analysis/medium_set.hpp"
#include "runtime/scene_file/read_scene.hpp"

#include "runtime/render/illumination.hpp"
#include "tests/support/analytic_comparison.hpp"

namespace voxelume {
namespace {

/// The scene text of `count` balls of glass, each inside the one before. The innermost has the
/// highest priority if `rising`. Their centres are `step` metres apart; the observer is outside of
/// all.
std::string nested_balls(int count, bool rising, double step = 0.02) {
    std::string objects;
    for (int i = 0; i < count; ++i)
        objects += fmt::format(
            R"({}{{"model": "ball", "material": "m{}", "position": [{}, 0.1, 0.05], "scale": {}, "priority": {}}})",
            i == 0 ? "" : ", ", i % 3, 0.1 + step * i, 1 - 0.6 * i / count,
            rising ? i : (7 * i) % 5);
    return R"({"voxelume": 1,
 "world": {"voxel_size": 0.04, "bounds": {"min": [-1.5, -1, -1.3], "max": [1.7, 1.2, 1.4]}, "background": [0.3, 0.4, 0.6]},
 "materials": {
  "m0": {"diffuse": 0, "refraction": 0.9, "ior": 1.1, "absorption": [0.3, 0.1, 0.05]},
  "m1": {"diffuse": 0.1, "refraction": 1, "ior": 1.2, "absorption": [0.05, 0.6, 0.15]},
  "m2": {"diffuse": 0.2, "opacity": 0.3, "ior": 0.9, "absorption": [0.15, 0.05, 0.45]}},
 "models": {"ball": {"shape": "sphere", "radius": 0.8, "surface": "exact"}},
 "objects": [)" +
           objects + R"(],
 "lights": [{"type": "directional", "direction": [1, -2, -1.5], "color": [0.5, 0.6, 0.4]}],
 "observer": {"position": [0.3, 0.2, 3.3], "look_at": [0.1, 0.1, 0], "display": {"shape": "pyramid", "angle": 28}},
 "render": {"size": [161, 142], "depth": 9, "shadow": "filtered"}})";
}

Scene parse(const std::string& text) {
    return parse_scene(text, "test.json", {});
}

Features needed(const Scene& scene) {
    WorldReport report;
    return features_of(scene, build_world(test_device(), scene, report));
}

TEST(MediumSet, HasRoomForTheObjectsThatOverlap) {
    EXPECT_EQ(needed(parse(nested_balls(7, true))).media, 7);
    EXPECT_EQ(needed(parse(nested_balls(3, true, 5))).media, 1) << "two are out of reach";
    const Features capped = needed(parse(nested_balls(16, true)));
    EXPECT_EQ(capped.media, 15);
    EXPECT_TRUE(capped.medium_set_capped);
    EXPECT_FALSE(needed(parse(nested_balls(15, true))).medium_set_capped);
}

TEST(MediumSet, SevenObjectsInOneAnotherAreSeenAsTheirPrioritiesSay) {
    for (const bool rising : {true, false})
        expect_analytic_image(parse(nested_balls(7, rising)), 1e-4, 1e-2);
}

TEST(MediumSet, CountsWhatItHasNoRoomFor) {
    Scene scene = parse(nested_balls(17, true));
    scene.render.size = {8, 8};
    scene.render.depth = 1;
    for (Material& material : scene.materials) material.refraction = 0, material.opacity = 0.5f;
    RenderReport report;
    render(test_device(1), scene, report);
    EXPECT_GT(report.medium_overflows, 0u);
}

}  // namespace
}  // namespace voxelume
