// SPDX-License-Identifier: Apache-2.0
// The device memory of rays, planned before the world is formed, against what they took.
#include "runtime/stages/trace/ray_arrays.hpp"
#include "runtime/scene_file/read_scene.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "runtime/memory/plan.hpp"
#include "runtime/render/renderer.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// A room of six walls around the observer, with a ball in it.
struct Room {
    const char* wall = "{}";  ///< materials
    const char* ball = "{}";
    const char* lights = "[]";
    const char* surface = "cubes";
    const char* placement = "world";
    int depth = 5;
    glm::ivec2 size = {200, 152};
};

Scene scene_of(const Room& room) {
    std::string objects;
    for (const char* axis : {"x", "y", "z"})
        for (const char* side : {"-0.9", "0.9"})
            objects += fmt::format(
                R"({{"name": "{0}{1}", "model": "{0}", "material": "wall", "placement": "{2}",
                     "position": [{3}, {4}, {5}]}},)",
                axis, side, room.placement, *axis == 'x' ? side : "0", *axis == 'y' ? side : "0",
                *axis == 'z' ? side : "0");
    const std::string text = fmt::format(
        R"({{"voxelume": 1,
"world": {{"voxel_size": 0.1, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}}}},
"materials": {{"wall": {0}, "ball": {1}}},
"models": {{"x": {{"shape": "box", "size": [0.2, 2, 2], "surface": "{3}"}},
           "y": {{"shape": "box", "size": [2, 0.2, 2], "surface": "{3}"}},
           "z": {{"shape": "box", "size": [2, 2, 0.2], "surface": "{3}"}},
           "ball": {{"shape": "sphere", "radius": 0.15, "surface": "{3}"}}}},
"objects": [{4} {{"name": "ball", "model": "ball", "material": "ball", "placement": "{5}",
             "position": [0.1, -0.4, -0.3]}}],
"lights": {2},
"observer": {{"position": [0.1, 0.2, 0.6], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angles": [90, 80], "near": 0.01, "far": 4,
                         "voxels": [8, 8, 8]}}}},
"render": {{"size": [{6}, {7}], "depth": {8}}}}})",
        room.wall, room.ball, room.lights, room.surface, objects, room.placement, room.size.x,
        room.size.y, room.depth);
    return parse_scene(text, "room.json", {});
}

constexpr const char* kPointLight = R"([{"type": "point", "position": [0.3, 0.5, 0.2]}])";
constexpr const char* kMirror = R"({"reflection": 0.9})";
constexpr const char* kGlass = R"({"refraction": 0.9, "reflection": 0.1, "ior": 1.5})";

RayBytes planned(const Scene& scene) {
    AssetStore meshes;
    return plan_scene(scene, meshes, test_device().info()).rays;
}

/// The peak bytes of a frame's rays, with some small tables.
double taken(const Scene& scene) {
    const Device device = test_device();
    RenderReport report;
    const BuiltWorld world = WorldBuilder(device, false).build(scene, report.world);
    DeviceCounters& counters = device.counters();
    const uint64_t before = counters.peak_bytes = counters.bytes_in_use;
    Renderer(device, false).new_image(scene, world, report);
    EXPECT_EQ(report.sight_rays, uint64_t(scene.render.size.x) * uint64_t(scene.render.size.y));
    return double(counters.peak_bytes - before) - image_bytes(scene.render);
}

TEST(RayArrays, ArePlannedAsLargeAsTheyAre) {
    const char* fog = R"({"opacity": 0.5})";
    for (const Room& room :
         {Room{}, Room{.lights = kPointLight}, Room{.lights = kPointLight, .surface = "exact"},
          Room{.ball = fog, .lights = kPointLight},
          Room{.wall = kMirror, .lights = kPointLight, .depth = 8},
          Room{.wall = kMirror, .surface = "exact", .placement = "instance", .depth = 3},
          Room{.wall = kGlass, .ball = kGlass, .lights = kPointLight, .depth = 2}}) {
        const Scene scene = scene_of(room);
        const double bytes = taken(scene), plan = planned(scene).maximum();
        SCOPED_TRACE(fmt::format("{} {} {} {}", room.wall, room.ball, room.surface, room.depth));
        EXPECT_GT(plan, 0.98 * bytes);
        EXPECT_LT(plan, 1.02 * bytes);
    }
}

