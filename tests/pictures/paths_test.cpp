// SPDX-License-Identifier: Apache-2.0
// Rays that are reflected, refracted or go straight on: the rules that hold for every scene.
// whitted_test.cpp compares colours with an analytic tracer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/render/illumination.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/trace/sight.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/light/leaky_room.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using testing::Contains;
using testing::Key;
using testing::Not;

constexpr const char* kColors[] = {"R", "G", "B"};

struct PathImage {
    Image image;
    RenderReport report;
    DeviceCounters counters;
};

PathImage path_image(const Scene& scene, int lanes = 0) {
    const Device device = test_device(lanes);
    PathImage result;
    result.image = render(device, scene, result.report);
    result.counters = device.counters();
    EXPECT_EQ(result.report.not_finite, 0u);
    return result;
}

/// A scene with a red and white floor and a blue ball behind the `objects` (which begin with a
/// comma).
Scene scene_with(const std::string& materials, const std::string& objects,
                 const std::string& more_render = "", const std::string& surface = "exact") {
    const std::string text = R"({"voxelume": 1,
"world": {"voxel_size": 0.04, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
          "background": [0.25, 0.5, 0.75], "ambient": [0.1, 0.2, 0.3]},
"materials": {"floor": {"color": [0.9, 0.1, 0.1], "checker": {"color": [0.9, 0.9, 0.9], "size": [0.3, 0, 0.3]}},
              "blue": {"color": [0.1, 0.2, 0.9], "specular": 0.5})" +
                             (materials.empty() ? "" : ",\n" + materials) + R"(},
"models": {"floor": {"shape": "box", "size": [1.8, 0.1, 1.8], "surface": ")" +
                             surface + R"("},
           "ball": {"shape": "sphere", "radius": 0.3, "surface": ")" +
                             surface + R"("},
           "block": {"shape": "box", "size": [0.6, 0.6, 0.1], "surface": ")" +
                             surface + R"("}},
"objects": [{"model": "floor", "material": "floor", "position": [0, -0.6, 0]},
            {"model": "ball", "material": "blue", "position": [0.2, -0.2, 0.5]})" +
                             objects + R"(],
"lights": [{"type": "point", "position": [0.7, 0.9, -0.8], "intensity": 1.5}],
"observer": {"position": [0, 0.2, -2.5], "look_at": [0, -0.2, 0],
             "display": {"shape": "pyramid", "angle": 40}},
"render": {"size": [64, 48])" +
                             more_render + "}}";
    return parse_scene(text, "test.json", {});
}

constexpr const char* kGhost =
    R"("ghost": {"diffuse": 0, "specular": 0, "refraction": 1, "ior": 1})";
constexpr const char* kGhostBall =
    R"(, {"model": "ball", "material": "ghost", "position": [0, 0, -0.3]})";

class AllSurfaces : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Paths, AllSurfaces, testing::Values("exact", "smooth"));

TEST_P(AllSurfaces, O6ABallOfTheSpacesOwnIndexIsInvisibleToTheBit) {
    const PathImage bare =
        path_image(scene_with(kGhost, "", R"(, "shadow": "filtered")", GetParam()));
    const PathImage ghost =
        path_image(scene_with(kGhost, kGhostBall, R"(, "shadow": "filtered")", GetParam()));
    EXPECT_GT(ghost.report.secondary_rays, 500u);
    for (const char* color : kColors)
        EXPECT_EQ(ghost.image.planes.at(color), bare.image.planes.at(color)) << color;
}

TEST_P(AllSurfaces, ABallOfNoOpacityIsInvisibleToTheBit) {
    const PathImage bare = path_image(scene_with("", "", "", GetParam()));
    const PathImage ghost = path_image(scene_with(
        R"("ghost": {"specular": 1, "reflection": 1, "opacity": 0})", kGhostBall, "", GetParam()));
    EXPECT_GT(ghost.report.secondary_rays, 500u);
    for (const char* plane : {"R", "G", "B", "A"})
        EXPECT_EQ(ghost.image.planes.at(plane), bare.image.planes.at(plane)) << plane;
}

