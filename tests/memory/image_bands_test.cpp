// SPDX-License-Identifier: Apache-2.0
// The division of images that are larger than memory into bands.
#include "runtime/memory/image_bands.hpp"

#include <gmock/gmock.h>

#include "tests/memory/plan_fixture.hpp"

namespace voxelume {
namespace {

constexpr const char* kBall = R"({"shape": "sphere", "radius": 0.35, "surface": "cubes"})";

class ImageBandsTest : public PlanTest {
  protected:
    /// A ball in a picture of `size` pixels, which take 48 bytes each on the device.
    Scene picture(glm::ivec2 size, double voxel = 0.05) {
        Scene scene = scene_of(kBall, voxel);
        scene.render.size = size;
        return scene;
    }
    static DeviceInfo device_of(double bytes) {
        DeviceInfo device;
        device.name = "Small One";
        device.kind = DeviceKind::gpu;
        device.memory = device.max_allocation = uint64_t(bytes);
        return device;
    }
    static ImageBands bands(const Scene& scene, const DeviceInfo& device, int at_once = 1) {
        AssetStore meshes;
        return bands_that_fit(scene, std::vector{1}, meshes, device, at_once);
    }
};

TEST_F(ImageBandsTest, AreOneWhereTheImageFits) {
    const ImageBands one = bands(picture({1000, 1000}), device_of(1e9));
    EXPECT_TRUE(one.are_one());
    EXPECT_FALSE(one.are_needed);
    EXPECT_EQ(one.rows, 1000);
}

TEST_F(ImageBandsTest, AreHalvesOfHalvesUntilOneFits) {
    const Scene scene = picture({1000, 1000});
    for (const double bytes : {30e6, 15e6, 10e6}) {
        const DeviceInfo device = device_of(bytes);
        const ImageBands cut = bands(scene, device);
        EXPECT_GT(cut.count, 1) << bytes;
        EXPECT_TRUE(cut.are_needed);
        EXPECT_EQ(cut.rows % 16, 0);
        EXPECT_GE(cut.rows * cut.count, 1000);
        EXPECT_LT(cut.rows * (cut.count - 1), 1000);
        const ScenePlan plan = plan_of(band_of(scene, cut, 0));
        EXPECT_LE(plan.peak_bytes(), bytes);
        const ImageBands larger{2 * cut.rows, (cut.count + 1) / 2};
        EXPECT_GT(plan_of(band_of(scene, larger, 0)).peak_bytes(), bytes);
    }
}

TEST_F(ImageBandsTest, FitTheLargestBufferThatADeviceAllows) {
    DeviceInfo device = device_of(4e9);
    device.max_allocation = 10'000'000;
    const ImageBands cut = bands(picture({1000, 1000}), device);
    EXPECT_LE(cut.rows * 48'000, 10'000'000);
    EXPECT_GT(2 * cut.rows * 48'000, 9'000'000);
}

TEST_F(ImageBandsTest, AreSmallerWhereSeveralDevicesHaveOne) {
    const Scene scene = picture({1000, 1000});
    const DeviceInfo device = device_of(30e6);
    EXPECT_LE(2 * bands(scene, device, 2).rows, bands(scene, device).rows + 16);
}

TEST_F(ImageBandsTest, AreOneWhereTheWorldIsTooLarge) {
    EXPECT_TRUE(bands(picture({1000, 1000}, 1.0 / 3000), device_of(30e6)).are_one());
}

TEST_F(ImageBandsTest, LieBelowOneAnotherInThePictureOfTheWhole) {
    Scene scene = picture({50, 75});
    crop(scene, {3, 5}, {40, 61});
    const ImageBands cut{16, 4};
    for (int band = 0; band < 4; ++band) {
        const RenderSettings part = band_of(scene, cut, band).render;
        EXPECT_EQ(part.crop.first, glm::ivec2(3, 5 + 16 * band));
        EXPECT_EQ(part.crop.frame, glm::ivec2(50, 75));
        EXPECT_EQ(part.size, glm::ivec2(40, band < 3 ? 16 : 13));
    }
}

TEST_F(ImageBandsTest, OfAPictureAsLargeAsAnyAreCounted) {
    const ImageBands cut = bands(picture({kMaxImageSide, kMaxImageSide}), device_of(2e9));
    EXPECT_EQ(cut.rows, 512);
    EXPECT_EQ(cut.count, 128);
}

}  // namespace
}  // namespace voxelume
