// SPDX-License-Identifier: Apache-2.0
// Where the samples of pixels lie in these if each pixel has its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "runtime/stages/trace/sight.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

TEST(SightSamples, AFiltersPositionsHaveEvenSharesOfItsWeight) {
    for (const FilterRow& row : filter_rows()) {
        ReconstructionFilter filter;
        filter.shape = FilterShape(&row - filter_rows().data());
        filter.width = row.default_width;
        const std::vector<float> positions = filter_positions(filter);
        ASSERT_EQ(positions.size(), VXL_FILTER_STEPS + 1);
        EXPECT_EQ(positions[VXL_FILTER_STEPS / 2], 0.5f);
        EXPECT_TRUE(std::ranges::is_sorted(positions));
        for (size_t i = 0; i <= VXL_FILTER_STEPS; ++i) {
            const double share = double(i) / VXL_FILTER_STEPS;
            const double at = filter.is_pixel() ? share : 0.5 + filter_offset(filter, share);
            EXPECT_NEAR(double(positions[i]), at, 1e-6) << row.name << i;
        }
    }
}

/// A box of 2 x 2 metres that looks along Z from the side of a world of 200^3 voxels of a
/// centimetre: 8 x 8 pixels of 25 voxels.
struct Picture {
    explicit Picture(int samples) {
        world.frame = {{-1, -1, -1}, {0.01, 0.01, 0.01}, {200, 200, 200}};
        scene.observer.position = {0, 0, -1};
        scene.observer.display.shape = DisplayShape::box;
        scene.observer.display.half_size = {1, 1};
        scene.observer.display.near = 0;
        scene.observer.display.far = 2;
        scene.render.size = {8, 8};
        scene.render.samples = samples;
    }
    Scene scene;
    Pyramid world;
};

/// The positions of a pixel's samples, from its upper left corner.
std::vector<glm::dvec2> positions_in(glm::ivec2 pixel, int samples, int lanes = 0,
                                     const ReconstructionFilter& filter = {}) {
    const Picture picture(samples);
    const Device device = test_device(lanes);
    Features features;
    features.scattered_sight = true;
    SightStage stage(device, features, camera_of(picture.scene, picture.world.frame), filter);
    RayBatch batch;
    batch.stride = uint32_t(16 * samples);
    batch.rays = Buffer<float>(device, "rays", size_t(batch.stride) * VXL_RAY_COMPONENTS);
    stage.cast(shape_of(picture.world), uint32_t(pixel.y / 4 * 2 + pixel.x / 4), 1, batch);
    const std::vector<float> rays = batch.rays.read();
    std::vector<glm::dvec2> positions;
    for (int sample = 0; sample < samples; ++sample) {
        const auto ray = size_t(sample * 16 + pixel.y % 4 * 4 + pixel.x % 4);
        // Image right is -X_E, and down is -Y_E.
        positions.emplace_back(8 - double(rays[ray]) / 25 - pixel.x,
                               8 - double(rays[batch.stride + ray]) / 25 - pixel.y);
    }
    return positions;
}

TEST(SightSamples, FillEachPixelEvenlyInItsOwnWayAroundItsMiddle) {
    std::set<int> seconds;
    for (const glm::ivec2 pixel : {glm::ivec2(0, 0), {3, 0}, {0, 5}, {6, 7}}) {
        const std::vector<glm::dvec2> at = positions_in(pixel, 64);
        EXPECT_NEAR(at[0].x, 0.5, 1e-4);
        EXPECT_NEAR(at[0].y, 0.5, 1e-4);
        int cells[8][8] = {};
        for (size_t i = 1; i < at.size(); ++i) {
            ASSERT_TRUE(at[i].x > -1e-4 && at[i].x < 1.0001) << at[i].x;
            ASSERT_TRUE(at[i].y > -1e-4 && at[i].y < 1.0001) << at[i].y;
            ++cells[std::clamp(int(at[i].x * 8), 0, 7)][std::clamp(int(at[i].y * 8), 0, 7)];
        }
        int empty = 0;
        for (const auto& row : cells) empty += int(std::ranges::count(row, 0));
        EXPECT_LE(empty, 2) << "besides the cell that the first sample would have: " << pixel.x;
        seconds.insert(int(at[1].x * 1e4));
    }
    EXPECT_EQ(seconds.size(), 4u);
    EXPECT_EQ(positions_in({3, 0}, 16, 1), positions_in({3, 0}, 16, 16));
}

// A tent reaches as far as the middles of the pixels around, and half of it lies within the pixel's
// middle part of 2 - sqrt(2) pixels.
TEST(SightSamples, LieDenserWhereTheFilterIsHigher) {
    const std::vector<glm::dvec2> at = positions_in({3, 4}, 256, 0, {FilterShape::tent, 2});
    int within = 0, right = 0;
    for (const glm::dvec2& p : at) {
        ASSERT_TRUE(p.x > -0.5001 && p.x < 1.5001 && p.y > -0.5001 && p.y < 1.5001);
        within += std::abs(p.x - 0.5) < 1 - std::sqrt(0.5);
        right += p.x > 0.5001;
    }
    EXPECT_NEAR(within, 128, 3);
    EXPECT_NEAR(right, 128, 2);
}

// So a part of an image, or the samples that another run adds, are those of the whole.
TEST(SightSamples, AreNumberedInTheWholeFrameAndSequence) {
    Picture whole(32), part(24);
    part.scene.render.first_sample = 8;
    part.scene.render.size = {4, 4};
    part.scene.render.crop = {{4, 4}, {8, 8}};
    const Device device = test_device();
    Features features;
    features.scattered_sight = true;
    const auto rays_of = [&](const Picture& picture, uint32_t tile) {
        SightStage stage(device, features, camera_of(picture.scene, picture.world.frame));
        RayBatch batch;
        batch.stride = uint32_t(16 * picture.scene.render.samples);
        batch.rays = Buffer<float>(device, "rays", size_t(batch.stride) * VXL_RAY_COMPONENTS);
        stage.cast(shape_of(picture.world), tile, 1, batch);
        return batch.rays.read(0, batch.stride);
    };
    const std::vector<float> all = rays_of(whole, 3), some = rays_of(part, 0);
    EXPECT_TRUE(std::ranges::equal(some, std::span(all).subspan(size_t(8 * 16))));
}

}  // namespace
}  // namespace voxelume