TEST(Paths, AMirrorWithoutDepthReflectsNothing) {
    const std::string materials = R"("mirror": {"diffuse": 0, "reflection": 1})";
    const std::string objects =
        R"(, {"model": "block", "material": "mirror", "position": [0, 0, 0]})";
    const PathImage flat = path_image(scene_with(materials, objects, R"(, "depth": 0)"));
    const PathImage deep = path_image(scene_with(materials, objects, R"(, "depth": 1)"));
    EXPECT_EQ(flat.report.secondary_rays, 0u);
    EXPECT_THAT(flat.counters.launches, Not(Contains(Key(std::string("scatter_rays")))));
    EXPECT_GT(deep.report.secondary_rays, 100u);
    const size_t middle = 24 * 64 + 32;
    EXPECT_EQ(flat.image.planes.at("B")[middle], 0.0f);
    EXPECT_GT(deep.image.planes.at("B")[middle], 0.2f);
}

TEST(Paths, PanesCoverWhatLiesBehindByTheirOpacity) {
    // The scene has three panes of opacity 0.25, 0.5 and 0.75 before the background, with ambient
    // light alone; each pane has two faces.
    const std::string text = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
          "background": [0.25, 0.5, 0.75], "ambient": [1, 1, 1]},
"materials": {"a": {"color": [1, 0, 0], "opacity": 0.25}, "b": {"color": [0, 1, 0], "opacity": 0.5},
              "c": {"color": [0, 0, 1], "opacity": 0.75}},
"models": {"pane": {"shape": "box", "size": [1, 1, 0.1], "surface": "exact"}},
"objects": [{"model": "pane", "material": "a", "position": [0, 0, -0.5]},
            {"model": "pane", "material": "b", "position": [0, 0, 0]},
            {"model": "pane", "material": "c", "position": [0, 0, 0.5]}],
"lights": [],
"observer": {"position": [0, 0, -3], "look_at": [0, 0, 0],
             "display": {"shape": "box", "size": [0.5, 0.5, 5]}},
"render": {"size": [4, 4]}})";
    double color[3] = {0.25, 0.5, 0.75}, covered = 0;
    for (const auto& [channel, opacity] : {std::pair{2, 0.75}, {1, 0.5}, {0, 0.25}})
        for (int face = 0; face < 2; ++face) {
            for (int c = 0; c < 3; ++c)
                color[c] = opacity * (c == channel ? 1 : 0) + (1 - opacity) * color[c];
            covered = opacity + (1 - opacity) * covered;
        }
    const PathImage r = path_image(parse_scene(text, "test.json", {}));
    for (int c = 0; c < 3; ++c)
        for (const float value : r.image.planes.at(kColors[c])) EXPECT_NEAR(value, color[c], 1e-6);
    for (const float value : r.image.planes.at("A")) EXPECT_NEAR(value, covered, 1e-6);
}

TEST_P(AllSurfaces, LanesDoNotChangeABit) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    const Scene scene = leaky_room(GetParam(), 5);
    const uint64_t expected = oracle::image_hash(path_image(scene, 1).image);
    const size_t turn = GetParam() == std::string("exact") ? 1 : 2;
    for (const int lanes : in_turn<int>({4, 8, 16}, turn))
        EXPECT_EQ(oracle::image_hash(path_image(scene, lanes).image), expected)
            << lanes << " lanes";
}

