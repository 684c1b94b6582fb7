// SPDX-License-Identifier: Apache-2.0
// The errors of wrong tracks.
#include "runtime/scene_file/scene_track.hpp"
#include "runtime/scene_file/read_scene.hpp"

#include <gmock/gmock.h>

#include "runtime/base/error.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/scene/scene_animation.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A scene with tracks, the first of which begins on line 13.
std::string scene_with_tracks(const std::string& tracks) {
    return R"({"voxelume": 1,
"world": {"voxel_size": 0.5, "bounds": {"min": [-1, -2, -3], "max": [1, 2, 3]}},
"materials": {"brick": {"color": [1, 0, 0]}, "my.glass": {"ior": 1.33}},
"models": {"ball": {"shape": "sphere", "radius": 1, "surface": "smooth"},
           "block": {"shape": "difference", "parts": [
             {"shape": "box", "size": [1, 2, 3]}, {"shape": "sphere", "radius": 1}], "surface": "smooth"}},
"objects": [{"name": "b", "model": "ball"},
            {"model": "block", "matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}, {"name": "c", "model": "ball", "scale": 2}],
"lights": [{"name": "sun", "type": "directional", "direction": [0, -1, 0]},
           {"name": "lamp", "type": "spot", "position": [0, 1, 0], "look_at": [0, 0, 0], "inner_angle": 20}],
"observer": {"position": [0, 0, -3], "look_at": [0, 0, 0], "display": {"shape": "pyramid", "near": 1, "far": 5}},
"animation": {"frames": 9, "tracks": [
)" + tracks +
           "]}}";
}

std::string track(const std::string& target, const std::string& keys,
                  const std::string& more = "") {
    return R"({"target": ")" + target + R"(", "keys": [)" + keys + "]" + more + "}";
}

/// A track whose keys at frames 1, 2, ... have the values.
std::string values(const std::string& target, const std::vector<std::string>& values,
                   const std::string& more = "") {
    std::string keys;
    for (size_t i = 0; i < values.size(); ++i)
        keys +=
            (i == 0 ? "" : ", ") + fmt::format(R"({{"frame": {}, "value": {}}})", i + 1, values[i]);
    return track(target, keys, more);
}

std::string message_of_tracks(const std::string& tracks) {
    try {
        parse_scene(scene_with_tracks(tracks), "s.json", {});
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::scene) << error.what();
        return error.what();
    }
    return "no error";
}

struct Case {
    std::string tracks;
    const char* message;
};

}  // namespace

TEST(Tracks, AreAcceptedOnWhatCanChange) {
    for (const char* target :
         {"objects.b.position", "objects[0].turn", R"(materials.\"my.glass\".color)",
          "materials.brick.emission", "models.block.parts[0].size",
          "models.block.parts[1].position", "lights.lamp.position", "lights[0].color",
          "observer.position", "world.background"})
        EXPECT_EQ(message_of_tracks(values(target, {"[0.5, 0.5, 0.25]", "[0.1, 0.2, 0.3]"})),
                  "no error")
            << target;
    EXPECT_EQ(message_of_tracks(values("objects.b.position[2]", {"1", "2"})),
              "s.json:13:12: animation.tracks[0].target: objects[0] has no \"position\" to change");
    EXPECT_EQ(message_of_tracks(values("lights.sun.direction[2]", {"1", "2"})), "no error");
}

TEST(Tracks, OnWhatIsNotThereGetTheNearestName) {
    const Case cases[] = {
        {values("objects.c1.position", {"[1, 2, 3]"}), "no object named \"c1\""},
        {values("materials.brik.color", {"[1, 1, 1]"}),
         "no material named \"brik\"; did you mean \"brick\"?"},
        {values("models.bal.radius", {"1"}), "no model named \"bal\"; did you mean \"ball\"?"},
        {values("lights.son.color", {"[1, 1, 1]"}),
         "no light named \"son\"; did you mean \"sun\"?"},
        {values("objects.table.position", {"[1, 2, 3]"}),
         "no object named \"table\"; known are \"b\", \"c\"; 1 of 3 have no name: give them one, "
         "or "
         "write places such as \"objects[0]\""},
        {values("objects.b.rotation", {"[1, 2, 3]"}),
         "objects[0] has no value \"rotation\" that can change; did you mean \"turn\"?"},
        {values("object.b.position", {"[1, 2, 3]"}),
         "starts with \"object\", which is no part of a scene that can change; did you mean "
         "\"objects\"?"},
        {values("objects.b.positoin", {"[1, 2, 3]"}),
         "objects[0] has no value \"positoin\" that can change; did you mean \"position\"?"},
        {values("models.block.parts.size", {"[1, 2, 3]"}), "which of parts? Write its place"},
        {values("models.block.parts[2].size", {"[1, 2, 3]"}),
         "there is no parts[2]: parts has 2 items"},
        {values("models.ball.parts[0].radius", {"1"}), "models.ball has no \"parts\" to change"},
        {values("models.ball.voxel_size", {"1"}), "has no value \"voxel_size\" that can change"},
        {values("world.medium.color", {"[1, 1, 1]"}), "world has no \"medium\" to change"},
        {values("lights[2].color", {"[1, 1, 1]"}), "there is no lights[2]: lights has 2 items"},
        {values("observer", {"1"}), "names no value of observer; known are \"position\""},
        {values("lights.sun.direction[1].x", {"1"}), "goes on behind a number of \"direction\""},
        {values("lights.sun.direction[3]", {"1"}), "direction has 3 items"},
        {values("objects[1].position", {"[1, 2, 3]"}),
         "objects[1] is placed by its \"matrix\"; write \"position\", \"turn\" and \"scale\" "
         "instead"},
        {values("objects.c.scale[1]", {"2"}),
         "scale is one number here; change it as a whole, or write it as a list"},
        {values("objects..position", {"1"}), "can't be read; write keys with dots between"},
        {values("objects[x].position", {"1"}), "can't be read"},
        {values("objects[1", {"1"}), "can't be read"},
        {values("objects[99999999999999999999].position", {"1"}), "can't be read"},
    };
    for (const Case& wrong : cases) {
        EXPECT_THAT(message_of_tracks(wrong.tracks),
                    StartsWith("s.json:13:12: animation.tracks[0].target: "));
        EXPECT_THAT(message_of_tracks(wrong.tracks), HasSubstr(wrong.message));
    }
}

TEST(Tracks, WithWrongKeysSayWhich) {
    const Case cases[] = {
        {track("objects.b.position", ""), "tracks[0].keys: needs at least one key"},
        {track("objects.b.position", R"({"value": [1, 2, 3]})"),
         "keys[0]: needs a \"frame\" or a \"time\" in seconds"},
        {track("objects.b.position", R"({"frame": 1, "time": 2, "value": [1, 2, 3]})"),
         "keys[0].time: \"frame\" and \"time\" say the same thing"},
        {track("objects.b.position", R"({"frame": 1})"), "keys[0]: needs a \"value\""},
        {track("objects.b.position", R"({"frame": 3, "value": [1, 2, 3]},
                {"frame": 3, "value": [1, 2, 3]})"),
         "s.json:14:17: animation.tracks[0].keys[1]: comes at frame 3, not after the key before "
         "it, which comes at 3"},
        {track("objects.b.position",
               R"({"frame": 5, "value": [1, 2, 3]}, {"time": 0.1, "value": [1, 2, 3]})"),
         "comes at frame 3.4000000000000004, not after"},
        {values("objects.b.scale", {"1", "[1, 2, 3]"}), "keys[1].value: has another form"},
        {values("objects.b.scale", {"null"}), "keys[0].value: needs a number, a list of numbers"},
        {values("objects.b.position", {"[]"}), "keys[0].value: must not be an empty list"},
        {values("objects.b.position", {R"([1, "a", 2])"}),
         "keys[0].value[1]: needs a number here, not text"},
        {values("objects.b.position", {"[1, 2, 3]"}, R"(, "interpolation": "cubc")"),
         "interpolation: does not know \"cubc\"; did you mean \"cubic\"?"},
        {values("objects.b.visible", {"true", "false"}, R"(, "interpolation": "linear")"),
         "there is nothing between two texts, or true and false; write \"step\""},
        {values("objects.b.position", {"[1, 2, 3]"}, R"(, "interpolation": "slerp")"),
         "is for turns [psi, theta, gamma] only"},
        {values("objects.b.position", {"[1, 2, 3]"}, R"(, "repeat": true)"),
         "tracks[0]: unknown key \"repeat\""},
        {values("objects.b.turn", {"[1, 2, 3]"}) + ",\n" + values("objects[0].turn", {"[1, 2, 3]"}),
         "s.json:14:12: animation.tracks[1].target: another track changes this value already: "
         "s.json:13:1: animation.tracks[0]"},
        {values("lights.sun.direction", {"[1, 2, 3]"}) + ",\n" +
             values("lights.sun.direction[1]", {"2"}),
         "another track changes this value already"},
    };
    for (const Case& wrong : cases)
        EXPECT_THAT(message_of_tracks(wrong.tracks), HasSubstr(wrong.message));
}

TEST(Tracks, WithValuesThatTheirTargetRefusesPointAtTheKey) {
    EXPECT_EQ(message_of_tracks(values("materials.brick.diffuse", {"0.5", "1.5"})),
              "s.json:13:98: materials.brick.diffuse: must be from 0 to 1; it is 1.5 (at frame 2)");
    const Case cases[] = {
        {values("objects.b.position", {"[1, 2, 3, 4]"}),
         "objects[0].position: needs 3 numbers, not 4 (at frame 1)"},
        {values("objects.b.position", {"1"}), "needs a list of 3 numbers here, not a number"},
        {values("objects.b.visible", {"1"}), "objects[0].visible: needs true or false here, not"},
        {values("objects.b.model", {R"("ball")", R"("bal")"}),
         "objects[0].model: no model named \"bal\"; did you mean \"ball\"? (at frame 2)"},
        {values("objects.b.scale", {"1", "0"}), "objects[0].scale: is singular"},
        {values("models.ball.tube", {"1"}), "models.ball: unknown key \"tube\""},
        {values("observer.turn", {"[1, 2, 3]"}), "\"look_at\" and \"turn\" say the same thing"},
        {values("lights.lamp.angle", {"50", "10"}), "must not be larger than the spot's angle"},
        {values("observer.display.near", {"1", "6"}), "nothing lies between near, 6 m, and far"},
    };
    for (const Case& wrong : cases)
        EXPECT_THAT(message_of_tracks(wrong.tracks), HasSubstr(wrong.message));
}

TEST(Tracks, ThatGoWrongBetweenKeysSayWhereWhenTheFrameIsMade) {
    const Scene scene = parse_scene(
        scene_with_tracks(track("observer.look_at", R"({"frame": 1, "value": [0, 0, -7]},
            {"frame": 9, "value": [0, 0, 1]})")),
        "s.json", {});
    EXPECT_NO_THROW(scene_at(scene, 4));
    try {
        scene_at(scene, 5);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::scene);
        EXPECT_THAT(error.what(), StartsWith("s.json:13:"));
        EXPECT_THAT(error.what(), HasSubstr("observer.look_at: is the position itself"));
        EXPECT_THAT(error.what(), HasSubstr("(at frame 5)"));
    }
}

}  // namespace voxelume
