// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/renderer.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>

#include "runtime/opencl/program_cache.hpp"
#include "runtime/opencl/quirks/pocl_folder.hpp"
#include "tests/pictures/light/box_scene.hpp"

namespace voxelume {
namespace {

TEST(Render, GivesDepthPositionNormalAndObjectOfAFace) {
    for (const char* surface : {"cubes", "exact"}) {
        const Rendered r = rendered(scene_of(box_scene(surface, "")));
        // The box spans x -0.3..0.4, y -0.3..0.2, z -0.1..0.2. Image right is -X_E, which is -x
        // here.
        EXPECT_NEAR(r.at("Z", 8, 6), 2.9f, 1e-6f) << surface;
        EXPECT_NEAR(r.at("P.Z", 8, 6), -0.1f, 1e-6f) << surface;
        EXPECT_NEAR(r.at("P.X", 8, 6), -0.05f, 1e-6f) << surface;
        EXPECT_NEAR(r.at("P.Y", 8, 6), -0.05f, 1e-6f) << surface;
        EXPECT_FLOAT_EQ(r.at("N.Z", 8, 6), -1.0f) << surface;
        EXPECT_FLOAT_EQ(r.at("A", 8, 6), 1.0f) << surface;
        EXPECT_EQ(r.image.id_planes.at("objectId")[6 * 16 + 8], 1u) << surface;
        EXPECT_FLOAT_EQ(r.at("A", 0, 0), 0.0f) << surface;
        EXPECT_TRUE(std::isinf(r.at("Z", 0, 0))) << surface;
        EXPECT_FLOAT_EQ(r.at("B", 0, 0), 0.75f) << surface;
    }
}

TEST(Render, AFaceOnTheSideOfTheWorldIsAFaceLikeAnyOther) {
    // The world begins at the box's front face, so sight rays begin on it.
    std::string text = box_scene("cubes", R"({"type": "directional", "direction": [0, 0, 1]})");
    const std::string whole = R"("min": [-1, -1, -1])";
    text.replace(text.find(whole), whole.size(), R"("min": [-1, -1, -0.1])");
    const Rendered r = rendered(scene_of(text));
    EXPECT_EQ(r.at("N.Z", 8, 6), -1.0f);
    EXPECT_EQ(r.at("N.X", 8, 6), 0.0f);
    EXPECT_NEAR(r.at("P.Z", 8, 6), -0.1f, 1e-6f);
    EXPECT_GT(r.at("R", 8, 6), 0.4f) << "color * diffuse at least, beside ambient light of 0.2";
}

TEST(Render, CoversThePixelsThatTheBoxCovers) {
    // A pixel is 0.1 m, and x runs from 0.8 down to -0.8. The box covers x 0.4..-0.3, which are
    // columns 4 to 10, and y 0.2..-0.3, which are rows 4 to 8.
    const Rendered r = rendered(scene_of(box_scene("exact", "")));
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_EQ(r.at("A", x, y), x >= 4 && x <= 10 && y >= 4 && y <= 8 ? 1.0f : 0.0f)
                << x << "," << y;
}

TEST(Render, AddsAmbientDiffuseAndHighlightByHand) {
    // A point light is 2 m in front of the point (-0.05, -0.05, -0.1) and 1 m above it: its
    // direction is (0, 1, -2)/sqrt 5.
    const Rendered r = rendered(scene_of(box_scene(
        "exact",
        R"({"type": "point", "position": [-0.05, 0.95, -2.1], "color": [1, 0.5, 0.25], "intensity": 10})")));
    const double cosine = 2 / std::sqrt(5.0), falloff = 10 / 5.0;
    // The viewer's direction is (0, 0, -1); the half vector lies between it and (0, 1/sqrt 5,
    // -2/sqrt 5).
    const double hy = 1 / std::sqrt(5.0), hz = -2 / std::sqrt(5.0) - 1;
    const double highlight = std::pow(-hz / std::hypot(hy, hz), 8);
    const double color[3] = {0.8, 0.4, 0.2}, ambient[3] = {0.5, 0.25, 0.125},
                 light[3] = {1, 0.5, 0.25};
    const char* planes[3] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        const double expected = color[c] * 0.5 * ambient[c] +
                                falloff * light[c] * (color[c] * 0.5 * cosine + 0.25 * highlight);
        EXPECT_NEAR(r.at(planes[c], 8, 6), expected, 2e-6 * expected) << planes[c];
    }
}

TEST(Render, AbsorbsLightOnTheWayToTheSurfaceAndToTheObserver) {
    // The medium fills the world, z -1..1. Sight rays go 0.9 m through it, and so does light from
    // (-0.05,-0.05,-2.1).
    const char* light =
        R"({"type": "point", "position": [-0.05, -0.05, -2.1], "color": [1, 1, 1], "intensity": 4})";
    const Rendered clear = rendered(scene_of(box_scene("exact", light)));
    const Rendered foggy = rendered(scene_of(box_scene(
        "exact", light, R"(, "medium": {"absorption": [0.5, 1, 2], "color": [0.1, 0.2, 0.3]})")));
    const double absorption[3] = {0.5, 1, 2}, fog[3] = {0.1, 0.2, 0.3};
    const double ambient[3] = {0.8 * 0.5 * 0.5, 0.4 * 0.5 * 0.25, 0.2 * 0.5 * 0.125};
    const char* planes[3] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        const double lit = double(clear.at(planes[c], 8, 6)) - ambient[c];
        const double transmittance = std::exp(-absorption[c] * 0.9);
        const double expected =
            (ambient[c] + lit * transmittance) * transmittance + fog[c] * (1 - transmittance);
        EXPECT_NEAR(foggy.at(planes[c], 8, 6), expected, 3e-6) << planes[c];
        // A ray that meets nothing goes 2 m through the medium.
        const double behind = std::exp(-absorption[c] * 2);
        EXPECT_NEAR(foggy.at(planes[c], 0, 0),
                    double(clear.at(planes[c], 0, 0)) * behind + fog[c] * (1 - behind), 3e-6);
    }
}

