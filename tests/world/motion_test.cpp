// SPDX-License-Identifier: Apache-2.0
// The motion of what pixels show, compared with projections worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/render/motion_vectors.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {
namespace {

/// Two boxes in front of an observer who moves, too. The first box moves and turns.
Scene moving_scene(const std::string& display, const std::string& tracks) {
    return parse_scene(R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-2, -2, -2], "max": [2, 2, 2]}},
"models": {"box": {"shape": "box", "size": [1, 1, 0.2]}},
"objects": [{"name": "a", "model": "box", "position": [0.3, 0.2, 0]},
            {"name": "b", "model": "box", "position": [-0.5, 0, 0.4]}],
"lights": [],
"observer": {"position": [0, 0, -4], "look_at": [0, 0, 0], "display": )" +
                           display + R"(},
"render": {"size": [200, 100]},
"animation": {"frames": 5, "tracks": [)" +
                           tracks + "]}}",
                       "motion.json", {});
}

/// The motion of one pixel that shows the `object` (from 1 on) at `point`.
struct Motion {
    float forward_u, forward_v, backward_u, backward_v;
};
Motion motion_of(const Scene& scene, int frame, uint32_t object, const glm::vec3& point) {
    Image image{1,
                1,
                {{"P.X", {point.x}}, {"P.Y", {point.y}}, {"P.Z", {point.z}}},
                {{"objectId", {object}}},
                {}};
    add_motion(scene, frame, image);
    const auto value = [&](const char* name) { return image.planes.at(name)[0]; };
    return {value("forward.u"), value("forward.v"), value("backward.u"), value("backward.v")};
}

constexpr const char* kSlide = R"({"target": "objects.a.position", "interpolation": "linear",
    "keys": [{"frame": 1, "value": [0.3, 0.2, 0]}, {"frame": 5, "value": [0.7, 0.2, 0]}]})";
constexpr const char* kPyramid = R"({"shape": "pyramid", "angles": [90, 60], "far": 9})";

TEST(Motion, OfASlidingBoxIsItsShareOfTheDisplay) {
    const Scene scene = moving_scene(R"({"shape": "box", "size": [4, 2, 8], "near": 0})", kSlide);
    // 0.1 m a frame towards +X, which is left for an observer who looks along +Z: 200 pixels are 4
    // m.
    const Motion m = motion_of(scene, 3, 1, {0.5f, 0.3f, -0.1f});
    EXPECT_NEAR(m.forward_u, -5, 1e-4);
    EXPECT_NEAR(m.backward_u, 5, 1e-4);
    EXPECT_NEAR(m.forward_v, 0, 1e-4);
    EXPECT_NEAR(motion_of(scene, 5, 1, {0.5f, 0.3f, -0.1f}).forward_u, 0, 1e-4);  // its last frame
    EXPECT_EQ(motion_of(scene, 3, 2, {-0.5f, 0, 0.3f}).forward_u, 0);  // the other stands still
    EXPECT_EQ(motion_of(scene, 3, 0, {0, 0, 0}).backward_u, 0);
}

TEST(Motion, FallsWithTheDistanceInAPyramid) {
    const Scene scene = moving_scene(kPyramid, kSlide);
    // At a depth of 3.9 m half of the width, 100 pixels, is 3.9 m.
    const Motion m = motion_of(scene, 2, 1, {0.5f, 0.3f, -0.1f});
    EXPECT_NEAR(m.forward_u, -0.1 / 3.9 * 100, 1e-4);
    EXPECT_NEAR(m.backward_u, 0.1 / 3.9 * 100, 1e-4);
}

TEST(Motion, ATurningBoxTakesItsPointsAlong) {
    const Scene scene = moving_scene(kPyramid, R"({"target": "objects.a.turn",
        "interpolation": "linear",
        "keys": [{"frame": 1, "value": [0, 0, 0]}, {"frame": 5, "value": [0, 0, 40]}]})");
    // The point lies 0.4 m along X from the axis at (0.3, 0.2), and turns by 10 degrees.
    const double angle = 10 * std::numbers::pi / 180, depth = 3.9;
    const Motion m = motion_of(scene, 1, 1, {0.7f, 0.2f, -0.1f});
    EXPECT_NEAR(m.forward_u, -0.4 * (std::cos(angle) - 1) / depth * 100, 1e-4);
    EXPECT_NEAR(m.forward_v, 0.4 * std::sin(angle) / (depth * std::tan(std::numbers::pi / 6)) * 50,
                1e-4);
}

