// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/sight.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <vector>

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

/// The rays of a scene's samples, of which all pixels lie in the image: their origins and
/// directions in metres.
std::vector<std::array<glm::dvec3, 2>> metric_rays(const Scene& s) {
    const Device device = test_device();
    const Pyramid pyramid = world();
    Features features;
    features.lens = s.observer.aperture > 0;
    features.blades = s.observer.blades > 0;
    SightStage stage(device, features, camera_of(s, pyramid.frame));
    const uint32_t tiles = tile_count(s.render.size.x, s.render.size.y);
    RayBatch batch;
    batch.stride = tiles * 16 * uint32_t(s.render.samples);
    batch.rays = Buffer<float>(device, "rays", size_t(batch.stride) * VXL_RAY_COMPONENTS);
    stage.cast(shape_of(pyramid), 0, tiles, batch);
    const std::vector<float> values = batch.rays.read();
    std::vector<std::array<glm::dvec3, 2>> rays(batch.stride);
    for (uint32_t ray = 0; ray < batch.stride; ++ray)
        for (uint32_t axis = 0; axis < 6; ++axis) {
            const double value = values[(VXL_RAY_OX + axis) * batch.stride + ray];
            const int a = int(axis % 3);
            rays[ray][axis / 3][a] =
                value * pyramid.frame.voxel_edge[a] + (axis < 3 ? pyramid.frame.origin[a] : 0.0);
        }
    return rays;
}

TEST(LensRays, FillTheLensAndMeetWhereItIsFocused) {
    Scene sharp = scene(DisplayShape::pyramid);
    sharp.render.size = {8, 4};
    sharp.render.samples = 64;
    Scene blurred = sharp;
    blurred.observer.aperture = 0.3;
    blurred.observer.focus = 1.7;
    const auto own = metric_rays(sharp), through = metric_rays(blurred);
    const auto in_observer = [&](const glm::dvec3& v) {
        return glm::transpose(sharp.observer.world_from_observer) * v;
    };
    glm::dvec2 sum(0), squares(0);
    double largest = 0;
    for (size_t i = 0; i < own.size(); ++i) {
        const glm::dvec3 d = in_observer(own[i][1]), e = in_observer(through[i][1]);
        const glm::dvec3 o = in_observer(through[i][0] - sharp.observer.position);
        const glm::dvec3 on_lens = o - e * (o.z / e.z);
        const glm::dvec3 sharp_point = d * (1.7 / d.z);
        EXPECT_LT(glm::distance(on_lens + e * (1.7 / e.z), sharp_point), 1e-4) << i;
        largest = std::max(largest, glm::length(on_lens));
        sum += glm::dvec2(on_lens);
        squares += glm::dvec2(on_lens) * glm::dvec2(on_lens);
    }
    const auto count = double(own.size());
    EXPECT_LE(largest, 0.1501);
    EXPECT_GT(largest, 0.147);
    // A disk's middle is 0, and its mean square along an axis is a quarter of the radius' square.
    for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(sum[axis] / count, 0, 1e-3);
        EXPECT_NEAR(squares[axis] / count, 0.15 * 0.15 / 4, 1e-4);
    }
}

TEST(LensRays, FillThePolygonOfTheBladesWithACornerAtTheTop) {
    for (const int blades : {3, 5, 8}) {
        Scene scene_of_blades = scene(DisplayShape::pyramid);
        scene_of_blades.render.size = {8, 4};
        scene_of_blades.render.samples = 256;
        scene_of_blades.observer.aperture = 0.4;
        scene_of_blades.observer.focus = 1.7;
        scene_of_blades.observer.blades = blades;
        const double pi = std::numbers::pi, radius = 0.2;
        glm::dvec2 sum(0), squares(0);
        double top = -1;
        const auto rays = metric_rays(scene_of_blades);
        for (const auto& [origin, direction] : rays) {
            const glm::dmat3 observer =
                glm::transpose(scene_of_blades.observer.world_from_observer);
            const glm::dvec3 e = observer * direction;
            const glm::dvec3 o = observer * (origin - scene_of_blades.observer.position);
            const glm::dvec2 p(o - e * (o.z / e.z));
            for (int side = 0; side < blades; ++side) {
                const double turn = (2 * side + 1) * pi / blades;
                EXPECT_LT(glm::dot(p, glm::dvec2(std::sin(turn), std::cos(turn))),
                          radius * std::cos(pi / blades) + 1e-4);
            }
            top = std::max(top, p.y);
            sum += p, squares += p * p;
        }
        EXPECT_GT(top, 0.97 * radius) << blades;
        const double edge = 2 * radius * std::sin(pi / blades);
        const auto count = double(rays.size());
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_NEAR(sum[axis] / count, 0, 1e-3) << blades;
            EXPECT_NEAR(squares[axis] / count, (6 * radius * radius - edge * edge) / 24, 1e-4)
                << blades;
        }
    }
}

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