TEST(Render, AShadowFallsWhereTheLightIsHidden) {
    // A wall at z = 0.5 behind the box is lit from the front, so the box's shadow on it is larger.
    std::string text = box_scene(
        "cubes",
        R"({"type": "directional", "direction": [0, -1, 1], "color": [1, 1, 1], "intensity": 1})");
    const std::string wall =
        R"(, "wall": {"shape": "box", "size": [2, 2, 0.2], "voxel_size": 0.1, "set": "solid", "surface": "cubes"}},)";
    text.replace(text.find("},\n\"objects\""), 2, wall);
    text.replace(
        text.find("\"objects\": ["), 12,
        R"("objects": [{"name": "w", "model": "wall", "material": "paint", "position": [0, 0, 0.6]}, )");
    const Rendered r = rendered(scene_of(text));
    // Light travels down at 45 degrees. The wall at z 0.5 is 0.6 m behind the box's front face (z
    // -0.1): the shadow spans y from 0.2 - 0.6 = -0.4 (front top edge) up to the box, and down to
    // -0.6 (its back).
    EXPECT_GT(r.at("R", 8, 2), 1.2f * r.at("R", 8, 9)) << "row 2 is lit, row 9 (y -0.35) in shade";
    EXPECT_GT(r.at("R", 1, 9), 1.2f * r.at("R", 8, 9)) << "beside the shadow";
}

TEST(Render, AnExactSurfaceOnTheWorldsBoundsHasNoHoles) {
    // The box fills the world: rays meet its faces where they enter, before or after their rounded
    // start.
    std::string text = box_scene("exact", "");
    const auto replace = [&text](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    replace(R"({"min": [-1, -1, -1], "max": [1, 1, 1]})",
            R"({"min": [-0.3, -0.3, -0.1], "max": [0.4, 0.2, 0.2]})");
    replace(R"("position": [0, 0, -3], "look_at": [0, 0, 0])",
            R"("position": [-2, 1.3, -3], "look_at": [0.05, -0.05, 0.05])");
    Scene scene = scene_of(text);
    const int columns = pixels(160), rows = pixels(120);
    resize(scene, {columns, rows});
    const Rendered exact = rendered(scene);
    const glm::dmat3& axes = scene.observer.world_from_observer;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const glm::dvec3 start = scene.observer.position +
                                     axes[0] * (0.8 - 1.6 * (x + 0.5) / columns) +
                                     axes[1] * (0.6 - 1.2 * (y + 0.5) / rows);
            double first = -1e9, last = 1e9;
            for (int a = 0; a < 3; ++a) {
                const double low = a == 0 ? -0.3 : a == 1 ? -0.3 : -0.1;
                const double high = a == 0 ? 0.4 : 0.2;
                const double p = (low - start[a]) / axes[2][a], q = (high - start[a]) / axes[2][a];
                first = std::max(first, std::min(p, q));
                last = std::min(last, std::max(p, q));
            }
            if (std::abs(last - first) < 1e-5) continue;  // along an edge
            ASSERT_EQ(exact.at("A", x, y), first < last ? 1.0f : 0.0f) << x << "," << y;
        }
    }
}

