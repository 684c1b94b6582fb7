// SPDX-License-Identifier: Apache-2.0
// Frames for which the device has too little memory while other frames or retained results take
// some.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <mutex>

#include "runtime/batch/frame_schedule.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/moving_ball.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr size_t kFrames = 6;

/// Opens a device of 256 MiB.
Device small_device() {
    setenv("VOXELUME_MEMORY_MB", "256", 1);
    const Device device = test_device();
    unsetenv("VOXELUME_MEMORY_MB");
    return device;
}

/// The step in which memory runs out: forming frame 3 while frame 2 is rendered, rendering frame 2
/// while frame 3 is formed, or rendering frame 2 with retained results in memory.
enum class End { none, forming, rendering, kept };

class CrowdedFrames : public testing::Test {
  protected:
    FrameSteps steps(End end) {
        FrameSteps steps{[this, end](size_t frame) { return scene(frame, end); },
                         [this, end](const FrameInput& input) { return render(input, end); }};
        steps.forget = [this](size_t) {
            renderer_ = Renderer(device_);
            filling_ = {};
            ++forgotten_;
        };
        return steps;
    }

    /// Frame 3, in which memory runs out, waits until frame 2 is being rendered, and then takes all
    /// memory.
    Scene scene(size_t frame, End end) {
        if (frame == 3 && forgotten_ == 0 && (end == End::forming || end == End::rendering)) {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return is_rendering_; });
            const uint64_t left = device_.info().memory - device_.counters().bytes_in_use;
            filling_ = Buffer<uint8_t>(device_, "filling", left - (1 << 15));
            changed_.notify_all();
            if (end == End::rendering) changed_.wait(lock, [&] { return has_failed_; });
        }
        return scene_with(0.05 * double(frame) - 0.4);
    }

    std::function<void()> render(const FrameInput& input, End end) {
        RenderReport report;
        report.world = input.report;
        const uint64_t hash =
            oracle::image_hash(*renderer_.image(input.scene, input.world, report));
        if (input.frame == 2 && forgotten_ == 0) meet(end);
        if (input.report.lacks_room) crowded_.push_back(input.frame);
        return [this, hash] { hashes_.push_back(hash); };
    }

    void meet(End end) {
        if (end == End::none) return;
        if (end == End::kept) throw Error(ErrorKind::limit, "there is no memory left");
        std::unique_lock lock(mutex_);
        is_rendering_ = true;
        changed_.notify_all();
        changed_.wait(lock, [&] { return !filling_.empty(); });
        if (end == End::forming) return;
        has_failed_ = true;
        changed_.notify_all();
        const Buffer<uint8_t> image(device_, "image", 1 << 20);
    }

    std::optional<size_t> run(End end, bool overlap = true) {
        forgotten_ = 0;
        hashes_.clear();
        crowded_.clear();
        return run_frames({device_}, kFrames, steps(end), {.overlap = overlap}).one_by_one_from;
    }

    std::vector<uint64_t> expected() {
        run(End::none, false);
        return hashes_;
    }

    Device device_ = small_device();
    Renderer renderer_{device_};
    std::mutex mutex_;
    std::condition_variable changed_;
    bool is_rendering_ = false, has_failed_ = false;
    Buffer<uint8_t> filling_;
    int forgotten_ = 0;
    std::vector<uint64_t> hashes_;
    std::vector<size_t> crowded_;  ///< frames that are told to keep nothing
};

TEST_F(CrowdedFrames, AWorldThatCantBeFormedAlongsideAFrameIsFormedAlone) {
    const std::vector<uint64_t> hashes = expected();
    EXPECT_EQ(run(End::forming), 3u);
    EXPECT_EQ(hashes_, hashes);
}

TEST_F(CrowdedFrames, AFrameThatCantBeRenderedAlongsideAWorldIsRenderedAlone) {
    const std::vector<uint64_t> hashes = expected();
    EXPECT_EQ(run(End::rendering), 2u);
    EXPECT_EQ(hashes_, hashes);
}

TEST_F(CrowdedFrames, OverlapWhereThereIsRoom) {
    const std::vector<uint64_t> hashes = expected();
    EXPECT_EQ(run(End::none), std::nullopt);
    EXPECT_EQ(hashes_, hashes);
    EXPECT_EQ(forgotten_, 0);
    EXPECT_THAT(crowded_, testing::IsEmpty());
}

TEST_F(CrowdedFrames, WhatIsKeptMakesRoomForAFrame) {
    const std::vector<uint64_t> hashes = expected();
    EXPECT_EQ(run(End::kept, false), std::nullopt);
    EXPECT_EQ(hashes_, hashes);
    EXPECT_EQ(forgotten_, int(kFrames) - 2) << "each from the third on";
    EXPECT_THAT(crowded_, testing::ElementsAre(2, 3, 4, 5));
}

TEST_F(CrowdedFrames, WhatDoesNotFitAloneIsAnError) {
    for (const bool overlap : {true, false}) {
        FrameSteps steps = this->steps(End::none);
        steps.scene = [](size_t frame) {
            Scene scene = scene_with(0.05 * double(frame));
            if (frame == 3) scene.world.voxels = glm::ivec3(12000);
            return scene;
        };
        hashes_.clear();
        const Error error =
            error_of([&] { run_frames({device_}, kFrames, steps, {.overlap = overlap}); });
        EXPECT_EQ(error.kind(), ErrorKind::limit) << error.what();
        EXPECT_EQ(hashes_.size(), 3u);
    }
}

TEST_F(CrowdedFrames, NoFrameIsTriedAgainAlongsideWhatCantBeForgotten) {
    FrameSteps steps = this->steps(End::kept);
    steps.forget = {};
    for (const bool overlap : {true, false}) {
        hashes_.clear();
        const Error error =
            error_of([&] { run_frames({device_}, kFrames, steps, {.overlap = overlap}); });
        EXPECT_STREQ(error.what(), "there is no memory left");
        EXPECT_EQ(hashes_.size(), 2u);
    }
}

}  // namespace
}  // namespace voxelume
