// SPDX-License-Identifier: Apache-2.0
// One call for many pictures: values set and swept, several inputs, views from around.
#include <gmock/gmock.h>

#include "runtime/io/image/exr.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using CliInputsTest = SceneProgramTest;

TEST_F(CliInputsTest, ASetValueIsThatOfASceneThatHasIt) {
    ASSERT_EQ(run("render scene.json -q -o set.exr --set objects.thing.position=1,1,0.5 "
                  "--set materials.brick.color=0.1,0.2,0.3 --set render.size=24,10")
                  .exit_code,
              0);
    write_scene([](Json& scene) {
        scene["objects"][0]["position"] = {1, 1, 0.5};
        scene["materials"]["brick"]["color"] = {0.1, 0.2, 0.3};
        scene["render"]["size"] = {24, 10};
    });
    ASSERT_EQ(run("render scene.json -q -o written.exr").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "set.exr"), bytes_of(folder / "written.exr"));
}

TEST_F(CliInputsTest, AModelFilesSceneHasValuesToo) {
    put_bytes(folder / "wedge.obj", kTetrahedron);
    const std::string size = " --size 16x12 --samples 1 -q ";
    ASSERT_EQ(run("render wedge.obj -o a.exr --set world.background=1,0,0" + size).exit_code, 0);
    const Image image = read_exr(folder / "a.exr");
    EXPECT_EQ(image.planes.at("R").size(), 16u * 12u);
    EXPECT_THAT(expect_failure(2, "render wedge.obj -o a2.exr --set lights.sun.intensty=1"),
                HasSubstr("--set lights.sun.intensty=1: lights.sun: unknown key \"intensty\"; did "
                          "you mean \"intensity\"?"));
}

