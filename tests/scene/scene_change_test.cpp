// SPDX-License-Identifier: Apache-2.0
// Values changed before a scene is read, and observers that go round.
#include "runtime/scene_file/document/scene_change.hpp"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "runtime/scene_file/document/orbit.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/scene/fitted_scenes.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kRoom = std::string(kBall) + R"(,
"materials": {"red": {"color": [1, 0, 0]}},
"lights": [{"type": "point", "position": [0, 9, 0]},
           {"name": "key", "type": "point", "position": [0, 9, 5]}],
"observer": {"position": [1, 0, 8], "look_at": [1, -2, 3], "display": {"shape": "pyramid"}})";

Scene room_with(const std::vector<std::pair<std::string, std::string>>& values) {
    std::vector<SceneChange> changes;
    for (const auto& [path, value] : values)
        changes.push_back({path, value, "--set " + path + "=" + value});
    const JsonValue document = parse_json(scene_with_members(kRoom), "s.json");
    return read_changed(document, changes,
                        [](const JsonValue& d) { return read_scene(d, "s.json", {}); });
}

std::string refusal_of(const std::string& path, const std::string& value) {
    const Error error = error_of([&] { room_with({{path, value}}); });
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    EXPECT_THAT(error.what(), StartsWith("--set " + path + "=" + value + ":"));
    return error.what();
}

TEST(SceneChange, GoesByNameByPlaceAndIntoWhatIsMissing) {
    const Scene scene = room_with({{"objects.ball.position", "0,1,-0.5"},
                                   {"lights[0].intensity", "4"},
                                   {"lights.1.color", "[0.5, 0.25, 1]"},
                                   {"render.samples", "9"},
                                   {"objects.ball.material", "red"},
                                   {"objects.ball.visible", "true"},
                                   {"lights.key.position[2]", "+7"},
                                   {"models.ball.radius", ".25"}});
    EXPECT_EQ(scene.objects[0].world_from_object[3], glm::dvec4(0, 1, -0.5, 1));
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(4));
    EXPECT_EQ(scene.lights[1].position, glm::dvec3(0, 9, 7));
    EXPECT_EQ(scene.render.samples, 9);
    EXPECT_EQ(scene.materials[size_t(scene.objects[0].material)].name, "red");
    EXPECT_EQ(scene.models[0].solid->radius, 0.25);
}

TEST(SceneChange, NullRemovesAKeyOrAnItem) {
    EXPECT_EQ(room_with({{"lights.0", "null"}}).lights.size(), 1u);
    EXPECT_EQ(room_with({{"lights", "null"}}).lights.size(), 1u) << "the default light";
    EXPECT_EQ(room_with({}).materials.size(),
              room_with({{"materials.red", "null"}}).materials.size() + 1);
    const Scene scene = room_with({{"observer.display", "null"},
                                   {"observer.projection", "orthographic"},
                                   {"observer.width", "3"}});
    EXPECT_EQ(scene.observer.projection, Projection::orthographic);
    EXPECT_THAT(refusal_of("lights.none", "null"), HasSubstr("nothing named \"none\""));
    EXPECT_THAT(refusal_of("render.samples", "null"), HasSubstr("nothing named"));
}

TEST(SceneChange, TheLastOneOfAPathHolds) {
    EXPECT_EQ(room_with({{"render.samples", "4"}, {"render.samples", "2"}}).render.samples, 2);
}

TEST(SceneChange, AddsAWholeMaterialThatLaterChangesUse) {
    const Scene scene = room_with({{"materials.blue", R"({"color": [0, 0, 1]})"},
                                   {"materials.blue.color[0]", "0.5"},
                                   {"objects.0.material", "blue"}});
    const Material& material = scene.materials[size_t(scene.objects[0].material)];
    EXPECT_EQ(material.name, "blue");
    EXPECT_EQ(material.color, glm::vec3(0.5f, 0, 1));
}

TEST(SceneChange, WhatDoesntBelongThereIsNamedWithItsKeyAndTheNearestOne) {
    EXPECT_THAT(refusal_of("objects.ball.positon", "1,2,3"),
                HasSubstr(": objects[0]: unknown key \"positon\"; did you mean \"position\"?"));
    EXPECT_THAT(refusal_of("objects.ball.position", "1,2"),
                HasSubstr(": objects[0].position: needs 3 numbers, not 2"));
    EXPECT_THAT(refusal_of("lights.key.intensity", "-4"),
                HasSubstr(": lights[1].intensity: must be at least 0"));
    EXPECT_THAT(refusal_of("objects.bal.position", "1,2,3"), HasSubstr("did you mean \"ball\"?"));
    EXPECT_THAT(refusal_of("materials.rde.color", "1,1,1"), HasSubstr("did you mean \"red\"?"));
    EXPECT_THAT(refusal_of("lights[2].color", "1,1,1"), HasSubstr("lights has 2 items"));
    EXPECT_THAT(refusal_of("lights.18446744073709551616.color", "1,1,1"),
                HasSubstr("lights has nothing named"));
    EXPECT_THAT(refusal_of("objects.ball.name", "\xff"), HasSubstr("isn't UTF-8"));
    EXPECT_THAT(refusal_of("material.red", "1"), HasSubstr("did you mean \"materials\"?"));
    EXPECT_THAT(refusal_of("models.ball.radius.x", "1"),
                HasSubstr("models.ball.radius is a number"));
    EXPECT_THAT(refusal_of("models[0].radius", "1"), HasSubstr("models is no list"));
    EXPECT_THAT(refusal_of("objects.ball.material", "brick"), HasSubstr("no material named"));
    for (const char* path : {"", "a..b", "objects[", "objects[x]", "[0]", "objects.", "\""})
        EXPECT_THAT(refusal_of(path, "1"), HasSubstr("can't be read")) << path;
}

