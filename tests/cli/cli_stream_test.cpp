// SPDX-License-Identifier: Apache-2.0
// Scenes from standard input, images to standard output, parts of images, and progress.
#include <gmock/gmock.h>

#include <filesystem>
#include <sstream>

#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class CliStreamTest : public SceneProgramTest {
  protected:
    /// Runs a pipe of a shell.
    ProgramResult pipe(const std::string& line) const { return run_line("sh -c '" + line + "'"); }
};

/// Expects that `part` is what `whole` has from a column and row on.
void expect_part(const Image& part, const Image& whole, int x, int y) {
    ASSERT_EQ(part.planes.size(), whole.planes.size());
    for (const auto& [name, plane] : part.planes) {
        const Plane<float>& from = whole.planes.at(name);
        for (int row = 0; row < part.height; ++row)
            for (int column = 0; column < part.width; ++column)
                ASSERT_EQ(plane[size_t(row * part.width + column)],
                          from[size_t((row + y) * whole.width + column + x)])
                    << name << " " << column << "," << row;
    }
}

TEST_F(CliStreamTest, ASceneIsReadFromStandardInputAndAnImageWrittenToStandardOutput) {
    ASSERT_EQ(run("render scene.json -q -o a.png -o a.exr").exit_code, 0);
    const ProgramResult png = pipe("cat scene.json | voxelume render - -o -");
    EXPECT_EQ(png.exit_code, 0) << png.err;
    put_bytes(folder / "out.png", png.out);
    EXPECT_EQ(read_png(folder / "out.png").pixels, read_png(folder / "a.png").pixels);
    EXPECT_THAT(png.err, HasSubstr("20x12 in "));
    const ProgramResult exr = pipe("voxelume render - -o -.exr -o b.exr -q <scene.json");
    EXPECT_EQ(exr.exit_code, 0) << exr.err;
    put_bytes(folder / "out.exr", exr.out);
    EXPECT_EQ(read_exr(folder / "out.exr").planes, read_exr(folder / "a.exr").planes);
    EXPECT_EQ(read_exr(folder / "b.exr").planes, read_exr(folder / "a.exr").planes);
    EXPECT_EQ(pipe("voxelume check - <scene.json").exit_code, 0);
}

TEST_F(CliStreamTest, VoxelizeReadsASceneToo) {
    ASSERT_EQ(pipe("voxelume voxelize - --resolution 8 -o a.vox <scene.json").exit_code, 0);
    ASSERT_EQ(pipe("voxelume voxelize scene.json --resolution 8 -o b.vox").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "a.vox"), bytes_of(folder / "b.vox"));
}

TEST_F(CliStreamTest, StreamsThatAreClosedAreNoFilesOfTheProgram) {
    const ProgramResult in = pipe("timeout 60 voxelume render - -o a.png <&-");
    EXPECT_EQ(in.exit_code, 4) << in.err;  // it waited for what it wrote itself
    const ProgramResult out = pipe("voxelume check scene.json >&-");
    EXPECT_EQ(out.exit_code, 5) << out.err;
    EXPECT_EQ(pipe("voxelume render scene.json -o b.png >&- 2>&-").exit_code, 0);
    EXPECT_EQ(read_png(folder / "b.png").width, 20);
}

TEST_F(CliStreamTest, ARunDoesNotEndForWantOfAPlaceForItsMessages) {
    EXPECT_EQ(pipe("voxelume render scene.json -v -o a.png 2>/dev/full").exit_code, 0);
    EXPECT_EQ(pipe("voxelume render nothing.json -o b.png 2>/dev/full").exit_code, 4);
    EXPECT_EQ(read_png(folder / "a.png").width, 20);
    const ProgramResult full = pipe("voxelume man >/dev/full");  // more than fits a buffer
    EXPECT_EQ(full.exit_code, 5);
    EXPECT_THAT(full.err, HasSubstr("can't write to standard output: No space left on device"));
}

TEST_F(CliStreamTest, MistakesInStandardInputHaveTheirLine) {
    const ProgramResult result = pipe("echo \"{\" | voxelume render - -o a.png");
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, HasSubstr("voxelume: stdin:2:1: this is not JSON"));
    ASSERT_EQ(pipe("voxelume render - -q --views 2 -o {name}{view}.png <scene.json").exit_code, 0);
    EXPECT_THAT(names(), AllOf(Contains("stdin1.png"), Contains("stdin2.png")));
}

TEST_F(CliStreamTest, StandardOutputTakesOneImageAlone) {
    for (const char* line : {"render scene.json -o - -o -.exr", "render scene.json -o - --dry-run",
                             "render scene.json -o - --views 2"})
        EXPECT_THAT(expect_failure(2, line), HasSubstr("standard output")) << line;
    EXPECT_EQ(run_line("sh -c 'voxelume render scene.json -q -o - >/dev/full'").exit_code, 5);
}

