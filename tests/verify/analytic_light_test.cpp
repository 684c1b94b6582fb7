// SPDX-License-Identifier: Apache-2.0
// The analytic tracer's lights, shadows, checkers and image, against numbers computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/verify/analytic/analytic_tracer.hpp"
#include "tests/oracles/analytic_image.hpp"
#include "tests/verify/analytic_scene.hpp"

namespace voxelume {
namespace {

using oracle::AnalyticTracer;

Material paint() {
    Material m;
    m.color = {0.5f, 0.25f, 0.125f};
    m.diffuse = 0.5f;
    return m;
}

/// A floor at y = 0, seen from (0, 2, 0) straight down.
Scene floor_scene(const Material& material) {
    Scene scene = empty_scene();
    add_box(scene, {-9, -1, -9}, {9, 0, 9}, material);
    return scene;
}

glm::dvec3 seen_below(const Scene& scene, double x = 0, double z = 0) {
    return AnalyticTracer(scene).trace({x, 2, z}, {0, -1, 0}).radiance;
}

TEST(AnalyticLight, LambertAmbientEmissionAndHighlight) {
    Material m = paint();
    m.specular = 0.25f;
    m.shininess = 6;
    m.emission = {1, 2, 3};
    Scene scene = floor_scene(m);
    scene.world.ambient = {1, 0.5f, 2};
    scene.lights.push_back(point_light({3, 4, 0}, {8, 16, 4}));
    const glm::dvec3 value = seen_below(scene);
    const double cosine = 0.8, falloff = 1 / 25.0;
    const double highlight = std::pow((0.8 + 1) / std::hypot(0.6, 1.8), 6);
    const double color[3] = {0.5, 0.25, 0.125}, ambient[3] = {1, 0.5, 2}, intensity[3] = {8, 16, 4};
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c],
                    c + 1 + color[c] * 0.5 * ambient[c] +
                        (color[c] * 0.5 * cosine + 0.25 * highlight) * intensity[c] * falloff,
                    1e-14);
}

TEST(AnalyticLight, FallsWithTheSquareOfTheDistanceUnlessDirectional) {
    Scene scene = floor_scene(paint());
    scene.lights.push_back(point_light({0, 5, 0}, glm::vec3(4)));
    EXPECT_NEAR(seen_below(scene).x, 0.25 * 4 / 25, 1e-16);
    scene.lights[0].position.y = 50;  // outside of the world, too
    EXPECT_NEAR(seen_below(scene).x, 0.25 * 4 / 2500, 1e-16);
    scene.lights[0].kind = LightKind::directional;
    scene.lights[0].direction = {0, -1, 0};
    EXPECT_NEAR(seen_below(scene, 8).x, 0.25 * 4, 1e-15);
    scene.lights[0].direction = {0, 1, 0};
    EXPECT_EQ(seen_below(scene), glm::dvec3(0));
}

TEST(AnalyticLight, ASpotFadesBySmoothstepOfTheCosine) {
    Scene scene = floor_scene(paint());
    Light spot = point_light({0, 4, 0}, glm::vec3(1));
    spot.kind = LightKind::spot;
    spot.direction = {0, -1, 0};
    spot.inner_half_angle = std::acos(0.9);
    spot.outer_half_angle = std::acos(0.7);
    scene.lights.push_back(spot);
    const auto at_cosine = [&](double cosine) {
        const double distance = 4 / cosine;
        return seen_below(scene, distance * std::sqrt(1 - cosine * cosine)).x /
               (0.25 * cosine / (distance * distance));
    };
    EXPECT_NEAR(at_cosine(0.95), 1, 1e-12);
    EXPECT_NEAR(at_cosine(0.75), 0.25 * 0.25 * 2.5, 1e-12);
    EXPECT_NEAR(at_cosine(0.8), 0.5, 1e-12);
    EXPECT_EQ(at_cosine(0.69), 0);
}

TEST(AnalyticLight, ShadowsAreOpaqueUnlessFilteredOrSeenThrough) {
    Material glass = clear_glass(1.5);
    glass.refraction = 0.5f;
    glass.color = {1, 0.5f, 0};
    glass.absorption = {0, 0.5f, 1};
    const auto lit = [&](bool filtered) {
        Scene scene = floor_scene(paint());
        scene.render.filtered_shadows = filtered;
        add_box(scene, {-1, 4, -1}, {1, 5, 1}, glass);
        Light sun;
        sun.kind = LightKind::directional;
        sun.direction = {0, -1, 0};
        scene.lights.push_back(sun);
        return seen_below(scene) / glm::dvec3(0.25, 0.125, 0.0625);
    };
    EXPECT_EQ(lit(false), glm::dvec3(0));
    const glm::dvec3 filtered = lit(true);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(filtered[c], 0.25 * std::exp(-double(glass.absorption[c])), 1e-15) << c;

    glass.opacity = 0.5f;
    const glm::dvec3 veiled = lit(false), both = lit(true);
    for (int c = 0; c < 3; ++c) {
        // Each of two surfaces passes (1 - a) ((1 - a) + a color); with filtered shadows, a *
        // refraction more.
        const double transmittance = 0.5 * (0.5 + 0.5 * double(glass.color[c]));
        const double absorbed = std::exp(-double(glass.absorption[c]));
        EXPECT_NEAR(veiled[c], transmittance * transmittance * absorbed, 1e-15) << c;
        EXPECT_NEAR(both[c], std::pow(transmittance + 0.25, 2) * absorbed, 1e-15) << c;
    }
}

