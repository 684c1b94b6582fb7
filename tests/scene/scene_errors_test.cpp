// SPDX-License-Identifier: Apache-2.0
// The errors of wrong scene files.
#include <gmock/gmock.h>

#include <filesystem>

#include "runtime/base/error.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/scene/small_scene.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

Scene parse(const std::string& text) {
    return parse_scene(text, "room.json", {});
}

/// The message for a wrong scene; its kind must be `scene`.
std::string message(const std::string& text) {
    try {
        parse(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::scene) << error.what();
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST(SceneErrors, TellLineColumnKeyPathAndTheNearestName) {
    EXPECT_EQ(
        message(scene_with(R"("objects": [
  {"model": "ball",
   "material": "brik"}],)")),
        "room.json:7:16: objects[0].material: no material named \"brik\"; did you mean \"brick\"?");
    EXPECT_EQ(message(scene_with(R"("objects": [{"model": "flor"}],)")),
              "room.json:5:23: objects[0].model: no model named \"flor\"; did you mean \"floor\"?");
}

TEST(SceneErrors, ANameIsThatOfOneObject) {
    constexpr const char* kTwice = "another object is named \"objects[1]\" already";
    EXPECT_THAT(message(scene_with(R"("objects": [{"name": "objects[1]", "model": "ball"},
                                               {"model": "ball"}],)")),
                HasSubstr(kTwice));
    EXPECT_THAT(message(scene_with(R"("objects": [{"model": "ball"}, {"model": "ball"},
                                  {"name": "objects[1]", "model": "ball"}],)")),
                HasSubstr(kTwice));
}

TEST(SceneErrors, PointAtUnknownKeysThemselves) {
    EXPECT_EQ(message(scene_with(R"(   "ligths": [],)")),
              "room.json:5:4: unknown key \"ligths\"; did you mean \"lights\"?");
    EXPECT_EQ(message(scene_with(R"("render": {"depth": 1, "Samples": 4},)")),
              "room.json:5:24: render: unknown key \"Samples\"; did you mean "
              "\"samples\"?");
    EXPECT_THAT(
        message(scene_with(R"("lights": [{"type": "point", "position": [0,1,2], "angle": 9}],)")),
        HasSubstr("unknown key \"angle\"; known are \"name\", \"type\""));
}

TEST(SceneErrors, KnowTheWordsOfOtherPrograms) {
    const auto object_with = [](const std::string& key) {
        return message(
            scene_with("\"objects\": [{\"model\": \"ball\", \"" + key + "\": [1, 2, 3]}],"));
    };
    EXPECT_THAT(object_with("rotation"),
                EndsWith("objects[0]: unknown key \"rotation\"; did you mean \"turn\"?"));
    EXPECT_THAT(object_with("translation"), EndsWith("did you mean \"position\"?"));
    EXPECT_THAT(object_with("to_world"), EndsWith("did you mean \"matrix\"?"));
    EXPECT_THAT(object_with("positoin"), EndsWith("did you mean \"position\"?"));
    EXPECT_THAT(message(scene_with(R"("render": {"spp": 4},)")),
                EndsWith("unknown key \"spp\"; did you mean \"samples\"?"));
    EXPECT_THAT(message(scene_with(R"("render": {"camera": 4},)")),
                HasSubstr("unknown key \"camera\"; known are"))
        << "render has no observer";
}

TEST(SceneErrors, HaveTheRightArticle) {
    const auto track = [](const std::string& members) {
        return message(scene_with(R"("animation": {"tracks": [{)" + members + "}]},"));
    };
    EXPECT_THAT(track(""), EndsWith("tracks[0]: needs a \"target\""));
    const auto observer = [](const std::string& display) {
        return message(R"({"voxelume": 1, "world": {"bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}},
"observer": {"position": [0, 0, 0], "display": {)" +
                       display + "}}}");
    };
    EXPECT_THAT(observer(R"("shape": "sector")"), EndsWith("observer.display: needs an \"angle\""));
    EXPECT_THAT(observer(""), HasSubstr("observer.display: needs a \"shape\"; known are"));
}

TEST(SceneErrors, CountColumnsInCharactersAndSkipCommentsAndTheByteOrderMark) {
    EXPECT_THAT(message("\xEF\xBB\xBF{ // {\"\n /* \xC3\xA4\xC3\xB6 , */ \"voxelume\": "
                        "\"\xC3\xA9\\\"\", \"worl\": 1}"),
                StartsWith("room.json:2:32: unknown key \"worl\""));
    EXPECT_THAT(message("{\"voxelume\"/*:*/:1// :\n,/**/\"x\":2}"),
                StartsWith("room.json:2:6: unknown key \"x\""));
    EXPECT_THAT(message("{\"voxelume\": 1,\r\n\t\"x\": 2}"),
                StartsWith("room.json:2:2: unknown key \"x\""));
}

TEST(SceneErrors, TellWhereTextStopsBeingJson) {
    EXPECT_THAT(message("{\"voxelume\": 1,\n  \"world\": }"),
                StartsWith("room.json:2:12: this is not JSON: "));
    EXPECT_THAT(message(""), StartsWith("room.json:1:1: this is not JSON: "));
    EXPECT_THAT(message("Kaydara FBX"), HasSubstr("are known by their endings"));
    EXPECT_THAT(message("{\"voxelume\": NaN}"), StartsWith("room.json:1:14: this is not JSON: "));
    EXPECT_THAT(message("{\"voxelume\": 1e999}"), HasSubstr("number overflow"));
    EXPECT_THAT(message("{\"voxelume\": 1} 2"), StartsWith("room.json:1:17: this is not JSON: "));
    EXPECT_THAT(message(std::string("{\"a\0\": 1}", 9)),
                StartsWith("room.json:1:4: this is not JSON: "));
}

TEST(SceneErrors, ReportKeysThatStandTwice) {
    EXPECT_EQ(message(scene_with("\"render\": {\"depth\": 1,\n \"depth\": 2},")),
              "room.json:6:2: the key \"depth\" stands twice in this object");
}

TEST(SceneErrors, RefuseDepthBombsAndBreadthBombs) {
    EXPECT_EQ(message(std::string(5'000'000, '[')),
              "room.json:1:65: values are nested more than 64 levels deep");
    std::string many = "[0";
    for (int i = 0; i < 2'000'000; ++i) many += ",0";
    EXPECT_THAT(message(many + "]"), HasSubstr("a scene holds at most 2000000 values"));

    std::string part = R"({"shape": "sphere", "radius": 1})";
    for (int i = 0; i < kMaxSolidDepth; ++i)
        part = R"({"shape": "union", "parts": [)" + part + "]}";
    const std::string scene =
        R"({"voxelume": 1, "models": {"m": )" + part +
        R"(}, "world": {"voxel_size": 1, "bounds": {"min": [0,0,0], "max": [1,2,3]}}})";
    EXPECT_THAT(message(scene), HasSubstr("solids are nested more than 16 levels deep"));
}

TEST(SceneErrors, SayWhatIsNeededInsteadOfAWrongType) {
    EXPECT_EQ(message(scene_with(R"("objects": 3,)")),
              "room.json:5:12: objects: needs a list in [ ] here, not a number");
    EXPECT_EQ(message(scene_with(R"("render": {"size": [640, 4.5]},)")),
              "room.json:5:26: render.size[1]: needs a whole number here, not 4.5");
    EXPECT_EQ(message(scene_with(R"("render": {"samples": 0},)")),
              "room.json:5:23: render.samples: must be from 1 to 4096; it is 0");
    EXPECT_EQ(message(scene_with(R"("lights": [{"type": "point", "position": [1, 2]}],)")),
              "room.json:5:42: lights[0].position: needs 3 numbers, not 2");
    EXPECT_EQ(message(scene_with(R"("objects": [{"position": [1, 2, 3]}],)")),
              "room.json:5:13: objects[0]: needs a \"model\"");
    EXPECT_THAT(message(scene_with(R"("lights": [{"type": "spott"}],)")),
                EndsWith("does not know \"spott\"; did you mean \"spot\"?"));
    EXPECT_THAT(message("{\"voxelume\": 2}"), HasSubstr("reads version 1"));
    EXPECT_THAT(message("[]"), HasSubstr("needs an object in { }"));
}

TEST(SceneErrors, RefuseWorldsWithoutVolumeOrWithSenselessVoxels) {
    const auto world = [](const std::string& members) {
        return "{\"voxelume\": 1,\n\"world\": {" + members + "}}";
    };
    const std::string bounds = R"("bounds": {"min": [-1, -2, -3], "max": [1, 2, 3]})";
    EXPECT_EQ(
        message(world("\"voxel_size\": -0.01, " + bounds)),
        "room.json:2:25: world.voxel_size: must be above 0 and at most 1000000000; it is -0.01");
    EXPECT_THAT(message(world("\"voxel_size\": [0.1, 0, 0.1], " + bounds)),
                HasSubstr("world.voxel_size[1]: must be above 0"));
    EXPECT_EQ(
        message(world(R"("voxel_size": 1, "bounds": {"min": [0, 5, 0], "max": [1, 5, 1]})")),
        "room.json:2:38: world.bounds: empty along y: min is 5 and max is 5; max must be larger");
    try {
        parse(world("\"voxel_size\": 1e-6, " + bounds));
        ADD_FAILURE() << "a world of millions of voxels along an axis was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::limit);
        EXPECT_THAT(
            error.what(),
            StartsWith("room.json:2:10: world: 2000000 voxels along x are more than 65536"));
    }
}

TEST(SceneErrors, KeepControlCharactersOfNamesOffTheTerminal) {
    EXPECT_THAT(message(scene_with(R"("objects": [{"model": "a\u001b[31m\n"}],)")),
                HasSubstr("\"a?[31m?\""));
    EXPECT_LT(
        message(scene_with("\"objects\": [{\"model\": \"" + std::string(100000, 'x') + "\"}],"))
            .size(),
        300u);
}

TEST(SceneErrors, RefuseSingularPlacements) {
    const auto refused = [](const std::string& factors) {
        return message(scene_with("\"objects\": [{\"model\": \"ball\",\n" + factors + "}],"));
    };
    EXPECT_EQ(refused(R"("scale": [1, 0, 1])"),
              "room.json:6:10: objects[0].scale: is singular: it flattens the object to nothing in "
              "one direction");
    EXPECT_THAT(refused(R"("matrix": [[1, 2, 3, 0], [2, 4, 6, 0], [0, 0, 1, 0]])"),
                HasSubstr("singular"));
    EXPECT_THAT(refused(R"("scale": [1, 1e-6, 1])"), HasSubstr("stretches 1e+06 times as much"));
    EXPECT_THAT(refused(R"("matrix": [[1, 1e6, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]])"),
                HasSubstr("close to singular"));
    EXPECT_THAT(
        refused(R"("matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]], "turn": [1, 2, 3])"),
        HasSubstr("\"turn\" and \"matrix\" say the same thing"));
    EXPECT_EQ(refused(R"("scale": [1, 2e-5, 1])"), "no error");
    EXPECT_EQ(refused(R"("scale": 1e-6)"), "no error");
}

