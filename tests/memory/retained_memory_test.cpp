// SPDX-License-Identifier: Apache-2.0
// Models that come back are retained in a part of the device's memory, and never take a frame's
// memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>

#include "runtime/analysis/model_last_uses.hpp"
#include "runtime/batch/frame_schedule.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr int kModels = 10;

/// A scene text of one object that goes twice through ten spheres, from frame to frame.
std::string scene_text(const std::string& placement) {
    std::string models, keys;
    for (int i = 0; i < 2 * kModels; ++i) {
        const char* comma = i == 0 ? "" : ", ";
        if (i < kModels)
            models += fmt::format(
                R"({}"s{}": {{"shape": "sphere", "radius": {}, "voxel_size": 0.00667, "surface": "smooth"}})",
                comma, i, 0.35 - 0.002 * i);
        keys += fmt::format(R"({}{{"frame": {}, "value": "s{}"}})", comma, i + 1, i % kModels);
    }
    return fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.01, "bounds": {{"min": [-0.5, -0.5, -0.5], "max": [0.5, 0.5, 0.5]}},
          "ambient": [0.2, 0.2, 0.2]}},
"models": {{{}}},
"objects": [{{"name": "o", "model": "s0", "placement": "{}"}}],
"lights": [],
"observer": {{"position": [0, 1, -3], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 25}}}},
"render": {{"size": [64, 48]}},
"animation": {{"frames": 20, "tracks": [{{"target": "objects.o.model", "keys": [{}]}}]}}}})",
                       models, placement, keys);
}

/// The results of rendering frames.
struct Rendered {
    std::optional<size_t> alone;
    int forgotten = 0;
    uint64_t voxelized = 0, indexed = 0, peak = 0, memory = 0;
    std::vector<uint64_t> hashes;
};

class RetainedMemory : public FileTest, public testing::WithParamInterface<const char*> {
  protected:
    /// Renders the first `count` frames on a device with that many megabytes.
    Rendered run(uint64_t megabytes, int count, bool overlap) {
        const Scene moving = parse_scene(scene_text(GetParam()), folder / "scene.json", {});
        const Device device = device_with_memory(megabytes);
        Renderer renderer(device);
        std::vector<int> frames(static_cast<size_t>(count));
        std::iota(frames.begin(), frames.end(), 1);
        const std::vector<size_t> last_use = last_uses(moving, frames);
        Rendered rendered;
        FrameSteps steps{[&](size_t frame) { return scene_at(moving, frames[frame]); },
                         [&](const FrameInput& input) -> std::function<void()> {
                             RenderReport report;
                             report.world = input.report;
                             rendered.voxelized += input.report.voxelized;
                             rendered.indexed += input.report.instances.indexed;
                             const uint64_t hash = oracle::image_hash(
                                 *renderer.image(input.scene, input.world, report));
                             return [&rendered, hash] { rendered.hashes.push_back(hash); };
                         }};
        steps.retained = [&](size_t frame) {
            std::vector<bool> retained(last_use.size());
            for (size_t i = 0; i < last_use.size(); ++i) retained[i] = last_use[i] > frame + 1;
            return retained;
        };
        steps.forget = [&](size_t) {
            renderer = Renderer(device);
            ++rendered.forgotten;
        };
        rendered.alone =
            run_frames({device}, frames.size(), steps, {.overlap = overlap}).one_by_one_from;
        device.finish();
        rendered.peak = device.counters().peak_bytes;
        rendered.memory = device.info().memory;
        return rendered;
    }
};

TEST_P(RetainedMemory, FramesOverlapThoughAllModelsComeBack) {
    const Rendered small = run(16, 2 * kModels, true);
    EXPECT_EQ(small.alone, std::nullopt);
    EXPECT_EQ(small.forgotten, 0);
    EXPECT_EQ(small.hashes, run(2000, 2 * kModels, true).hashes);
}

TEST_P(RetainedMemory, IsAnEighthOfTheDevices) {
    const Rendered once = run(64, kModels, false), twice = run(64, 2 * kModels, false);
    EXPECT_EQ(twice.forgotten, 0);
    EXPECT_LE(twice.peak, once.peak + twice.memory / 8);
    EXPECT_GT(twice.peak, once.peak);
    EXPECT_LT(twice.voxelized, 2u * kModels) << "some waited";
    const Rendered large = run(2000, 2 * kModels, false);
    EXPECT_EQ(large.voxelized, uint64_t{kModels});
    EXPECT_LE(large.indexed, uint64_t{kModels});
    EXPECT_EQ(large.hashes, twice.hashes);
}

TEST_P(RetainedMemory, MakesRoomForAWorldThatHasNone) {
    const Scene moving = parse_scene(scene_text(GetParam()), folder / "scene.json", {});
    const Device device = device_with_memory(64);
    WorldBuilder builder(device);
    const std::vector<bool> retained(kModels, true);
    WorldReport report;
    for (const int frame : {1, 2, 3, 4}) builder.build(scene_at(moving, frame), report, retained);
    const uint64_t left = device.info().memory - device.counters().bytes_in_use;
    const Buffer<uint8_t> filling(device, "filling", left - (1 << 16));
    WorldReport fifth, again;
    EXPECT_NO_THROW(builder.build(scene_at(moving, 5), fifth, retained));
    builder.build(scene_at(moving, 1), again, retained);
    EXPECT_EQ(again.voxelized, 1u);
}

INSTANTIATE_TEST_SUITE_P(Placements, RetainedMemory, testing::Values("world", "instance"),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace voxelume
