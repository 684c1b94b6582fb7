// SPDX-License-Identifier: Apache-2.0
// A whole run of frames through render_frames(): its results, their order, and how it ends early.
#include "runtime/batch/render_frames.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "runtime/render/volume_renderer.hpp"
#include "tests/batch/moving_frames.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using testing::ElementsAre;

/// The way of a run: whether two devices take part, and whether their frames overlap.
struct Way {
    const char* name;
    bool two_devices;
    bool overlap;
};

/// The results of a run.
struct Results {
    std::vector<int> frames;
    std::vector<uint64_t> hashes;
    BatchOutcome outcome;
    std::string error;  ///< the thrown sentence; empty if there is none
};

class RenderFrames : public testing::TestWithParam<Way> {
  protected:
    BatchOptions options(std::vector<int> frames) const {
        BatchOptions options;
        options.frames = std::move(frames);
        options.overlap = GetParam().overlap;
        return options;
    }
    /// Calls `after` after each result.
    Results run(const BatchOptions& options,
                const std::function<void(const FrameResult&)>& after = {}) const {
        Results results;
        try {
            results.outcome =
                render_frames(devices_, moving_scene(), options, [&](const FrameResult& result) {
                    results.frames.push_back(result.report.frame);
                    results.hashes.push_back(oracle::image_hash(*result.image));
                    if (after) after(result);
                });
        } catch (const std::exception& error) {
            results.error = error.what();
        }
        return results;
    }

    std::vector<Device> devices_ = GetParam().two_devices ? halves() : std::vector{test_device()};
};

TEST_P(RenderFrames, GivesTheFramesInTheOrderAskedForAndTheirReports) {
    BatchOptions batch = options({4, 2, 2, 7});
    double last = 0;
    batch.progress = [&](double done, int frame) {
        EXPECT_GT(done, last);
        EXPECT_THAT(frame, testing::AnyOf(2, 4, 7));
        last = done;
    };
    const Results results = run(batch, [&](const FrameResult& result) {
        EXPECT_GE(result.report.report.sight_rays, 45u * 31u);
        EXPECT_LT(result.report.device, devices_.size());
        EXPECT_EQ(result.volume, nullptr);
    });
    EXPECT_EQ(results.error, "");
    EXPECT_EQ(last, 1);
    EXPECT_THAT(results.frames, ElementsAre(4, 2, 2, 7));
    EXPECT_THAT(results.hashes,
                ElementsAre(hash_alone(4), hash_alone(2), hash_alone(2), hash_alone(7)));
    EXPECT_EQ(results.outcome.frames_done, 4u);
    EXPECT_FALSE(results.outcome.is_cancelled);
    EXPECT_EQ(results.outcome.one_by_one_from, std::nullopt);
}

TEST_P(RenderFrames, GivesVolumesAloneOrAlongsideImages) {
    RenderReport report;
    const Volume expected = render_volume(test_device(), scene_at(moving_scene(), 3), report);
    for (const bool image : {false, true}) {
        BatchOptions batch = options({1, 3});
        batch.image = image;
        batch.volume = true;
        double last = 0;
        batch.progress = [&](double done, int) { last = done; };
        std::vector<FrameResult> results;
        render_frames(devices_, moving_scene(), batch,
                      [&](const FrameResult& result) { results.push_back(result); });
        ASSERT_EQ(results.size(), 2u);
        EXPECT_EQ(last, 1);
        EXPECT_EQ(results[1].image != nullptr, image);
        EXPECT_EQ(results[1].volume->indices, expected.indices);
        EXPECT_EQ(results[1].volume->colors, expected.colors);
        EXPECT_NE(results[0].volume->indices, expected.indices);
    }
}

TEST_P(RenderFrames, CancelledByTheOutputEndWithTheResultThatItTook) {
    std::stop_source stop;
    BatchOptions batch = options({1, 2, 3, 4, 5, 6, 7, 8, 9});
    batch.stop = stop.get_token();
    const Results results = run(batch, [&](const FrameResult& result) {
        if (result.report.frame == 3) stop.request_stop();
    });
    EXPECT_EQ(results.error, "");
    EXPECT_THAT(results.frames, ElementsAre(1, 2, 3));
    EXPECT_THAT(results.hashes, ElementsAre(hash_alone(1), hash_alone(2), hash_alone(3)));
    EXPECT_EQ(results.outcome.frames_done, 3u);
    EXPECT_TRUE(results.outcome.is_cancelled);
}

