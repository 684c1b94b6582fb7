// SPDX-License-Identifier: Apache-2.0
// More than a million reflected and refracted rays, by default a hundred thousand, hit every closed
// surface that they reach.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/pictures/light/leaky_room.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// The picture's edge: `pixels` in exhaustive runs, by default a third of them.
int edge_of(int pixels) {
    return is_exhaustive() ? pixels : pixels / 3;
}

const uint64_t kMinRays = is_exhaustive() ? 1'000'000 : 100'000;

class Leaks : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, Leaks, testing::Values("exact", "smooth"));

Image rendered(const Scene& scene, uint64_t min_secondary_rays) {
    RenderReport report;
    Image image = render(test_device(), scene, report);
    EXPECT_EQ(report.not_finite, 0u);
    EXPECT_GE(report.secondary_rays, min_secondary_rays);
    fmt::print("{} secondary rays\n", report.secondary_rays);
    return image;
}

TEST_P(Leaks, NoRayLeavesAClosedRoom) {
    Scene room = leaky_room(GetParam(), 20);
    resize(room, glm::ivec2(edge_of(192)));
    const Image image = rendered(room, kMinRays);
    size_t leaks = 0;
    for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
        // Every path has a weight of 1/4096 or more, so one leak would show 244.
        leaks += image.planes.at("R")[i] > 2 || image.id_planes.at("objectId")[i] == 0;
    }
    EXPECT_EQ(leaks, 0u);
}

/// A bubble of 0.1 m in the middle of 1 m of glass, before a white background. Total reflection
/// can't trap rays that enter. The glass's thickest part lets half of the red light through.
Scene bubble(const std::string& surface) {
    return parse_scene(R"({"voxelume": 1,
"world": {"voxel_size": 0.0125, "bounds": {"min": [-0.5, -0.5, -0.5], "max": [0.5, 0.5, 0.5]}, "background": [1, 1, 1]},
"materials": {"air": {"diffuse": 0, "refraction": 1, "ior": 0.75, "absorption": [3.4657359, 0, 0]}},
"models": {"ball": {"shape": "sphere", "radius": 0.1, "surface": ")" +
                           surface + R"("}},
"objects": [{"model": "ball", "material": "air", "position": [0.003, -0.004, 0.001]}],
"lights": [],
"observer": {"position": [0.1, 0.2, -0.6], "look_at": [0, 0, 0], "display": {"shape": "box", "size": [0.2, 0.2, 3]}},
"render": {"size": [940, 940]}})",
                       "test.json", {});
}

TEST_P(Leaks, NoRayMissesTheBackOfABubble) {
    Scene scene = bubble(GetParam());
    resize(scene, glm::ivec2(edge_of(940)));
    const Image image = rendered(scene, kMinRays);
    size_t missed = 0, met = 0;
    for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
        if (image.id_planes.at("objectId")[i] == 0) continue;
        ++met;
        // A ray that passes on to the world's end would keep at most a quarter.
        missed += image.planes.at("R")[i] < 0.499f || image.planes.at("G")[i] != 1;
    }
    EXPECT_EQ(missed, 0u) << "of " << met;
    EXPECT_GT(met, kMinRays * 6 / 10);
}

}  // namespace
}  // namespace voxelume