TEST(AnalyticLight, ALightBetweenSurfaceAndObstacleIsNotHidden) {
    Scene scene = floor_scene(paint());
    add_box(scene, {-1, 4, -1}, {1, 5, 1}, paint());
    scene.lights.push_back(point_light({0.5, 3, 0}, glm::vec3(1)));
    EXPECT_GT(seen_below(scene).x, 0);
    scene.lights[0].position.y = 6;
    EXPECT_EQ(seen_below(scene).x, 0);
    scene.render.shadows = false;
    EXPECT_GT(seen_below(scene).x, 0);
}

TEST(AnalyticLight, TheMediumDimsLightOnTheWayWithinTheWorld) {
    Scene scene = floor_scene(paint());
    scene.world.medium.absorption = {0.1f, 0.2f, 0};
    scene.lights.push_back(point_light({0, 50, 0}, glm::vec3(100)));
    const glm::dvec3 value = seen_below(scene);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c],
                    double(paint().color[c]) * 0.5 * 100 / 2500 *
                        std::exp(-double(scene.world.medium.absorption[c]) * (10 + 2)),
                    1e-15);
}

TEST(AnalyticLight, ACheckerHasTheSecondColorWhereTheBlocksNumbersAddUpToOdd) {
    Material m = paint();
    m.checker = Checker{{1, 0.5f, 0}, {1, 0, 2}, {0.25, 0, -0.5}};
    Scene scene = floor_scene(m);
    scene.world.ambient = glm::vec3(2);
    // Blocks begin at x = 0.25 and z = -0.5, and are 1 m wide along x and 2 m along z.
    EXPECT_EQ(seen_below(scene, 0.3, 0).x, 0.5);
    EXPECT_EQ(seen_below(scene, 0.2, 0).x, 1.0);
    EXPECT_EQ(seen_below(scene, 0.2, -0.6).x, 0.5);
    EXPECT_EQ(seen_below(scene, 1.3, 1.4).x, 1.0);
    EXPECT_EQ(seen_below(scene, 1.3, 1.6).x, 0.5);
}

TEST(AnalyticImage, RightIsMinusXOfTheObserverAndUpIsY) {
    Scene scene = empty_scene();
    scene.observer.position = {0, 0, -9};
    scene.observer.display.half_angles = {std::atan(0.7), std::atan(0.5)};
    scene.observer.display.far = 100;
    scene.render.size = {70, 50};
    // At 10 m the image spans 14 m x 10 m: 0.2 m a pixel. x 2..4 is left of the middle, y 1..2 up.
    add_box(scene, {2, 1, 1}, {4, 2, 2}, emitter({1, 2, 3}));
    const oracle::AnalyticImage image = oracle::analytic_image(scene);
    for (int y = 0; y < 50; ++y) {
        for (int x = 0; x < 70; ++x) {
            const double across = 7 - 0.2 * (x + 0.5), up = 5 - 0.2 * (y + 0.5);
            const bool front = across > 2 && across < 4 && up > 1 && up < 2;
            const size_t pixel = size_t(y * 70 + x);
            if (front) {
                EXPECT_EQ(image.radiance[pixel], glm::dvec3(1, 2, 3)) << x << "," << y;
            }
            if (across < 1.5 || up < 0.5) {  // the sides that show are left of and above the front
                EXPECT_EQ(image.radiance[pixel], glm::dvec3(0)) << x << "," << y;
            }
        }
    }
}

TEST(AnalyticImage, EdgesAreThePixelsOnBothSidesOfAChange) {
    Scene scene = empty_scene();
    scene.observer.position = {0, 0, -9};
    scene.observer.display.half_angles = {std::atan(0.5), std::atan(0.5)};
    scene.observer.display.far = 100;
    scene.render.size = {20, 20};
    add_box(scene, {-9, -9, 1}, {0, 9, 2}, paint());
    const oracle::AnalyticImage image = oracle::analytic_image(scene);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x)
            EXPECT_EQ(image.edge[size_t(y * 20 + x)], x == 9 || x == 10) << x << "," << y;
}

}  // namespace
}  // namespace voxelume