TEST(Motion, AMovingObserverMovesWhatStandsStill) {
    const Scene scene = moving_scene(kPyramid, R"({"target": "observer.position",
        "interpolation": "linear",
        "keys": [{"frame": 1, "value": [0, 0, -4]}, {"frame": 5, "value": [0, 0, -3.2]}]},
        {"target": "observer.look_at", "keys": [{"frame": 1, "value": [0, 0, 9]}]})");
    // Nearer by 0.2 m, what lies off the axis moves outwards.
    const Motion m = motion_of(scene, 1, 2, {-0.5f, 0.25f, 0.4f});
    EXPECT_NEAR(m.forward_u, 0.5 * (1 / 4.2 - 1 / 4.4) * 100, 1e-4);
    EXPECT_NEAR(m.forward_v, 0.25 / std::tan(std::numbers::pi / 6) * (1 / 4.2 - 1 / 4.4) * 50,
                1e-4);
    EXPECT_EQ(m.backward_u, 0);
}

TEST(Motion, GoesTheShorterWayAroundAPictureOfAllDirections) {
    // Behind the observer, on both sides of the picture's edge: 0.1 m to the left at 4 m.
    const Scene scene = moving_scene(R"({"shape": "ball", "radius": 9})",
                                     R"({"target": "objects.a.position", "interpolation": "linear",
        "keys": [{"frame": 1, "value": [-0.05, 0, 0]}, {"frame": 2, "value": [0.05, 0, 0]}]},
        {"target": "observer.look_at", "keys": [{"frame": 1, "value": [0, 0, -9]}]})");
    const Motion m = motion_of(scene, 1, 1, {-0.05f, 0, 0});
    EXPECT_NEAR(m.forward_u, -2 * std::atan(0.05 / 4) / std::numbers::pi * 100, 1e-3);
    EXPECT_NEAR(m.forward_v, 0, 1e-4);
}

TEST(Motion, OfParallelRaysIsInMetresOfThePicture) {
    const Scene scene = parse_scene(R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-2, -2, -2], "max": [2, 2, 2]}},
"models": {"box": {"shape": "box", "size": [1, 1, 0.2]}},
"objects": [{"name": "a", "model": "box", "position": [0.3, 0.2, 0]}], "lights": [],
"observer": {"position": [0, 0, -4], "projection": "orthographic", "height": 2},
"render": {"size": [200, 100]},
"animation": {"frames": 5, "tracks": [{"target": "observer.height", "interpolation": "linear",
    "keys": [{"frame": 1, "value": 2}, {"frame": 5, "value": 4}]}]}})",
                                    "motion.json", {});
    // A point 0.5 m left of the middle is 25 of 50 pixels away at 2 m, and 20 at 2.5 m.
    const Motion m = motion_of(scene, 1, 1, {0.5f, 0.25f, -0.1f});
    EXPECT_NEAR(m.forward_u, 5, 1e-4);
    EXPECT_NEAR(m.forward_v, -2.5, 1e-4);
}

TEST(Motion, PlacesAreThoseOfSightRaysInEveryShape) {
    for (const char* display : {kPyramid, R"({"shape": "sector", "angle": 200, "far": 9})",
                                R"({"shape": "ball", "radius": 5})",
                                R"({"shape": "box", "size": [4, 2, 8], "near": 0})"}) {
        const Scene scene = scene_at(moving_scene(display, kSlide), 1);
        const Display& shape = scene.observer.display;
        for (const glm::dvec2 uv : {glm::dvec2(0.3, -0.2), glm::dvec2(-0.55, 0.4)}) {
            const glm::dvec3 p = shape_row(shape).point_on_ray(shape, uv, 2.5);
            const auto position = position_in_picture(
                scene, scene.observer.position + scene.observer.world_from_observer * p);
            ASSERT_TRUE(position) << display;
            EXPECT_NEAR(position->x, (uv.x + 1) * 100, 1e-9) << display;
            EXPECT_NEAR(position->y, (uv.y + 1) * 50, 1e-9) << display;
        }
    }
    EXPECT_FALSE(position_in_picture(moving_scene(kPyramid, kSlide), {0, 0, -5}));
}

}  // namespace
}  // namespace voxelume
