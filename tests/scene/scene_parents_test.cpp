// SPDX-License-Identifier: Apache-2.0
// Objects that stand in parents, against products of matrices written out here.
#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "runtime/base/error.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/scene/small_scene.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

constexpr const char* kArm = R"("objects": [{"name": "arm", "model": "ball", "position": [0, 1, 0],
    "parents": [{"position": [1, 2, 3], "turn": [0, 0, 90], "scale": [1, 2, 1]},
                {"matrix": [[1, 0.5, 0, 4], [0, 1, 0, 0], [0, 0, 3, 0]]}]}])";

Scene scene_of_arm(const std::string& tracks) {
    return parse_scene(scene_with(std::string(kArm) +
                                  R"(, "animation": {"frames": 9, "tracks": [)" + tracks + "]},"),
                       "s.json", {});
}

glm::dvec3 moved(const Scene& scene, double frame, const glm::dvec3& p) {
    return {scene_at(scene, frame).objects[0].world_from_object * glm::dvec4(p, 1)};
}

std::string message_of(const std::string& tracks) {
    try {
        scene_of_arm(tracks);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST(Parents, PlaceAnObjectFromTheInnermostOutwards) {
    // (1, 1, 1) is (1, 2, 1) in the second parent, (6, 2, 3) in the first, which scales it to
    // (6, 4, 3), turns it to (-4, 6, 3) and shifts it.
    EXPECT_EQ(moved(scene_of_arm(""), 1, {1, 1, 1}), glm::dvec3(-3, 8, 6));
    EXPECT_FALSE(scene_of_arm("").objects[0].moves);
}

TEST(Parents, MoveWhatStandsInThem) {
    const Scene scene = scene_of_arm(
        R"({"target": "objects.arm.parents[0].turn",
            "keys": [{"frame": 1, "value": [0, 0, 90]}, {"frame": 5, "value": [0, 0, -90]}]},
           {"target": "objects.arm.position[0]",
            "keys": [{"frame": 1, "value": 0}, {"frame": 5, "value": 4}]})");
    EXPECT_TRUE(scene.objects[0].moves);
    EXPECT_EQ(moved(scene, 1, {1, 1, 1}), glm::dvec3(-3, 8, 6));
    // Halfway (3, 2, 1) -> (8, 2, 3) -> (8, 4, 3) -> (9, 6, 6); then turned to the other side.
    EXPECT_EQ(moved(scene, 3, {1, 1, 1}), glm::dvec3(9, 6, 6));
    EXPECT_EQ(moved(scene, 5, {1, 1, 1}), glm::dvec3(1 + 4, 2 - 10, 6));
}

TEST(Parents, TurnByQuaternions) {
    const double half = std::sqrt(0.5);
    const Scene scene = scene_of_arm(fmt::format(
        R"({{"target": "objects.arm.parents[0].turn",
             "keys": [{{"frame": 1, "value": [0, 0, {0}, {0}]}},
                      {{"frame": 5, "value": [0, 0, {0}, {1}]}}]}})",
        half, -half));
    EXPECT_LT(glm::distance(moved(scene, 1, {1, 1, 1}), glm::dvec3(-3, 8, 6)), 1e-14);
    EXPECT_LT(glm::distance(moved(scene, 5, {1, 1, 1}), glm::dvec3(5, -4, 6)), 1e-14);
}

TEST(Parents, WhoseScalesPassZeroAreSheetsThere) {
    const Scene scene = scene_of_arm(
        R"({"target": "objects.arm.scale",
            "keys": [{"frame": 1, "value": [1, 1, 1]}, {"frame": 5, "value": [1, -1, 1]}]},
           {"target": "objects.arm.position", "keys": [{"frame": 3, "value": [0, 1, 0]}]})");
    EXPECT_EQ(moved(scene, 1, {1, 1, 1}), glm::dvec3(-3, 8, 6));
    EXPECT_LT(glm::distance(moved(scene, 3, {1, 1, 1}), moved(scene, 3, {1, 0, 1})), 3e-4);
    EXPECT_GT(glm::distance(moved(scene, 3, {1, 1, 1}), moved(scene, 3, {1, 0, 1})), 1e-4);
    EXPECT_TRUE(scene_at(scene, 3).objects[0].visible);
    EXPECT_NE(moved(scene, 5, {1, 1, 1}), glm::dvec3(-3, 8, 6));
}

TEST(Parents, WhoseScalesPassZeroTogetherHideTheObject) {
    const char* const keys = R"("keys": [{"frame": 1, "value": 1}, {"frame": 5, "value": -1}])";
    const Scene scene = scene_of_arm(fmt::format(R"({{"target": "objects.arm.scale", {0}}},
                                    {{"target": "objects.arm.parents[0].scale", {0}}})",
                                                 keys));
    EXPECT_TRUE(scene_at(scene, 2).objects[0].visible);
    EXPECT_FALSE(scene_at(scene, 3).objects[0].visible);
    EXPECT_TRUE(scene_at(scene, 4).objects[0].visible);
}

TEST(Parents, ThatAreWrongSaySo) {
    EXPECT_THAT(
        message_of(
            R"({"target": "objects.arm.parents[1].scale", "keys": [{"frame": 1, "value": 2}]})"),
        HasSubstr("objects[0].parents[1] is placed by its \"matrix\""));
    EXPECT_THAT(
        message_of(
            R"({"target": "objects.arm.parents[2].scale", "keys": [{"frame": 1, "value": 2}]})"),
        HasSubstr("there is no parents[2]: parents has 2 items"));
    EXPECT_THAT(
        message_of(
            R"({"target": "objects.arm.parents[0].visible", "keys": [{"frame": 1, "value": 2}]})"),
        HasSubstr("has no value \"visible\" that can change"));
    EXPECT_THAT(
        message_of(
            R"({"target": "objects.arm.parents[0].scale", "keys": [{"frame": 3, "value": 0}]})"),
        HasSubstr("objects[0].parents[0].scale: is singular"));
    EXPECT_THAT(message_of(R"({"target": "objects.arm.parents[0].turn", "interpolation": "linear",
                             "keys": [{"frame": 3, "value": [0, 0, 0, 1]}]})"),
                HasSubstr("is no way between quaternions"));
    EXPECT_THAT(message_of(R"({"target": "objects.arm.parents[0].turn",
                             "keys": [{"frame": 3, "value": [0, 0, 0, 0]}]})"),
                HasSubstr("is no quaternion"));
    EXPECT_THAT(message_of(R"({"target": "objects.arm.position",
                             "keys": [{"frame": 3, "value": [0, 0, 0], "in": [1, 0, 0]}]})"),
                HasSubstr("keys[0].in: is a slope of a spline"));
    EXPECT_THAT(message_of(R"({"target": "objects.arm.position", "interpolation": "spline",
                             "keys": [{"frame": 3, "value": [0, 0, 0], "out": 1}]})"),
                HasSubstr("keys[0].out: has 1 numbers, and the key's value has 3"));
}

}  // namespace voxelume