TEST(RayArrays, OfALargeImageAreThoseOfOneBatch) {
    for (const char* wall : {"{}", kMirror}) {
        const Scene scene = scene_of({.wall = wall, .depth = 3, .size = {600, 400}});
        const double bytes = taken(scene), plan = planned(scene).maximum();
        EXPECT_GT(plan, 0.95 * bytes) << wall << ": beams come to it";
        EXPECT_LT(plan, 1.02 * bytes) << wall;
    }
}

TEST(RayArrays, OfDepthsThatFewRaysReachLieBetweenMinimumAndMaximum) {
    const Scene scene = scene_of({.ball = kMirror, .depth = 12});
    const double bytes = taken(scene);
    const RayBytes plan = planned(scene);
    EXPECT_LT(plan.minimum(), 1.02 * bytes);
    EXPECT_GT(plan.maximum(), bytes);
    EXPECT_EQ(plan.depth, 12u);
}

TEST(RayArrays, OfPathsThatEndForTheirWeightArePlannedUpToThere) {
    // 0.2^5 is above 1/4096 and 0.2^6 below: arrays for the sixth depth are made and get no rays.
    const Scene scene = scene_of({.wall = R"({"reflection": 0.2})", .depth = 64});
    const RayBytes plan = planned(scene);
    EXPECT_EQ(plan.depth, 6u);
    EXPECT_NEAR(plan.maximum() / taken(scene), 1, 0.02);
}

TEST(RayArrays, LeaveHitsOutForWhichTheyLeaveNoRoom) {
    const Scene scene = scene_of({.wall = kMirror, .depth = 16, .size = {512, 256}});
    RenderReport report;
    const Device large = test_device();
    const uint64_t expected = oracle::image_hash(render(large, scene, report));
    const Device device = device_with_memory((large.counters().peak_bytes >> 20) + 2);
    const BuiltWorld world = WorldBuilder(device).build(scene, report.world);
    Renderer renderer(device);
    EXPECT_EQ(oracle::image_hash(*renderer.image(scene, world, report)), expected);
}

TEST(RayArrays, ThatDoNotFitAskForFewerRays) {
    DeviceInfo info;
    info.name = "Small One";
    info.memory = info.max_allocation = 20'000'000;
    AssetStore meshes;
    Scene scene = scene_of({.wall = kMirror, .lights = kPointLight, .size = {400, 300}});
    const auto refusal = [&] {
        const ScenePlan plan = plan_scene(scene, meshes);
        const Error error = error_of([&] { check_memory(scene, plan, info); });
        EXPECT_EQ(error.kind(), ErrorKind::limit);
        return std::string(error.what());
    };
    EXPECT_THAT(refusal(), testing::AllOf(testing::HasSubstr("an image of 400x300 pixels needs "),
                                          testing::HasSubstr(" of them for rays, where 20.0 MB "),
                                          testing::EndsWith(": render a smaller one, or with less "
                                                            "depth")));
    scene.render.samples = 4;
    EXPECT_THAT(refusal(), testing::EndsWith(": render a smaller one, or with fewer samples a "
                                             "pixel, or with less depth"));
}

/// The plan can't foresee how many rays are followed. Their arrays' allocation tells, and fewer
/// rays pass through the stages together.
TEST(RayArrays, ThatDoNotFitBecomeSmallerWithTheSameBits) {
    const Scene scene =
        scene_of({.wall = kMirror, .lights = kPointLight, .depth = 16, .size = {256, 128}});
    RenderReport report;
    const uint64_t expected = oracle::image_hash(render(test_device(), scene, report));
    const Device device = device_with_memory(24);
    AssetStore meshes;
    EXPECT_NO_THROW(check_memory(scene, plan_scene(scene, meshes), device.info()));
    const uint32_t rays = device.batch_rays();
    EXPECT_EQ(oracle::image_hash(render(device, scene, report)), expected);
    EXPECT_LT(device.batch_rays(), rays);
    EXPECT_GE(device.batch_rays(), 4096u);
    EXPECT_THAT(error_of([&] { allocate_batch(device, Features(), 1u << 20); }).what(),
                testing::AllOf(testing::StartsWith("the "), testing::HasSubstr(" buffer needs "),
                               testing::EndsWith(": render a smaller image, or with fewer samples "
                                                 "a pixel or less depth")));
}

}  // namespace
}  // namespace voxelume