TEST_F(CliInputsTest, AWrongSettingNamesTheOptionAndTheKey) {
    EXPECT_THAT(expect_failure(2, "check scene.json --set objects.thing.position=1"),
                HasSubstr("check: --set objects.thing.position=1: objects[0].position: needs a "
                          "list of 3 numbers here, not a number"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.png --set objects.thing.position"),
                HasSubstr("give PATH=VALUE"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.png --set =1"),
                HasSubstr("give PATH=VALUE"));
}

TEST_F(CliInputsTest, ASweepRendersAllCombinations) {
    const ProgramResult result =
        run("render scene.json -o '{sun.color}-{ambient}-{sweep}.exr' "
            "--sweep lights.sun.color=[1,0,0],[0,1,0] --sweep world.ambient=[0,0,0],[1,1,1]");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("no placeholder \"sun.color\""));
    ASSERT_EQ(run("render scene.json -q -o '{color}-{world.ambient}-{sweep}.exr' "
                  "--sweep lights.sun.color=[1,0,0],[0,1,0] --sweep world.ambient=[0,0,0],[1,1,1]")
                  .exit_code,
              0);
    EXPECT_THAT(names(), ElementsAre("0,1,0-0,0,0-3.exr", "0,1,0-1,1,1-4.exr", "1,0,0-0,0,0-1.exr",
                                     "1,0,0-1,1,1-2.exr", "scene.json"));
    ASSERT_EQ(run("render scene.json -q -o set.exr --set lights.sun.color=0,1,0 "
                  "--set world.ambient=1,1,1")
                  .exit_code,
              0);
    EXPECT_EQ(bytes_of(folder / "set.exr"), bytes_of(folder / "0,1,0-1,1,1-4.exr"));
}

TEST_F(CliInputsTest, SweepsThatCantBeReadAreMistakes) {
    EXPECT_THAT(expect_failure(2, "render scene.json -o {x}.exr --sweep world.ambient=1,,2"),
                HasSubstr("there is an empty value next to a comma"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o {color}.exr --sweep lights.0.color=1,0,0"),
                HasSubstr("the value 0 stands there twice; lists are written in brackets"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o {x}.exr --sweep format=1,2"),
                HasSubstr("known are \"name\", \"frame\", \"sweep\", \"format\"\n"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.exr --sweep render.samples=1,2"),
                AllOf(HasSubstr("a.exr: this would be the output of both scene.json, samples=1 and "
                                "scene.json, samples=2"),
                      HasSubstr("{samples}")));
    for (const char* sweep : {"objects.0.name=p,q", "world.ambient=[1,0,0],[1, 0,0]"})
        EXPECT_THAT(
            expect_failure(2, fmt::format("render scene.json -o a.exr --sweep '{}'", sweep)),
            HasSubstr("have {sweep} in its name"));
}

TEST_F(CliInputsTest, NamesOfInputsStandForNoFrames) {
    for (const char* name : {"x##.json", "x01.json"})
        std::filesystem::copy_file(folder / "scene.json", folder / name);
    ASSERT_EQ(run("render 'x##.json' x01.json -q -o 'c-{name}.png'").exit_code, 0);
    EXPECT_THAT(names(),
                ElementsAre("c-x01.png", "c-x__.png", "scene.json", "x##.json", "x01.json"));
    std::filesystem::create_symlink("c-x01.png", folder / "c-scene.png");
    EXPECT_THAT(expect_failure(2, "render scene.json x01.json -o 'c-{name}.png'"),
                HasSubstr("this would be the output of both"));
}

TEST_F(CliInputsTest, WarmFillsNoCacheThatCantBeWritten) {
    const ProgramResult result =
        run_line("VOXELUME_CACHE_DIR=$PWD/scene.json voxelume warm scene.json");
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_THAT(result.err, HasSubstr("nothing can be written to"));
}

TEST_F(CliInputsTest, OneBadInputDoesntStopTheOthers) {
    put_bytes(folder / "wedge.obj", kTetrahedron);
    put_bytes(folder / "bad.json", "{");
    const ProgramResult result =
        run("render bad.json wedge.obj none.ply scene.json -o 'out.{name}.png' --size 16x12 "
            "--samples 1 --stats-json '{name}.stats'");
    EXPECT_EQ(result.exit_code, 1) << result.err;  // the two fail for different reasons
    EXPECT_THAT(names(), ElementsAre("bad.json", "out.scene.png", "out.wedge.png", "scene.json",
                                     "scene.stats", "wedge.obj", "wedge.stats"));
    EXPECT_THAT(result.err, AllOf(HasSubstr("1 of 4: bad.json\nvoxelume: bad.json:1:"),
                                  HasSubstr("\nvoxelume: none.ply: no such file\n"),
                                  HasSubstr("\n2 of 4 rendered in "),
                                  HasSubstr("; failed: bad.json, none.ply\n")));
    EXPECT_EQ(run("render none.ply other.stl scene.json -q -o '{name}.png'").exit_code, 4);
    EXPECT_THAT(names(), testing::Contains("scene.png"));
}

TEST_F(CliInputsTest, TwoInputsOfOneOutputAreRefusedBeforeAnythingIsRendered) {
    put_bytes(folder / "wedge.obj", kTetrahedron);
    put_bytes(folder / "scene.obj", kTetrahedron);
    EXPECT_THAT(expect_failure(2, "render scene.json wedge.obj -o a.png"),
                HasSubstr("a.png: this would be the output of both scene.json and wedge.obj; have "
                          "{name} in its name"));
    EXPECT_THAT(expect_failure(2, "render scene.json scene.obj -o {name}.png"),
                HasSubstr("inputs of one {name}"));
    EXPECT_THAT(expect_failure(2, "render scene.json ./scene.json -o ./x/../{name}.png"),
                HasSubstr("one {name}"));
    EXPECT_THAT(expect_failure(2, "render scene.json wedge.obj -o {name}.png --stats-json s.json"),
                HasSubstr("s.json"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o {nam}.png"),
                HasSubstr("did you mean \"name\"?"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o {name.png"), HasSubstr("a { without"));
}

TEST_F(CliInputsTest, TheFramesOfAnInputHaveItsName) {
    write_scene([&](Json& scene) {
        scene["animation"] = Json::parse(R"({"frames": 2, "tracks": [{"target": "objects[0].turn",
            "keys": [{"frame": 1, "value": [0, 0, 0]}, {"frame": 2, "value": [9, 9, 9]}]}]})");
    });
    ASSERT_EQ(run("render scene.json -q -o '{name}-{frame}.png'").exit_code, 0);
    EXPECT_THAT(names(), ElementsAre("scene-0001.png", "scene-0002.png", "scene.json"));
}

TEST_F(CliInputsTest, ASceneIsViewedAsItsVolumetricImage) {
    ASSERT_EQ(run("render scene.json -q --volume scene.nrrd").exit_code, 0);
    ASSERT_EQ(run("view scene.nrrd -o a.png").exit_code, 0);
    ASSERT_EQ(run("view scene.json -o b.png").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "a.png"), bytes_of(folder / "b.png"));
    put_bytes(folder / "other.json", "{}");
    EXPECT_THAT(expect_failure(4, "view other.json -o c.png"), HasSubstr("neither a scene"));
}

TEST_F(CliInputsTest, ViewsGoRoundASceneAndAModel) {
    put_bytes(folder / "wedge.obj", kTetrahedron);
    ASSERT_EQ(run("render scene.json wedge.obj -q --views 4 -o '{name}{view}.exr' --size 16x12 "
                  "--samples 1")
                  .exit_code,
              0);
    EXPECT_THAT(names(),
                ElementsAre("scene.json", "scene1.exr", "scene2.exr", "scene3.exr", "scene4.exr",
                            "wedge.obj", "wedge1.exr", "wedge2.exr", "wedge3.exr", "wedge4.exr"));
    ASSERT_EQ(run("render scene.json -q -o own.exr --size 16x12 --samples 1").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "own.exr"), bytes_of(folder / "scene1.exr"));
    EXPECT_NE(read_exr(folder / "scene1.exr").planes, read_exr(folder / "scene3.exr").planes);
    EXPECT_NE(read_exr(folder / "wedge1.exr").planes, read_exr(folder / "wedge2.exr").planes);
    EXPECT_THAT(expect_failure(2, "render scene.json --views 2 -o a.png"), HasSubstr("{view}"));
    EXPECT_THAT(expect_failure(2, "render scene.json --views 0 -o {view}.png"),
                HasSubstr("--views"));
}

}  // namespace
}  // namespace voxelume