TEST_F(CliStreamTest, OptionsThatChangeNoFileAreRefused) {
    for (const char* of_png : {"--exposure 1", "--view-transform agx", "--png-bits 16"}) {
        EXPECT_THAT(expect_failure(2, fmt::format("render scene.json -o a.exr {}", of_png)),
                    HasSubstr("changes .png files, and -o names none"))
            << of_png;
        EXPECT_EQ(run(fmt::format("render scene.json -q -o a.exr -o b.PNG {}", of_png)).exit_code,
                  0)
            << of_png;
    }
    for (const char* of_exr : {"--float", "--multi-part", "--channels RGBA,Z"}) {
        EXPECT_THAT(expect_failure(2, fmt::format("render scene.json -o - {}", of_exr)),
                    HasSubstr("changes .exr files, and -o names none"))
            << of_exr;
        EXPECT_EQ(run(fmt::format("render scene.json -q -o -.exr {}", of_exr)).exit_code, 0)
            << of_exr;
        EXPECT_EQ(run(fmt::format("render scene.json -q --volume v.nrrd {}", of_exr)).exit_code, 2)
            << of_exr;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST_F(CliStreamTest, ACroppedImageHasTheBitsOfTheWholeOne) {
    const std::string size = " -q --size 37x23 --samples 3 --float ";
    ASSERT_EQ(run("render scene.json -o whole.exr -o whole.png" + size).exit_code, 0);
    ASSERT_EQ(run("render scene.json -o part.exr -o part.png --crop 6,3,22,14" + size).exit_code,
              0);
    ASSERT_EQ(run("render scene.json -o two.exr --crop 6,3,22,14 --device all/2" + size).exit_code,
              0);
    const Image whole = read_exr(folder / "whole.exr"), part = read_exr(folder / "part.exr");
    EXPECT_EQ(part.width, 22);
    EXPECT_EQ(part.height, 14);
    expect_part(part, whole, 6, 3);
    EXPECT_EQ(bytes_of(folder / "two.exr"), bytes_of(folder / "part.exr"));
    const Picture all = read_png(folder / "whole.png"), some = read_png(folder / "part.png");
    ASSERT_EQ(some.width, 22);
    for (int row = 0; row < 14; ++row)
        for (int column = 0; column < 22; ++column)
            ASSERT_EQ(some.pixels[size_t(row * 22 + column)],
                      all.pixels[size_t((row + 3) * 37 + column + 6)]);
}

TEST_F(CliStreamTest, SoHasOneOfGlobalLight) {
    const std::string size = " -q --size 37x23 --samples 5 --float --light global ";
    ASSERT_EQ(run("render scene.json -o whole.exr" + size).exit_code, 0);
    ASSERT_EQ(run("render scene.json -o part.exr --crop 6,3,22,14" + size).exit_code, 0);
    expect_part(read_exr(folder / "part.exr"), read_exr(folder / "whole.exr"), 6, 3);
}

TEST_F(CliStreamTest, FramesAreCroppedAlike) {
    write_scene([&](Json& scene) {
        scene["animation"] = Json::parse(R"({"frames": 2, "tracks": [
            {"target": "lights.sun.intensity", "keys": [{"frame": 1, "value": 1},
                                                        {"frame": 2, "value": 2}]},
            {"target": "observer.position", "keys": [{"frame": 1, "value": [1.5, 1, 4]},
                                                     {"frame": 2, "value": [1.6, 1.1, 4]}]}]})");
    });
    ASSERT_EQ(run("render scene.json -q -o whole.#.exr").exit_code, 0);
    ASSERT_EQ(run("render scene.json -q -o part.#.exr --crop 0,5,20,7").exit_code, 0);
    for (const char* frame : {"1", "2"})
        expect_part(read_exr(folder / fmt::format("part.{}.exr", frame)),
                    read_exr(folder / fmt::format("whole.{}.exr", frame)), 0, 5);
}

TEST_F(CliStreamTest, ACropOutsideOfTheImageIsAMistake) {
    for (const char* crop : {"0,0,21,12", "-1,0,4,4", "20,0,1,1", "0,0,0,4", "1,2,3", "1,2,3,4,5",
                             "a,b,c,d", "0,12,1,1"})
        EXPECT_THAT(expect_failure(2, fmt::format("render scene.json -o a.png --crop={}", crop)),
                    HasSubstr(fmt::format("--crop {}: ", crop)));
}

TEST_F(CliStreamTest, ProgressIsJsonForPrograms) {
    write_scene([](Json& scene) {
        scene["animation"] = Json::parse(R"({"frames": 3, "tracks": [{"target": "objects[0].turn",
            "keys": [{"frame": 1, "value": [0, 0, 0]}, {"frame": 3, "value": [9, 9, 9]}]}]})");
    });
    const ProgramResult result = run("render scene.json -q -o f.#.png --progress json");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::istringstream lines(result.err);
    std::vector<std::string> written;
    double done = 0;
    for (std::string line; std::getline(lines, line);) {
        const Json event = Json::parse(line);
        if (event["event"] == "written") written.push_back(event["file"]);
        if (event["event"] != "progress") continue;
        EXPECT_GE(event["done"], done);
        done = event["done"];
        EXPECT_TRUE(event.contains("seconds_left") && event.contains("compile_seconds"));
    }
    EXPECT_EQ(done, 1);
    EXPECT_THAT(written, testing::ElementsAre("f.1.png", "f.2.png", "f.3.png"));
}

TEST_F(CliStreamTest, ProgressIsToldAsItIsAskedFor) {
    EXPECT_THAT(run("render scene.json -o a.png --progress plain").err, HasSubstr("rendering: "));
    EXPECT_THAT(run("render scene.json -o a.png --progress bar").err, HasSubstr("\r"));
    EXPECT_THAT(run("render scene.json -o a.png --progress bar -q").err, HasSubstr("\r"));
    EXPECT_THAT(run("render scene.json -o a.png").err, Not(HasSubstr("\r")));
    EXPECT_THAT(run("render scene.json -o a.png -q").err, IsEmpty());
    EXPECT_THAT(expect_failure(2, "render scene.json -o b.png --progress jsno"),
                HasSubstr("did you mean \"json\"?"));
}

}  // namespace
}  // namespace voxelume
