// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/sight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/stages/trace/trace.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr int kWidth = 10, kHeight = 6;  // not whole tiles

/// An empty world of 70 x 37 x 130 voxels of 0.1 x 0.2 x 0.05 m from (-3, -4, -2) on.
Pyramid world() {
    Pyramid pyramid;
    pyramid.frame = {{-3, -4, -2}, {0.1, 0.2, 0.05}, {70, 37, 130}};
    return pyramid;
}

/// A scene with an observer off every axis, whose own axes are turned.
Scene scene(DisplayShape shape) {
    Scene s;
    s.observer.position = {0.3, -0.2, 0.4};
    const glm::dvec3 z = glm::normalize(glm::dvec3(0.4, -0.3, 0.8));
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z));
    s.observer.world_from_observer = glm::dmat3(x, glm::cross(z, x), z);
    Display& display = s.observer.display;
    display.shape = shape;
    display.half_angles = {0.6, 0.4};
    if (shape == DisplayShape::sector) display.half_angles = {0.9, 0.9};
    display.half_size = {0.5, 0.3};
    display.near = 0.25;
    display.far = 100;
    s.render.size = {kWidth, kHeight};
    return s;
}

/// The direction in which a pixel's centre looks, in the observer's coordinates, from the shapes'
/// definitions.
struct Look {
    glm::dvec3 start{0}, direction{0};
    bool seen = true;
};

Look look(const Scene& s, int column, int row) {
    const Display& display = s.observer.display;
    const double u = (2 * column + 1.0) / kWidth - 1, v = (2 * row + 1.0) / kHeight - 1;
    const double kPi = std::acos(-1.0);
    switch (display.shape) {
        case DisplayShape::pyramid:
            return {
                {},
                {-u * std::tan(display.half_angles.x), -v * std::tan(display.half_angles.y), 1}};
        case DisplayShape::box:
            return {{-u * display.half_size.x, -v * display.half_size.y, 0}, {0, 0, 1}};
        case DisplayShape::ball: {
            const double longitude = -u * kPi, latitude = -v * kPi / 2;
            return {{},
                    {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                     std::cos(longitude) * std::cos(latitude)}};
        }
        case DisplayShape::sector: {
            const double radius = std::hypot(u, v), angle = radius * display.half_angles.x;
            const double by = std::sin(angle) / radius;
            return {{}, {-u * by, -v * by, std::cos(angle)}, radius <= 1};
        }
    }
    return {};
}

class SightRays : public testing::TestWithParam<DisplayShape> {};

TEST_P(SightRays, LeaveTheNearSurfaceWhereTheShapeSays) {
    const Device device = test_device();
    const Scene s = scene(GetParam());
    const Pyramid pyramid = world();
    const PyramidShape shape = shape_of(pyramid);
    SightStage stage(device, {}, camera_of(s, pyramid.frame));
    const uint32_t tiles = tile_count(kWidth, kHeight);
    RayBatch batch;
    batch.stride = tiles * 16;
    batch.rays = Buffer<float>(device, "rays", size_t(batch.stride) * VXL_RAY_COMPONENTS);
    ASSERT_EQ(stage.cast(shape, 0, tiles, batch), batch.stride);
    const std::vector<float> rays = batch.rays.read();
    const auto at = [&](uint32_t component, uint32_t ray) {
        return double(rays[component * batch.stride + ray]);
    };

    for (uint32_t ray = 0; ray < batch.stride; ++ray) {
        const int tile = int(ray / 16), pixel = int(ray % 16), tiles_x = (kWidth + 3) / 4;
        const int column = tile % tiles_x * 4 + pixel % 4, row = tile / tiles_x * 4 + pixel / 4;
        const Look expected = look(s, column, row);
        const bool in_image = column < kWidth && row < kHeight && expected.seen;
        ASSERT_EQ(at(VXL_RAY_END, ray) >= 0, in_image) << column << "," << row;
        if (!in_image) continue;
        const glm::dmat3& axes = s.observer.world_from_observer;
        const glm::dvec3 near =
            s.observer.position + axes * (expected.start + expected.direction * 0.25);
        const glm::dvec3 voxels = (near - pyramid.frame.origin) / pyramid.frame.voxel_edge;
        const glm::dvec3 direction =
            glm::normalize(axes * expected.direction / pyramid.frame.voxel_edge);
        glm::dvec3 o, d;
        for (int a = 0; a < 3; ++a) {
            o[a] = at(VXL_RAY_OX + uint32_t(a), ray);
            d[a] = at(VXL_RAY_DX + uint32_t(a), ray);
            EXPECT_EQ(o[a] * shape.fixed_point, std::round(o[a] * shape.fixed_point));
            EXPECT_EQ(std::ldexp(d[a], VXL_DIRECTION_BITS),
                      std::round(std::ldexp(d[a], VXL_DIRECTION_BITS)));
        }
        EXPECT_LT(glm::length(o - voxels), 1e-4) << column << "," << row;
        EXPECT_LT(glm::length(glm::normalize(d) - direction), 1e-6) << column << "," << row;
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, SightRays,
                         testing::Values(DisplayShape::pyramid, DisplayShape::sector,
                                         DisplayShape::ball, DisplayShape::box));

TEST(Camera, OneSampleIsThePixelsCentreAndMoreFillItEvenly) {
    EXPECT_EQ(sample_offsets(1), (std::vector<float>{0.5f, 0.5f}));
    const std::vector<float> offsets = sample_offsets(64);
    int cells[4][4] = {};
    for (size_t i = 0; i < offsets.size(); i += 2)
        ++cells[int(offsets[i] * 4)][int(offsets[i + 1] * 4)];
    for (const auto& row : cells)
        for (const int count : row) EXPECT_NEAR(count, 4, 2);
}

TEST(Camera, TheOriginKeepsWhatFloatsRoundOff) {
    Scene s = scene(DisplayShape::ball);  // rays begin at the observer
    s.observer.position = {1.0 / 3, -1.0 / 7, 1.0 / 11};
    const GridFrame frame = world().frame;
    const Camera camera = camera_of(s, frame);
    const glm::dvec3 exact = (s.observer.position - frame.origin) / frame.voxel_edge;
    EXPECT_NEAR(double(camera.origin.x) + double(camera.origin_low.x), exact.x, 1e-12);
    EXPECT_NEAR(double(camera.origin.y) + double(camera.origin_low.y), exact.y, 1e-12);
    EXPECT_NEAR(double(camera.origin.z) + double(camera.origin_low.z), exact.z, 1e-12);
}

TEST(Camera, ARayPastTheWorldIsIdle) {
    Scene s = scene(DisplayShape::pyramid);
    s.observer.position = {50, 50, 50};  // looking away
    const Pyramid pyramid = world();
    const Device device = test_device();
    SightStage stage(device, {}, camera_of(s, pyramid.frame));
    RayBatch batch;
    batch.stride = 16;
    batch.rays = Buffer<float>(device, "rays", 16 * VXL_RAY_COMPONENTS);
    stage.cast(shape_of(pyramid), 0, 1, batch);
    for (const float end : batch.rays.read(VXL_RAY_END * 16, 16)) EXPECT_LT(end, 0.0f);
}

}  // namespace
}  // namespace voxelume