TEST(Paths, AreCompactedWithoutChangingABit) {
    const Device device = test_device();
    const Scene scene = leaky_room("smooth", 4);
    WorldReport report;
    const Pyramid world = build_world(device, scene, report);
    const Features features = features_of(scene, world);
    const Camera camera = camera_of(scene, world.frame);
    const uint32_t tiles = 64, indices = tiles * 16;
    std::vector<float> light[2];
    for (const bool compact : {false, true}) {
        RayBatch batch = allocate_batch(device, features, indices);
        Illumination illumination(device, features, scene, world, indices, compact);
        SightStage(device, features, camera).cast(shape_of(world), 1000, tiles, batch);
        illumination.light(batch, indices);
        light[compact] = batch.radiance.read();
    }
    EXPECT_EQ(light[0], light[1]);
}

TEST(Paths, MoreRaysThanPlacesAreFollowedInParts) {
    const Device device = test_device();
    const Scene scene = leaky_room("exact", 6);
    WorldReport report;
    const Pyramid world = build_world(device, scene, report);
    const Features features = features_of(scene, world);
    const Camera camera = camera_of(scene, world.frame);
    std::vector<float> light[2];
    for (const uint32_t tiles : {4u, 64u}) {
        std::vector<float>& all = light[tiles == 64];
        RayBatch batch = allocate_batch(device, features, tiles * 16);
        Illumination illumination(device, features, scene, world, tiles * 16);
        SightStage stage(device, features, camera);
        for (uint32_t first = 0; first < 64; first += tiles) {
            stage.cast(shape_of(world), 1100 + first, tiles, batch);
            illumination.light(batch, tiles * 16);
            for (uint32_t ray = 0; ray < tiles * 16; ++ray)
                for (uint32_t c = 0; c < 3; ++c)
                    all.push_back(batch.radiance.read_one(c * batch.stride + ray));
        }
    }
    EXPECT_EQ(light[0], light[1]);
}

TEST(Paths, AreNotThereInAnOpaqueScene) {
    const PathImage plain = path_image(scene_with(kGhost, ""));  // nothing shows the material
    for (const char* kernel : {"begin_paths", "pass_layer", "scatter_rays", "gather_light"})
        EXPECT_THAT(plain.counters.launches, Not(Contains(Key(std::string(kernel))))) << kernel;
    for (const char* buffer :
         {"paths", "path starts", "path media", "sides", "transmittance", "coverage", "ranks",
          "node light", "path children", "path child weights"})
        EXPECT_THAT(plain.counters.allocated_bytes, Not(Contains(Key(std::string(buffer)))))
            << buffer;
    const Features f = features_of(scene_with(kGhost, ""), {});
    EXPECT_FALSE(f.paths || f.transmission || f.refracts || f.absorbs || f.filter ||
                 f.filtered_refraction);

    const PathImage mirror = path_image(
        scene_with(R"("mirror": {"reflection": 1})",
                   R"(, {"model": "block", "material": "mirror", "position": [0, 0, 0]})"));
    EXPECT_THAT(mirror.counters.launches, Contains(Key(std::string("scatter_rays"))));
    EXPECT_THAT(mirror.counters.launches, Not(Contains(Key(std::string("pass_layer")))));
    for (const char* buffer : {"path starts", "path media", "coverage", "node light"})
        EXPECT_THAT(mirror.counters.allocated_bytes, Not(Contains(Key(std::string(buffer)))))
            << buffer;
}

TEST(Paths, OfLittleWeightEndAndAreCounted) {
    const std::string materials = R"("dim": {"diffuse": 0, "reflection": 0.001})";
    const std::string objects = R"(, {"model": "block", "material": "dim", "position": [0, 0, 0]})";
    const PathImage kept = path_image(scene_with(materials, objects, R"(, "least_weight": 0)"));
    const PathImage ended = path_image(scene_with(materials, objects, R"(, "least_weight": 0.01)"));
    EXPECT_GT(kept.report.secondary_rays, 100u);
    EXPECT_EQ(kept.report.ended_paths, 0u);
    EXPECT_EQ(ended.report.secondary_rays, 0u);
    EXPECT_EQ(ended.report.ended_paths, kept.report.secondary_rays);
}

}  // namespace
}  // namespace voxelume