TEST(SceneErrors, RefuseAViewParallelToUp) {
    const auto refused = [](const std::string& members) {
        return message(
            R"({"voxelume": 1, "world": {"voxel_size": 1, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}},
"observer": {"position": [1, 2, 3], "display": {"shape": "ball", "radius": 1},)" +
            members + "}}");
    };
    EXPECT_THAT(
        refused(R"("look_at": [1, -7, 3])"),
        AllOf(StartsWith("room.json:2:90: observer.look_at: "), HasSubstr("parallel to \"up\"")));
    EXPECT_THAT(refused(R"("up": [0, 0, -2])"), HasSubstr("parallel to \"up\""));
    EXPECT_THAT(refused(R"("look_at": [1, 2, 3])"), HasSubstr("is the position itself"));
    EXPECT_THAT(refused(R"("up": [0, 0, 0], "look_at": [0, 0, 0])"), HasSubstr("must not be zero"));
    EXPECT_THAT(refused(R"("up": [0, 1, 0], "turn": [0, 0, 0])"),
                HasSubstr("leave one of them out"));
}

TEST(SceneErrors, RefuseALensWithoutFocusOrForAnotherShape) {
    const auto refused = [](const std::string& shape, const std::string& members) {
        return message(
            R"({"voxelume": 1, "world": {"voxel_size": 1, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}},
"observer": {"position": [1, 2, 9], "display": {"shape": )" +
            shape + R"(}, )" + members + "}}");
    };
    EXPECT_THAT(refused(R"("pyramid")", R"("aperture": 0.1)"),
                HasSubstr("\"focus\" or \"look_at\""));
    EXPECT_EQ(refused(R"("pyramid")", R"("aperture": 0.1, "focus": 2)"), "no error");
    EXPECT_EQ(refused(R"("pyramid")", R"("aperture": 0.1, "look_at": [0, 0, 0])"), "no error");
    EXPECT_THAT(refused(R"("ball", "radius": 3)", R"("aperture": 0.1, "focus": 2)"),
                HasSubstr("\"pyramid\""));
    EXPECT_THAT(refused(R"("pyramid")", R"("aperture": -1, "focus": 2)"), HasSubstr("aperture"));
    EXPECT_THAT(refused(R"("pyramid")", R"("aperture": 1, "focus": 0)"), HasSubstr("focus"));
    EXPECT_THAT(refused(R"("pyramid")", R"("aperture": 1, "focus": 0.0009)"),
                HasSubstr("at most 1,000 times"));
    EXPECT_EQ(refused(R"("pyramid")", R"("aperture": 1, "focus": 0.0011)"), "no error");
}

TEST(SceneErrors, OfLightsWithAnArea) {
    EXPECT_THAT(message(scene_with(R"("lights": [{"type": "disk", "position": [0, 1, 2],
        "direction": [0, -1, 0]}],)")),
                HasSubstr("radius"));
    EXPECT_THAT(message(scene_with(R"("lights": [{"type": "rectangle", "position": [0, 1, 2],
        "direction": [0, -1, 0], "up": [0, 2, 0], "size": [1, 2]}],)")),
                HasSubstr("parallel to \"up\""));
    EXPECT_THAT(message(scene_with(R"("lights": [{"type": "disk", "position": [0, 1, 2],
        "direction": [0, -1, 0], "radius": 1, "spots": 0}],)")),
                HasSubstr("lights[0].spots"));
    EXPECT_THAT(message(scene_with(R"("objects": [{"model": "ball", "spots": 9}],)")),
                HasSubstr("none of the object's materials has emission"));
}

}  // namespace voxelume