TEST(Render, ADistantObserverSeesWhatANearOneDoesWithTheSameAngle) {
    Scene scene = scene_of(box_scene("exact", ""));
    scene.observer.display.shape = DisplayShape::pyramid;
    scene.observer.display.far = 1e9;
    resize(scene, {pixels(64), pixels(48)});
    const auto seen_from = [&scene](double distance) {
        scene.observer.position = {0, 0, -distance};
        scene.observer.display.half_angles = {std::atan(0.6 / distance),
                                              std::atan(0.45 / distance)};
        return rendered(scene);
    };
    const Rendered near = seen_from(1e3), far = seen_from(1e7);
    EXPECT_EQ(near.image.planes.at("A"), far.image.planes.at("A"));
    for (size_t i = 0; i < near.image.planes.at("P.X").size(); ++i)
        ASSERT_NEAR(near.image.planes.at("P.X")[i], far.image.planes.at("P.X")[i], 5e-4);
}

/// A scene of a ball of 4 voxels with one light, all moved by `metres` along each axis.
Scene ball_moved_by(int metres, const std::string& surface) {
    return scene_of(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 1, "bounds": {{"min": [{0}, {0}, {0}], "max": [{1}, {1}, {1}]}}}},
"materials": {{"paint": {{"color": [0.8, 0.4, 0.2]}}}},
"models": {{"ball": {{"shape": "sphere", "radius": 4, "surface": "{4}"}}}},
"objects": [{{"model": "ball", "material": "paint", "position": [{2}.25, {2}.75, {2}.375]}}],
"lights": [{{"type": "point", "position": [{1}, {1}, {0}], "intensity": 50}}],
"observer": {{"position": [{2}, {2}, {3}], "look_at": [{2}, {2}, {2}],
             "display": {{"shape": "pyramid", "angles": [50, 40]}}}},
"render": {{"size": [{5}, {6}]}}}})",
                                metres - 8, metres + 8, metres, metres - 12, surface, pixels(80),
                                pixels(64)));
}

TEST(Render, G8AWorldFarFromTheOriginLooksAsOneAroundIt) {
    for (const char* surface : {"cubes", "smooth", "exact"}) {
        const Rendered near = rendered(ball_moved_by(0, surface));
        const Rendered far = rendered(ball_moved_by(100000, surface));
        for (const char* plane : {"R", "A", "Z", "N.X", "N.Y", "N.Z"})
            EXPECT_EQ(near.image.planes.at(plane), far.image.planes.at(plane)) << surface << plane;
    }
}

TEST(Render, AnEmptyWorldIsItsBackground) {
    std::string text = box_scene("cubes", "");
    text.replace(text.find("\"position\": [0.05, -0.05, 0.05]"), 31,
                 "\"position\": [9, 9, 9]         ");
    const Rendered r = rendered(scene_of(text));
    EXPECT_EQ(r.report.voxels, 0u);
    for (const float green : r.image.planes.at("G")) EXPECT_EQ(green, 0.5f);
}

TEST(Render, OnePixelIsAnImage) {
    Scene scene = scene_of(box_scene("smooth", ""));
    resize(scene, {1, 1});
    EXPECT_EQ(rendered(scene).image.planes.at("R").size(), 1u);
}

TEST(Render, SamplesCoverAPixelEvenly) {
    Scene scene = scene_of(box_scene("exact", ""));
    resize(scene, {5, 3});  // pixels straddle the box's edges
    scene.render.samples = 64;
    double covered = 0;
    const Rendered r = rendered(scene);
    for (const float a : r.image.planes.at("A")) covered += double(a);
    EXPECT_NEAR(covered / 15, 0.7 * 0.5 / (1.6 * 1.2), 0.01);
}

TEST(Render, LetsOtherProcessesWaitForItsKernelsUntilTheFirstTilesAreDoneAlone) {
    const Device device = test_device();
    if (!keeps_pocl_folder(device.info())) GTEST_SKIP() << "PoCL's cache is filled so";
    // A program that no cache holds makes this process the one that compiles.
    const auto now = std::chrono::system_clock::now().time_since_epoch().count();
    Program::from_text(device, fmt::format("kernel void of_{}_{}(void) {{}}\n", getpid(), now), {});
    ASSERT_TRUE(PoclFolder::instance().has_turn());
    const Scene scene = scene_of(box_scene("cubes", ""));
    RenderReport report;
    int looks = 0;
    render(device, scene, report, [&looks](uint32_t, uint32_t) {
        ++looks;
        EXPECT_FALSE(PoclFolder::instance().has_turn());
    });
    EXPECT_GT(looks, 0);
}

}  // namespace
}  // namespace voxelume
