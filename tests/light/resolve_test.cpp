// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/resolve/resolve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/stages/trace/sight.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// A batch with two samples per pixel of a 3 x 2 image in one tile: 32 rays, numbered sample * 16 +
/// pixel.
struct Batch {
    explicit Batch(const Device& device) : device_(device) {
        scene.render.size = {3, 2};
        scene.render.samples = 2;
        scene.observer.position = {0.5, 0.25, -4};
        scene.observer.display.half_angles = {0.5, 0.5};
        pyramid.frame = {{-1, -2, -3}, {0.5, 0.25, 0.125}, {7, 5, 3}};
        hits.assign(32 * VXL_HIT_PRIMITIVE, VXL_NO_VOXEL);
    }

    Image resolved() {
        RayBatch batch;
        batch.stride = 32;
        batch.hits = Buffer<uint32_t>(device_, "hits", std::span<const uint32_t>(hits));
        batch.positions = Buffer<float>(device_, "positions", std::span<const float>(positions));
        batch.normals = Buffer<float>(device_, "normals", std::span<const float>(normals));
        batch.hit_attributes =
            Buffer<uint32_t>(device_, "hit attributes", std::span<const uint32_t>(hit_attributes));
        batch.radiance = Buffer<float>(device_, "radiance", std::span<const float>(radiance));
        const Camera camera = camera_of(scene, pyramid.frame);
        const glm::ivec2 size(camera.width, camera.height);
        const ImageArrays arrays = allocate_image(device_, size, {});
        ResolveStage(device_, {}, camera, {}, arrays, false).pixels(pyramid, batch, 0, 1);
        not_finite = arrays.not_finite.read_one(0);
        return image_in(arrays, size, {});
    }

    Scene scene;
    Pyramid pyramid;
    std::vector<uint32_t> hits, hit_attributes = std::vector<uint32_t>(32, 0);
    std::vector<float> positions = std::vector<float>(96, 0), normals = positions,
                       radiance = positions;
    uint32_t not_finite = 0;

  private:
    Device device_;
};

TEST(Resolve, APixelIsTheMeanOfItsSamplesAndTheGeometryOfItsFirstHit) {
    Batch batch(test_device());
    const uint32_t pixel = 1 + 4 * 1;  // column 1, row 1 of the tile
    const uint32_t second = 16 + pixel;
    batch.radiance[pixel] = 0.25f;           // red of sample 0, which misses
    batch.radiance[second] = 0.75f;          // red of sample 1, which hits
    batch.radiance[2 * 32 + second] = 3.0f;  // blue
    batch.hits[VXL_HIT_VOXEL * 32 + second] = 9;
    batch.hit_attributes[second] = 41;
    for (uint32_t a = 0; a < 3; ++a) {
        batch.positions[a * 32 + second] = float(2 + a);  // voxels
        batch.normals[a * 32 + second] = float(a) - 0.5f;
    }
    const Image image = batch.resolved();
    const size_t index = 1 * 3 + 1;
    EXPECT_EQ(image.planes.at("R")[index], 0.5f);
    EXPECT_EQ(image.planes.at("B")[index], 1.5f);
    EXPECT_EQ(image.planes.at("A")[index], 0.5f);
    EXPECT_EQ(image.planes.at("P.X")[index], -1 + 2 * 0.5f);
    EXPECT_EQ(image.planes.at("P.Y")[index], -2 + 3 * 0.25f);
    EXPECT_EQ(image.planes.at("P.Z")[index], -3 + 4 * 0.125f);
    EXPECT_EQ(image.planes.at("N.Y")[index], 0.5f);
    EXPECT_EQ(image.planes.at("Z")[index], -2.5f + 4.0f);  // along +z from z = -4
    EXPECT_EQ(image.id_planes.at("objectId")[index], 42u);
    EXPECT_EQ(batch.not_finite, 0u);
}

TEST(Resolve, APixelWithoutAHitHasNoGeometry) {
    Batch batch(test_device());
    batch.positions.assign(96, 7.0f);
    const Image image = batch.resolved();
    EXPECT_TRUE(std::isinf(image.planes.at("Z")[5]));
    EXPECT_EQ(image.planes.at("P.X")[5], 0.0f);
    EXPECT_EQ(image.planes.at("A")[5], 0.0f);
    EXPECT_EQ(image.id_planes.at("objectId")[5], 0u);
}

TEST(Resolve, ValuesThatAreNotFiniteBecomeZeroAndAreCounted) {
    Batch batch(test_device());
    batch.radiance[0] = std::numeric_limits<float>::infinity();
    batch.radiance[32 + 2] = std::numeric_limits<float>::quiet_NaN();
    batch.radiance[32 + 3] = std::numeric_limits<float>::quiet_NaN();  // outside of the image
    const Image image = batch.resolved();
    EXPECT_EQ(image.planes.at("R")[0], 0.0f);
    EXPECT_EQ(image.planes.at("G")[2], 0.0f);
    EXPECT_EQ(batch.not_finite, 2u);
}

}  // namespace
}  // namespace voxelume
