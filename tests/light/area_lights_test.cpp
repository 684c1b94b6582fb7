// SPDX-License-Identifier: Apache-2.0
// Images lit by disks and rectangles, against their form factors.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "runtime/stages/light/light_samples.hpp"
#include "tests/light/area_light_scenes.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

using std::numbers::pi;

TEST(AreaLights, ADiskGivesThePointBelowItsMiddleWhatItsSolidAngleHolds) {
    // The radiance is pi intensity / area; a Lambertian surface returns color R^2 / (R^2 + d^2) of
    // it.
    const double radius = 0.23, height = 0.31;
    for (const int light_samples : {1, 256}) {
        const Scene scene = floor_scene("", "",
                                        R"({"type": "disk", "position": [0.05, 0.31, 0.1],
            "direction": [0, -2, 0], "radius": 0.23, "intensity": 0.7, "spots": )" +
                                            std::to_string(light_samples) + "}");
        const Image image = image_of(scene);
        const double expected = 0.7 / (radius * radius + height * height);
        const size_t pixel = pixel_at(image, 0.05, 0.1);
        EXPECT_NEAR(image.planes.at("R")[pixel], expected,
                    (light_samples == 1 ? 1e-5 : 0.005) * expected)
            << light_samples << " light samples";
        EXPECT_NEAR(image.planes.at("G")[pixel], expected / 2, 0.005 * expected);
    }
}

TEST(AreaLights, ATinyDiskIsAPointLightTimesItsCosine) {
    const Image disk = image_of(floor_scene("", "", R"({"type": "disk", "position": [0.1, 0.5, 0],
        "direction": [0, -1, 0], "radius": 1e-4, "spots": 3, "color": [1, 2, 3]})"));
    const Image point = image_of(
        floor_scene("", "", R"({"type": "point", "position": [0.1, 0.5, 0], "color": [1, 2, 3]})"));
    for (size_t i = 0; i < disk.planes.at("R").size(); ++i) {
        const glm::dvec3 to_light = glm::dvec3(0.1, 0.5, 0) - point_at(disk, i);
        const double cosine = to_light.y / glm::length(to_light);
        for (const char* plane : {"R", "G", "B"}) {
            const double expected = cosine * double(point.planes.at(plane)[i]);
            ASSERT_NEAR(disk.planes.at(plane)[i], expected, 1e-4 * expected);
        }
    }
}

TEST(AreaLights, ARectangleGivesItsFormFactor) {
    // The light is 0.4 m along z and 0.2 m along x, with a corner above the pixel at (0.05, 0.1).
    const Image image = image_of(floor_scene("", "", R"({"type": "rectangle",
        "position": [0.15, 0.3, 0.3], "look_at": [0.15, 0, 0.3], "up": [1, 0, 0],
        "size": [0.4, 0.2], "intensity": 0.5, "spots": 256})"));
    const double radiance = pi * 0.5 / (0.4 * 0.2);
    const double expected = radiance * corner_form_factor(0.4, 0.2, 0.3);
    EXPECT_NEAR(image.planes.at("R")[pixel_at(image, 0.05, 0.1)], expected, 2e-3 * expected);
}

TEST(AreaLights, ShineToOneSideOnly) {
    const Image image = image_of(floor_scene("", "", R"({"type": "rectangle", "size": [0.2, 0.1],
        "position": [0.1, 0.5, 0], "direction": [0, 1, 0]})"));
    for (const float value : image.planes.at("R")) ASSERT_EQ(value, 0.0f);
}

TEST(AreaLights, DivideARectangleAndADiskEvenly) {
    Light light;
    light.kind = LightKind::rectangle;
    light.direction = {0, 0, 1};
    light.axis_x = {1, 0, 0};
    light.size = {3, 1};
    light.light_samples = 7;
    light.intensity = {7, 14, 21};
    const GridFrame world{{0, 0, 0}, {1, 1, 1}, {8, 8, 8}};
    const std::vector<LightRecord> light_samples = area_light_samples(light, world);
    ASSERT_EQ(light_samples.size(), 7u);
    glm::dvec2 sum(0);
    for (const LightRecord& light_sample : light_samples) {
        EXPECT_NEAR(light_sample.spread, 3.0 / 7 / pi, 1e-6);
        EXPECT_NEAR(light_sample.intensity.y, 2, 1e-6);
        EXPECT_LE(std::abs(light_sample.position.x), 1.5);
        EXPECT_LE(std::abs(light_sample.position.y), 0.5);
        sum += glm::dvec2(light_sample.position.x, light_sample.position.y);
    }
    EXPECT_NEAR(sum.x, 0, 1e-6);
    EXPECT_NEAR(sum.y, 0, 1e-6);
    light.kind = LightKind::disk;
    light.radius = 2;
    light.light_samples = 500;
    size_t inner = 0;
    for (const LightRecord& light_sample : area_light_samples(light, world))
        inner += std::hypot(light_sample.position.x, light_sample.position.y) < std::sqrt(2.0);
    EXPECT_NEAR(double(inner), 250, 1) << "half of the area, half of the light samples";
}

TEST(AreaLights, ShadowEdgesLieBetweenUmbraAndPenumbra) {
    // A board has its edge at x = 0.05, y = 0.3; the light at y = 0.6 spans x = -0.23 to -0.07.
    const std::string light = R"({"type": "rectangle", "position": [-0.15, 0.6, 0.1],
        "direction": [0, -1, 0], "up": [0, 0, 1], "size": [0.16, 0.16], "spots": 256})";
    const Image bare = image_of(floor_scene("", "", light));
    const Image image = image_of(
        floor_scene(R"("board": {"shape": "box", "size": [0.4, 0.02, 3], "surface": "exact"},)",
                    R"({"model": "board", "position": [-0.15, 0.29, 0.1]},)", light));
    size_t dark = 0, half = 0, lit = 0;
    for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
        const double x = point_at(image, i).x;
        if (!is_floor(image, i) || x < 0) continue;
        // The line over the edge from x on the floor meets the light's plane at 0.1 - x.
        const double seen = (-0.07 - (0.1 - x)) / 0.16;
        const double share = image.planes.at("R")[i] / bare.planes.at("R")[i];
        if (seen < 0) {
            EXPECT_EQ(share, 0) << x;
            ++dark;
        } else if (seen > 1) {
            EXPECT_EQ(share, 1) << x;
            ++lit;
        } else {
            EXPECT_NEAR(share, seen, 0.09) << x;
            ++half;
        }
    }
    EXPECT_GT(dark, 100u);
    EXPECT_GT(half, 200u);
    EXPECT_GT(lit, 100u);
}

}  // namespace
}  // namespace voxelume
