// SPDX-License-Identifier: Apache-2.0
// The analytic tracer against numbers of geometrical optics, derived by hand.
#include "runtime/verify/analytic/analytic_tracer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/verify/analytic_scene.hpp"

namespace voxelume {
namespace {

using oracle::AnalyticTracer;

constexpr double kDegree = std::numbers::pi / 180;

/// The green component of what a ray sees.
double seen(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction) {
    return AnalyticTracer(scene).trace(origin, glm::normalize(direction)).radiance.y;
}

/// The height at which a falling ray of the plane z = 0 meets the line x = 4, found by the edge of
/// an emissive object that is just visible.
double height_at_4(Scene scene, const glm::dvec3& origin, const glm::dvec3& direction) {
    const int emissive = add_box(scene, {4, 0, -1}, {5, 1, 1}, emitter(glm::vec3(1)));
    const glm::dmat4 around_origin(1);
    double low = -9, high = 9;
    for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        // The emissive object is at x 4..5 and extends upwards from `middle`.
        scene.models[size_t(emissive)].solid->size = {1, 20, 2};
        scene.objects[size_t(emissive)].world_from_object =
            glm::translate(around_origin, {4.5, middle + 10, 0});
        (seen(scene, origin, direction) > 0 ? low : high) = middle;
    }
    return low;
}

TEST(AnalyticTracer, ASlabShiftsARaySideways) {
    // A slab of 0.5 m stands across x; the ray falls at 50 degrees to its normal.
    const double incidence = 50 * kDegree, within = std::asin(std::sin(incidence) / 1.5);
    Scene scene = empty_scene();
    add_object(scene, slab_solid(0.5), clear_glass(1.5),
               glm::rotate(glm::dmat4(1), 90 * kDegree, {0, 0, 1}));
    const double height =
        height_at_4(scene, {-2, 7, 0}, {std::cos(incidence), -std::sin(incidence), 0});
    EXPECT_NEAR(height, 7 - 5.5 * std::tan(incidence) - 0.5 * std::tan(within), 1e-12);
}

TEST(AnalyticTracer, GlassInWaterBendsFromIndexToIndex) {
    const double incidence = 40 * kDegree;
    const double water = std::asin(std::sin(incidence) / 1.33),
                 glass = std::asin(std::sin(incidence) / 1.5);
    const glm::dmat4 across = glm::rotate(glm::dmat4(1), 90 * kDegree, {0, 0, 1});
    const glm::dvec3 origin(-2, 6, 0), direction(std::cos(incidence), -std::sin(incidence), 0);
    const double water_only = 6 - 4 * std::tan(incidence) - 2 * std::tan(water);
    const double nested =
        6 - 4 * std::tan(incidence) - 1.5 * std::tan(water) - 0.5 * std::tan(glass);
    for (const bool glass_first : {false, true}) {
        for (const int glass_priority : {-1, 0, 1}) {
            Scene scene = empty_scene();
            const auto add_glass = [&] {
                add_object(scene, slab_solid(0.5), clear_glass(1.5), across, glass_priority);
            };
            if (glass_first) add_glass();
            add_object(scene, slab_solid(2), clear_glass(1.33f), across);
            if (!glass_first) add_glass();
            const bool shows = glass_priority > 0 || (glass_priority == 0 && glass_first);
            // 1.33 is a float: its last bit moves the ray by 2e-8.
            EXPECT_NEAR(height_at_4(scene, origin, direction), shows ? nested : water_only, 1e-7)
                << glass_first << glass_priority;
        }
    }
}

TEST(AnalyticTracer, ABallTurnsARayByTwiceTheAngleOfRefraction) {
    for (const double off_axis : {0.1, 0.5, 0.8, 0.95}) {
        Scene scene = empty_scene();
        add_object(scene, sphere_solid(1), clear_glass(1.5));
        const double incidence = std::asin(off_axis), within = std::asin(off_axis / 1.5);
        const double turned = 2 * (incidence - within), exit = 2 * within - incidence;
        EXPECT_NEAR(height_at_4(scene, {-3, off_axis, 0}, {1, 0, 0}),
                    std::sin(exit) - std::tan(turned) * (4 - std::cos(exit)), 1e-12);
    }
}

TEST(AnalyticTracer, ARightAngledPrismDeviatesMinimallyOnTheSymmetricPath) {
    // Fraunhofer's formula is n = sin((A + D) / 2) / sin(A / 2), with A = 90 degrees at the top of
    // a turned box.
    Scene scene = empty_scene();
    add_object(scene, box_solid(glm::dvec3(2)), clear_glass(1.25),
               glm::rotate(glm::dmat4(1), 45 * kDegree, {0, 0, 1}));
    const double deviation = 2 * std::asin(1.25 * std::sin(45 * kDegree)) - 90 * kDegree;
    // Inside, the ray goes along y = 1.
    const glm::dvec3 enters(1 - std::sqrt(2.0), 1, 0);
    const glm::dvec3 direction(std::cos(deviation / 2), std::sin(deviation / 2), 0);
    EXPECT_NEAR(height_at_4(scene, enters - direction, direction),
                1 - std::tan(deviation / 2) * (4 - std::sqrt(2.0) + 1), 1e-12);
}

TEST(AnalyticTracer, LightIsReflectedTotallyFromTheCriticalAngleOn) {
    Scene scene = empty_scene(glm::vec3(1));
    scene.render.depth = 1;
    add_object(scene, slab_solid(1), clear_glass(1.5));
    const double critical = std::asin(1 / 1.5);
    for (const double beyond : {-1e-3, -1e-7, 1e-7, 1e-3}) {
        const double angle = critical + beyond;
        EXPECT_EQ(seen(scene, {0, 0, 0}, {std::sin(angle), std::cos(angle), 0}),
                  beyond < 0 ? 1.0 : 0.0)
            << "totally reflected light meets the other side, where the recursion ends";
    }
}

TEST(AnalyticTracer, WhatIsNotReflectedIsTransmitted) {
    for (const double ratio : {1.0, 1.33, 1.5, 2.4, 1 / 1.5}) {
        for (int degrees = 0; degrees < 90; ++degrees) {
            const double c = std::cos(degrees * kDegree), s = std::sin(degrees * kDegree) / ratio;
            if (s >= 1) {
                EXPECT_EQ(oracle::reflectance(c, 1, ratio), 1.0);
                continue;
            }
            const double beyond = std::sqrt(1 - s * s);
            const double ts = 2 * c / (c + ratio * beyond), tp = 2 * c / (ratio * c + beyond);
            const double transmitted = ratio * beyond / c * (ts * ts + tp * tp) / 2;
            EXPECT_NEAR(oracle::reflectance(c, 1, ratio) + transmitted, 1, 1e-14);
            EXPECT_NEAR(oracle::reflectance(beyond, ratio, 1), oracle::reflectance(c, 1, ratio),
                        1e-13);
        }
    }
    EXPECT_NEAR(oracle::reflectance(1, 1, 1.5), 0.04, 1e-16);
}

TEST(AnalyticTracer, GlassReflectsFourPercentOfWhatFallsOnItSquarely) {
    Scene scene = empty_scene();
    scene.render.depth = 1;
    Material glass = clear_glass(1.5);
    glass.reflection = 1;
    glass.fresnel = true;
    add_object(scene, slab_solid(1), glass);
    add_box(scene, {-1, 3, -1}, {1, 4, 1}, emitter(glm::vec3(2)));
    EXPECT_NEAR(seen(scene, {0, 2, 0}, {0, -1, 0}), 0.08, 1e-15);
}

TEST(AnalyticTracer, AGlassBallInUniformLightCannotBeSeen) {
    Scene scene = empty_scene(glm::vec3(0.7f));
    scene.render.depth = 64;
    Material glass = clear_glass(1.5);
    glass.reflection = 1;
    glass.fresnel = true;
    add_object(scene, sphere_solid(1), glass);
    for (const double off_axis : {0.0, 0.3, 0.7, 0.99})
        EXPECT_NEAR(seen(scene, {-3, off_axis, 0}, {1, 0, 0}), double(0.7f), 1e-14);
}

TEST(AnalyticTracer, ABallOfTheSameIndexOnlyAbsorbs) {
    Scene scene = empty_scene(glm::vec3(0.5f));
    Material tint = clear_glass(1);
    tint.absorption = {0.25f, 0.5f, 2};
    add_object(scene, sphere_solid(2), tint, glm::translate(glm::dmat4(1), {1, 0, 0}));
    const double chord = 2 * std::sqrt(4 - 1.2 * 1.2);
    const oracle::Seen ray = AnalyticTracer(scene).trace({-5, 1.2, 0}, {1, 0, 0});
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(ray.radiance[c], 0.5 * std::exp(-double(tint.absorption[c]) * chord), 1e-15);
    EXPECT_NEAR(ray.t, 6 - chord / 2, 1e-14);
    // The way from inside is shorter.
    EXPECT_NEAR(seen(scene, {1, 0, 0}, {0, 0, 1}), 0.5 * std::exp(-1.0), 1e-15);
}

TEST(AnalyticTracer, TwoMirrorsGiveAGeometricSeries) {
    for (const int depth : {0, 1, 5}) {
        Scene scene = empty_scene();
        scene.render.depth = depth;
        Material mirror = emitter(glm::vec3(1));
        mirror.reflection = 0.75f;
        add_box(scene, {-2, -9, -9}, {-1, 9, 9}, mirror);
        add_box(scene, {1, -9, -9}, {2, 9, 9}, mirror);
        EXPECT_NEAR(seen(scene, {0, 0, 0}, {1, 0.1, 0.05}), (1 - std::pow(0.75, depth + 1)) / 0.25,
                    1e-14);
    }
}

TEST(AnalyticTracer, PathsBelowTheMinWeightEnd) {
    Scene scene = empty_scene();
    scene.render.depth = 64;
    scene.render.min_weight = 0.2;
    Material mirror = emitter(glm::vec3(1));
    mirror.reflection = 0.5f;
    add_box(scene, {-2, -9, -9}, {-1, 9, 9}, mirror);
    add_box(scene, {1, -9, -9}, {2, 9, 9}, mirror);
    EXPECT_EQ(seen(scene, {0, 0, 0}, {1, 0, 0}), 1.75)
        << "1/8 is the first share that isn't traced";
    scene.render.min_weight = 0.25;
    EXPECT_EQ(seen(scene, {0, 0, 0}, {1, 0, 0}), 1.75) << "1/4 is not below the least weight";
}

TEST(AnalyticTracer, OpacityShowsItsShareOfWhatLiesBehind) {
    Scene scene = empty_scene(glm::vec3(1));
    Material veil = emitter(glm::vec3(4));
    veil.opacity = 0.25f;
    veil.ior = 1.5f;
    add_object(scene, slab_solid(1), veil);
    // Two surfaces: 0.25 * 4 + 0.75 * (0.25 * 4 + 0.75 * 1), and nothing is bent.
    EXPECT_EQ(seen(scene, {0, 2, 0}, {0.5, -1, 0.25}), 2.3125);
}

TEST(AnalyticTracer, TheMediumFillsTheWorldButNotTheGlass) {
    Scene scene = empty_scene(glm::vec3(1));
    scene.world.medium.absorption = glm::vec3(0.125f);
    scene.world.medium.color = glm::vec3(0.5f);
    const auto through = [](double behind, double metres) {
        const double transmittance = std::exp(-0.125 * metres);
        return behind * transmittance + 0.5 * (1 - transmittance);
    };
    EXPECT_NEAR(seen(scene, {0, 50, 0}, {0, -1, 0}), through(1, 20), 1e-15);
    Material ball = clear_glass(1);
    add_object(scene, sphere_solid(2), ball);
    EXPECT_NEAR(seen(scene, {0, 50, 0}, {0, -1, 0}), through(through(1, 8), 8), 1e-15);
}

TEST(AnalyticTracer, TheWorldsLatticeCutsObjectsOpen) {
    Scene scene = empty_scene(glm::vec3(1));
    add_object(scene, slab_solid(2), emitter(glm::vec3(4)));
    // The ray enters across x = -10 inside the slab and leaves at its top.
    EXPECT_EQ(seen(scene, {-12, 0, 0}, {1, 0.2, 0}), 4.0);
    EXPECT_EQ(seen(scene, {-12, 0, 0}, {1, 0.01, 0}), 1.0) << "out of the world without a surface";
    const oracle::Seen ray = AnalyticTracer(scene).trace({-12, 0, 0}, {1, 0, 0}, 0, 5);
    EXPECT_EQ(ray.object, -1);
}

}  // namespace
}  // namespace voxelume