TEST_P(RenderFrames, CancelledInTheMiddleOfAFrameEndBeforeItsNextBatch) {
    if (!devices_[0].is_cpu()) GTEST_SKIP() << "one batch of this device holds the image";
    std::stop_source stop;
    Scene scene = moving_scene();
    // Each image takes several batches of rays.
    resize(scene, {500, 300});
    scene.observer.display.voxels = {500, 300, 2};
    for (const bool volume : {false, true}) {
        BatchOptions batch = options({1, 2});
        batch.image = !volume;
        batch.volume = volume;
        batch.stop = stop.get_token();
        std::atomic<int> calls = 0;
        batch.progress = [&](double done, int) {
            EXPECT_LT(done, 0.5);
            ++calls;
            stop.request_stop();
        };
        const BatchOutcome outcome = render_frames(devices_, scene, batch, [](const FrameResult&) {
            ADD_FAILURE() << "a frame that isn't whole";
        });
        EXPECT_TRUE(outcome.is_cancelled);
        EXPECT_EQ(outcome.frames_done, 0u);
        EXPECT_LE(calls, 2) << "each device ends the batch that it has";
        stop = std::stop_source();
    }
}

TEST_P(RenderFrames, CancelledBeforeTheyBeginGiveNothing) {
    std::stop_source stop;
    stop.request_stop();
    for (const std::vector<int>& frames : {std::vector{1}, std::vector{1, 2, 3}}) {
        BatchOptions batch = options(frames);
        batch.stop = stop.get_token();
        batch.progress = [](double, int) { ADD_FAILURE() << "something was rendered"; };
        const Results results = run(batch);
        EXPECT_EQ(results.error, "");
        EXPECT_THAT(results.frames, testing::IsEmpty());
        EXPECT_TRUE(results.outcome.is_cancelled);
    }
}

TEST_P(RenderFrames, CancelledAfterTheLastResultAreDone) {
    std::stop_source stop;
    BatchOptions batch = options({1, 2});
    batch.stop = stop.get_token();
    const Results results = run(batch, [&](const FrameResult& result) {
        if (result.report.frame == 2) stop.request_stop();
    });
    EXPECT_EQ(results.outcome.frames_done, 2u);
    EXPECT_FALSE(results.outcome.is_cancelled);
}

TEST_P(RenderFrames, CancelledByAnotherThreadGiveWholeFramesOnly) {
    std::stop_source stop;
    BatchOptions batch = options(std::vector<int>(500, 1));
    for (size_t i = 0; i < batch.frames.size(); ++i) batch.frames[i] = 1 + int(i % 5);
    batch.stop = stop.get_token();
    std::jthread other;
    const Results results = run(batch, [&](const FrameResult&) {
        if (!other.joinable()) other = std::jthread([&] { stop.request_stop(); });
    });
    EXPECT_EQ(results.error, "");
    EXPECT_TRUE(results.outcome.is_cancelled);
    EXPECT_EQ(results.frames.size(), results.outcome.frames_done);
    for (size_t i = 0; i < results.frames.size(); ++i)
        EXPECT_EQ(results.hashes[i], hash_alone(results.frames[i])) << i;
}

TEST_P(RenderFrames, AnErrorOfTheOutputEndsTheRunAndLeavesTheDevicesUsable) {
    const auto fail = [](const FrameResult& result) {
        if (result.report.frame == 3) throw std::runtime_error("the disk is full");
    };
    const Results results = run(options({1, 2, 3, 4, 5, 6, 7, 8, 9}), fail);
    EXPECT_EQ(results.error, "the disk is full");
    EXPECT_THAT(results.frames, ElementsAre(1, 2, 3));
    EXPECT_EQ(run(options({3}), fail).error, "the disk is full");
    EXPECT_THAT(run(options({3, 4})).hashes, ElementsAre(hash_alone(3), hash_alone(4)));
}

TEST_P(RenderFrames, AnErrorOfADeviceComesAfterTheFramesBeforeItWithTheFramesNumber) {
    BatchOptions batch = options({1, 2, 3, 4, 5});
    batch.progress = [](double, int frame) {
        if (frame == 3) throw Error(ErrorKind::render, "the device was lost");
    };
    const Results results = run(batch);
    EXPECT_EQ(results.error, "the device was lost (at frame 3)");
    EXPECT_THAT(results.frames, ElementsAre(1, 2));
    batch.frames = {3};
    EXPECT_EQ(run(batch).error, "the device was lost (at frame 3)");
}

TEST_P(RenderFrames, AFrameThatFitsNoDeviceIsToldBeforeAnyIsRendered) {
    Scene scene = moving_scene();
    scene.world.voxels = glm::ivec3(60000);
    const Error error = error_of([&] {
        render_frames(devices_, scene, options({1, 2}),
                      [](const FrameResult&) { ADD_FAILURE() << "it fits"; });
    });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
}

INSTANTIATE_TEST_SUITE_P(Ways, RenderFrames,
                         testing::Values(Way{"Overlapped", false, true},
                                         Way{"OneByOne", false, false},
                                         Way{"TwoDevices", true, true}),
                         [](const auto& way) { return std::string(way.param.name); });

}  // namespace
}  // namespace voxelume
