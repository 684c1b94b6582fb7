// SPDX-License-Identifier: Apache-2.0
// The memory retained for the next frame: in worlds that take less than they may, and in worlds
// that take all of it.
#include <gmock/gmock.h>

#include <cstdlib>

#include "runtime/base/error.hpp"
#include "runtime/batch/frame_schedule.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// A scene of the lens that two balls have in common; the second is `apart` metres above the first.
Scene lens(double apart, int width) {
    const std::string text = fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.005, "bounds": {{"min": [-0.5, -0.5, -0.5], "max": [0.5, 0.6, 0.4]}}}},
"models": {{"lens": {{"shape": "intersection", "parts": [
    {{"shape": "sphere", "radius": 0.35}},
    {{"shape": "sphere", "radius": 0.35, "position": [0, {}, 0]}}], "surface": "smooth"}}}},
"objects": [{{"name": "lens", "model": "lens", "placement": "world"}}],
"lights": [],
"observer": {{"position": [0, 1, -3], "look_at": [0, 0.2, 0],
             "display": {{"shape": "pyramid", "angle": 25}}}},
"render": {{"size": [{}, 48]}}}})",
                                         apart, width);
    return parse_scene(text, "lens.json", {});
}

/// The results of the frames of a scene without motion.
struct Still {
    std::vector<uint64_t> hashes, launches;
    std::vector<bool> lacks_room;
};

Still run(const Scene& scene, const Device& device, bool overlap) {
    Renderer renderer(device);
    Still still;
    FrameSteps steps{[&](size_t) { return scene; },
                     [&](const FrameInput& input) -> std::function<void()> {
                         RenderReport report;
                         report.world = input.report;
                         const uint64_t hash =
                             oracle::image_hash(*renderer.image(input.scene, input.world, report));
                         uint64_t launches = 0;
                         for (const auto& [name, count] : device.counters().launches)
                             launches += count;
                         still.launches.push_back(launches);
                         still.lacks_room.push_back(input.report.lacks_room);
                         return [&still, hash] { still.hashes.push_back(hash); };
                     }};
    steps.forget = [&](size_t) { renderer = Renderer(device); };
    run_frames({device}, 3, steps, {.overlap = overlap});
    return still;
}

/// The peak bytes of a frame's world and image; `follows` says whether the world follows others.
uint64_t peak_of(const Scene& scene, bool follows) {
    const Device device = device_with_memory(2000);
    WorldBuilder builder(device, follows);
    RenderReport report;
    const BuiltWorld world = builder.build(scene, report.world);
    Renderer(device, false).new_image(scene, world, report);
    return device.counters().peak_bytes;
}

TEST(KeptMemory, AStillFrameOfWhatTakesLessThanItMayRunsNoKernel) {
    const Scene scene = lens(0.6, 64);
    const uint64_t megabytes = (peak_of(scene, true) >> 20) + 1;
    const Device device = device_with_memory(megabytes);
    AssetStore meshes;
    EXPECT_GT(plan_scene(scene, meshes).bytes_with_next(), double(device.info().memory));
    for (const bool overlap : {false, true}) {
        device.counters().launches.clear();
        const Still still = run(scene, device, overlap);
        EXPECT_EQ(still.hashes, std::vector(3, still.hashes.at(0)));
        EXPECT_EQ(still.lacks_room, std::vector(3, false)) << overlap;
        EXPECT_GT(still.launches.at(0), 0u);
        EXPECT_EQ(still.launches, std::vector(3, still.launches.at(0))) << overlap;
    }
}

TEST(KeptMemory, TheFirstFrameIsRenderedWithoutKeepingWhatLeavesItNoRoom) {
    const Scene scene = lens(0.25, 85);  // whose rays are one batch of the smallest size
    const uint64_t alone = peak_of(scene, false), kept = peak_of(scene, true);
    const uint64_t megabytes = ((alone + kept) / 2) >> 20;
    ASSERT_GT(megabytes << 20, alone);
    ASSERT_LT(megabytes << 20, kept);
    const uint64_t expected = run(scene, device_with_memory(2000), false).hashes.at(0);
    for (const bool overlap : {false, true}) {
        const Still still = run(scene, device_with_memory(megabytes), overlap);
        EXPECT_EQ(still.hashes, std::vector(3, expected)) << overlap;
        EXPECT_EQ(still.lacks_room, std::vector(3, true)) << overlap;
    }
}

TEST(KeptMemory, WhatDoesNotFitLaterIsToldWithItsPlaceItsSizeAndItsFrame) {
    FrameSteps steps{[](size_t frame) { return lens(frame == 0 ? 0.65 : 0.1, 64); },
                     [](const FrameInput&) { return [] {}; }};
    steps.number = [](size_t frame) { return double(frame + 7); };
    steps.forget = [](size_t) {};
    bool is_models = false, is_worlds = false;
    for (uint64_t megabytes = 4;; ++megabytes) {  // which frame 7 takes
        std::string told;
        try {
            run_frames({device_with_memory(megabytes)}, 2, steps, {.overlap = megabytes % 2 == 0});
            break;
        } catch (const Error& error) {
            ASSERT_EQ(error.kind(), ErrorKind::limit) << error.what();
            told = error.what();
        }
        is_models |= told.find(": models.lens: a grid of 148x128x148 voxels: ") < 20;
        is_worlds |= told.find(": world: a world of 200x220x180 voxels: ") < 20;
        EXPECT_THAT(told, testing::AllOf(testing::HasSubstr(" voxels: the "),
                                         testing::HasSubstr(" buffer needs "),
                                         testing::EndsWith("use larger voxels (at frame 8)")));
    }
    EXPECT_TRUE(is_models);
    EXPECT_TRUE(is_worlds);
}

}  // namespace
}  // namespace voxelume