TEST(SceneChange, MistakesOfTheSceneKeepTheirPlaceInIt) {
    const JsonValue document = parse_json(
        scene_with_members(std::string(kBall) + ",\n\"render\": {\"samples\": 0}"), "s.json");
    const std::vector<SceneChange> changes = {{"objects.ball.position", "0,0,0", "--set"}};
    const Error error = error_of([&] {
        read_changed(document, changes,
                     [](const JsonValue& d) { return read_scene(d, "s.json", {}); });
    });
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_THAT(error.what(), StartsWith("s.json:4:23: render.samples:"));
}

TEST(SceneChange, ValuesAreNumbersListsJsonOrTexts) {
    const auto type = [](const char* text) { return parse_value(text, "o").type; };
    EXPECT_EQ(parse_value("-1e3", "o").number, -1000);
    EXPECT_EQ(parse_value(" 2 ", "o").number, 2);
    EXPECT_EQ(parse_value("1, 2,3", "o").items.size(), 3u);
    EXPECT_EQ(type("false"), JsonType::boolean);
    EXPECT_TRUE(parse_value("true", "o").boolean);
    EXPECT_EQ(parse_value("\"7\"", "o").text, "7");
    for (const char* text : {"red brick", "1,2,", "nan", "inf", "1,x", "", "a,b"}) {
        EXPECT_EQ(type(text), JsonType::string) << text;
        EXPECT_EQ(parse_value(text, "o").text, text);
    }
    for (const char* text : {"[1,2", "{\"a\": }", "\"a"}) {
        const Error error = error_of([&] { parse_value(text, "--set p"); });
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_THAT(error.what(), AllOf(StartsWith("--set p:1:"), HasSubstr("is not JSON")));
    }
}

/// The scene of `members` seen from `degrees` to the right.
Scene orbited_scene(const std::string& members, double degrees) {
    const JsonValue document = parse_json(scene_with_members(members), "s.json");
    return read_scene(orbited(document, read_scene(document, "s.json", {}), degrees), "s.json", {});
}

TEST(Orbit, AQuarterTurnShowsTheRightSideFromTheSameDistance) {
    const Observer observer = orbited_scene(kRoom, 90).observer;
    // Relative to the point that it looks at, the observer moves from (0, 2, 5) to (5, 2, 0).
    EXPECT_LT(glm::distance(observer.position, glm::dvec3(6, 0, 3)), 1e-12);
    const glm::dvec3 ahead = glm::normalize(glm::dvec3(-5, -2, 0));
    EXPECT_LT(glm::distance(observer.world_from_observer[2], ahead), 1e-12);
    EXPECT_LT(glm::distance(observer.world_from_observer[0], glm::dvec3(0, 0, 1)), 1e-12);
}

TEST(Orbit, GoesRoundTheMiddleOfTheWorldIfTheObserverLooksAtNothing) {
    const Observer observer =
        orbited_scene(R"("world": {"voxel_size": 0.5, "bounds": {"min": [0, 0, 0],
                          "max": [2, 4, 6]}}, "lights": [],
                          "observer": {"position": [1, 2, 9], "turn": [0, 180, 0],
                                       "display": {"shape": "pyramid"}})",
                      -90)
            .observer;
    EXPECT_LT(glm::distance(observer.position, glm::dvec3(-5, 2, 3)), 1e-12);
    EXPECT_LT(glm::distance(observer.world_from_observer[2], glm::dvec3(1, 0, 0)), 1e-12);
}

TEST(Orbit, AFittedObserverGoesRoundTheObjects) {
    const Scene scene = parse_members(kBall);
    const Observer& still = scene.observer;
    const Observer observer = orbited_scene(kBall, 180).observer;
    const glm::dvec3 middle = scene.fitted.look_at;
    EXPECT_NEAR(observer.position.y, still.position.y, 1e-12);
    EXPECT_NEAR(glm::distance(observer.position, middle), glm::distance(still.position, middle),
                1e-12);
    EXPECT_GT(glm::distance(observer.position, still.position), 1);
    EXPECT_EQ(observer.display.half_angles, still.display.half_angles);
    const double nearest = depth_of_nearest_corner(scene, observer);
    EXPECT_LE(observer.display.near, nearest) << "nothing is cut off";
    EXPECT_GT(observer.display.near, 0.99 * nearest);
}

TEST(Orbit, AnObserverThatMovesIsRefused) {
    const Error error = error_of([&] {
        orbited_scene(kRoom + R"(, "animation": {"frames": 2, "tracks": [
            {"target": "observer.position", "keys": [{"frame": 1, "value": [1, 0, 8]}]}]})",
                      90);
    });
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr("the observer moves"));
}

}  // namespace
}  // namespace voxelume
