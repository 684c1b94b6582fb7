// SPDX-License-Identifier: Apache-2.0
// Frames in order, on one thread and on three, with errors in each step.
#include "runtime/batch/frame_schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "tests/oracles/image_hash.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/moving_ball.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// A run of frames in which an object moves, and what was written of it.
struct FrameRun {
    std::vector<size_t> built, written;
    std::vector<uint64_t> hashes;
    size_t failing_scene = SIZE_MAX, failing_image = SIZE_MAX, failing_file = SIZE_MAX;

    void run(size_t count, bool overlap) {
        const Device& device = shared_device();
        Renderer renderer(device);
        const FrameSteps steps{[&](size_t frame) {
                                   if (frame == failing_scene) throw std::runtime_error("scene");
                                   built.push_back(frame);
                                   return scene_with(0.05 * double(frame / 2) - 0.4);
                               },
                               [&](const FrameInput& input) -> std::function<void()> {
                                   const size_t frame = input.frame;
                                   if (frame == failing_image) throw std::runtime_error("image");
                                   RenderReport report;
                                   report.world = input.report;
                                   const uint64_t hash = oracle::image_hash(
                                       *renderer.image(input.scene, input.world, report));
                                   return [this, frame, hash] {
                                       if (frame == failing_file) throw std::runtime_error("file");
                                       written.push_back(frame);
                                       hashes.push_back(hash);
                                   };
                               }};
        run_frames({device}, count, steps, {.overlap = overlap});
    }
};

std::vector<size_t> first(size_t count) {
    std::vector<size_t> numbers(count);
    for (size_t i = 0; i < count; ++i) numbers[i] = i;
    return numbers;
}

TEST(FramePipeline, WritesTheSameFramesInOrder) {
    FrameRun alone, overlapped;
    alone.run(9, false);
    overlapped.run(9, true);
    EXPECT_EQ(alone.written, first(9));
    EXPECT_EQ(overlapped.written, first(9));
    EXPECT_EQ(alone.hashes, overlapped.hashes);
    EXPECT_EQ(alone.hashes[0], alone.hashes[1]) << "every second frame is still";
    EXPECT_NE(alone.hashes[1], alone.hashes[2]);
}

TEST(FramePipeline, AnErrorEndsTheRunAfterTheFramesBeforeIt) {
    for (const bool overlap : {false, true}) {
        for (const char* step : {"scene", "image", "file"}) {
            FrameRun run;
            (std::string(step) == "scene"   ? run.failing_scene
             : std::string(step) == "image" ? run.failing_image
                                            : run.failing_file) = 4;
            try {
                run.run(50, overlap);
                ADD_FAILURE() << step << " did not fail";
            } catch (const std::runtime_error& error) {
                EXPECT_STREQ(error.what(), step);
            }
            EXPECT_EQ(run.written, first(4)) << step << ", overlap " << overlap;
            EXPECT_LE(run.built.size(), 8u) << step;
        }
    }
}

TEST(FramePipeline, AnErrorOfFormingAWorldNamesItsFrame) {
    for (const bool overlap : {false, true}) {
        FrameSteps steps{[](size_t frame) {
                             Scene scene = scene_with(0.1 * double(frame));
                             if (frame == 2) scene.objects[0].world_from_object[1] = glm::dvec4(0);
                             return scene;
                         },
                         [](const FrameInput&) { return [] {}; },
                         [](size_t frame) { return 10.0 + double(frame); }};
        const Error error =
            error_of([&] { run_frames({shared_device()}, 4, steps, {.overlap = overlap}); });
        EXPECT_EQ(error.kind(), ErrorKind::scene);
        EXPECT_THAT(error.what(), testing::EndsWith(" (at frame 12)"));
    }
}

TEST(FramePipeline, OfTwoErrorsTheEarlierFramesCounts) {
    FrameRun run;
    run.failing_file = 2, run.failing_image = 3;
    EXPECT_THROW(
        {
            try {
                run.run(9, true);
            } catch (const std::runtime_error& error) {
                EXPECT_STREQ(error.what(), "file");
                throw;
            }
        },
        std::runtime_error);
}

TEST(FramePipeline, MemoryDoesNotGrow) {
    const auto in_use = [] { return shared_device().counters().bytes_in_use; };
    const uint64_t before = in_use();
    DeviceCounters& counters = shared_device().counters();
    FrameRun few, many;
    counters.peak_bytes = 0;
    few.run(12, true);
    EXPECT_EQ(in_use(), before);
    const uint64_t peak = counters.peak_bytes;
    counters.peak_bytes = 0;
    many.run(500, true);
    EXPECT_EQ(in_use(), before);
    EXPECT_LE(counters.peak_bytes, peak * 3 / 2);
}

}  // namespace
}  // namespace voxelume
