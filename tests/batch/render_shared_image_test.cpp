// SPDX-License-Identifier: Apache-2.0
// One image that several devices render together through render_frames().
#include <gtest/gtest.h>

#include <cstdlib>

#include "runtime/batch/render_frames.hpp"
#include "tests/batch/moving_frames.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

/// One image that two devices share.
struct SharedImage {
    Scene scene = moving_scene();
    BatchOptions options;
    int results = 0;

    BatchOutcome run(const std::vector<Device>& devices) {
        options.frames = {3};
        return render_frames(devices, scene, options, [&](const FrameResult& result) {
            ++results;
            EXPECT_EQ(oracle::image_hash(*result.image), hash_alone(3));
        });
    }
};

TEST(RenderSharedImage, IsOneResultOfAllDevices) {
    SharedImage image;
    EXPECT_EQ(image.run(halves()).frames_done, 1u);
    EXPECT_EQ(image.results, 1);
}

TEST(RenderSharedImage, CancelledBetweenTilesGivesNothing) {
    if (!test_device().is_cpu()) GTEST_SKIP() << "one batch of this device holds the image";
    std::stop_source stop;
    SharedImage image;
    int calls = 0;
    image.options.stop = stop.get_token();
    image.options.progress = [&](double done, int) {
        EXPECT_LT(done, 1);
        if (++calls == 3) stop.request_stop();
    };
    const BatchOutcome outcome = image.run(halves());
    EXPECT_TRUE(outcome.is_cancelled);
    EXPECT_EQ(outcome.frames_done, 0u);
    EXPECT_EQ(image.results, 0);
    EXPECT_LE(calls, 4) << "each device ends the tiles that it has";
}

TEST(RenderSharedImage, AnErrorOfOneDeviceEndsTheOthersTiles) {
    if (!test_device().is_cpu()) GTEST_SKIP() << "one batch of this device holds the image";
    SharedImage image;
    int calls = 0;
    image.options.progress = [&](double, int) {
        if (++calls == 3) throw Error(ErrorKind::render, "the device was lost");
    };
    const Error error = error_of([&] { image.run(halves()); });
    EXPECT_STREQ(error.what(), "the device was lost (at frame 3)");
    EXPECT_EQ(image.results, 0);
    EXPECT_EQ(calls, 3) << "nothing is told after an error";
}

TEST(RenderSharedImage, ADeviceWithoutTheMemoryIsTheImagesError) {
    setenv("VOXELUME_MEMORY_MB", "1", 1);
    const Device small = test_device();
    unsetenv("VOXELUME_MEMORY_MB");
    SharedImage image;
    image.scene.world.voxel_size = glm::dvec3(0.005);
    image.scene.world.voxels = glm::ivec3(400);
    for (const bool first : {false, true}) {
        const std::vector<Device> devices =
            first ? std::vector{small, test_device()} : std::vector{test_device(), small};
        EXPECT_EQ(error_of([&] { image.run(devices); }).kind(), ErrorKind::limit) << first;
    }
    EXPECT_EQ(image.results, 0);
}

}  // namespace
}  // namespace voxelume
