// SPDX-License-Identifier: Apache-2.0
// Quilts on the command line.
#include <cmath>

#include "runtime/io/image/exr.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {

using testing::HasSubstr;

class CliQuiltTest : public SceneProgramTest {
  protected:
    /// Writes a scene of two frames.
    void write_turning_scene() {
        write_scene([](Json& scene) {
            scene["animation"] = Json::parse(R"({"frames": 2, "tracks": [
                {"target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                       {"frame": 2, "value": [90, 40, 0]}]}]})");
        });
    }
};

TEST_F(CliQuiltTest, ViewsLieFromTheBottomLeftToTheTopRight) {
    const ProgramResult result =
        run("render scene.json -o q.exr -o q.png --quilt 2x2 --cone 50 --channels RGBA,objectId");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("quilt of 4 views of 20x12"));
    EXPECT_TRUE(std::filesystem::exists(folder / "q_qs2x2a1.667.png"));
    const Image quilt = read_exr(folder / "q_qs2x2a1.667.exr");
    ASSERT_EQ(quilt.width, 40);
    ASSERT_EQ(quilt.height, 24);
    // The leftmost observer sees the left side of the box: its middle stays in the screen, and its
    // back, behind the screen, goes to the right as the observer does.
    const auto sum_of_columns = [&](int column, int row) {
        double sum = 0, count = 0;
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 20; ++x)
                if (quilt.id_planes.at("objectId")[size_t((row + y) * 40 + column + x)] == 1)
                    sum += x, ++count;
        return sum / count;
    };
    ASSERT_EQ(run("render scene.json -o one.exr --quilt 1x1 --channels RGBA,objectId").exit_code,
              0);
    ASSERT_EQ(run("render scene.json -o alone.exr --channels RGBA,objectId").exit_code, 0);
    EXPECT_EQ(read_exr(folder / "one_qs1x1a1.667.exr").planes,
              read_exr(folder / "alone.exr").planes);
    const std::vector<double> middles = {sum_of_columns(0, 12), sum_of_columns(20, 12),
                                         sum_of_columns(0, 0), sum_of_columns(20, 0)};
    for (const double middle : middles) EXPECT_NEAR(middle, 9.5, 1.5);
    const auto tile = [&](int column, int row) {
        std::vector<float> values;
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 20; ++x)
                values.push_back(quilt.planes.at("G")[size_t((row + y) * 40 + column + x)]);
        return values;
    };
    EXPECT_NE(tile(0, 12), tile(20, 12));
    EXPECT_NE(tile(0, 12), tile(20, 0));
}

TEST_F(CliQuiltTest, EyesLieNextToOneAnotherOrInFilesOfTheirOwn) {
    const ProgramResult result =
        run("render scene.json -o pair.exr -o {eye}.exr -o {eye}/{eye}.png --stereo 1.5 "
            "--channels RGBA,objectId");
    EXPECT_EQ(result.exit_code, 5) << "there is no folder left";
    std::filesystem::create_directory(folder / "left");
    std::filesystem::create_directory(folder / "right");
    const ProgramResult done =
        run("render scene.json -o pair.exr -o {eye}.exr -o {eye}/{eye}.png --stereo 1.5 "
            "--channels RGBA,objectId");
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.err, HasSubstr("stereo pair of 2 views of 20x12"));
    EXPECT_TRUE(std::filesystem::exists(folder / "right/right.png"));
    const Image pair = read_exr(folder / "pair.exr");
    ASSERT_EQ(pair.width, 40);
    ASSERT_EQ(pair.height, 12);
    const Image eyes[] = {read_exr(folder / "left.exr"), read_exr(folder / "right.exr")};
    EXPECT_NE(eyes[0].planes, eyes[1].planes);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 40; ++x)
            EXPECT_EQ(pair.planes.at("G")[size_t(40 * y + x)],
                      eyes[x / 20].planes.at("G")[size_t(20 * y + x % 20)]);
}

TEST_F(CliQuiltTest, EyesOfSeveralFramesAndScenesHaveFilesOfTheirOwn) {
    std::filesystem::copy_file(folder / "scene.json", folder / "other.json");
    ASSERT_EQ(run("render scene.json other.json -o {name}_{eye}.####.png --stereo 1 --frames 1-2 "
                  "--size 8x6")
                  .exit_code,
              0);
    for (const char* name : {"scene", "other"})
        for (const char* eye : {"left", "right"})
            for (int frame = 1; frame <= 2; ++frame)
                EXPECT_TRUE(std::filesystem::exists(
                    folder / fmt::format("{}_{}.{:04}.png", name, eye, frame)));
}

TEST_F(CliQuiltTest, ViewsTakeAsManySamplesAsTheyNeed) {
    write_scene(lit_by_disk);
    const std::string options = "--light global --noise 0.01 --samples 64 --channels RGBA,samples";
    ASSERT_EQ(run("render scene.json -o q.exr --quilt 1x1 " + options).exit_code, 0);
    ASSERT_EQ(run("render scene.json -o alone.exr " + options).exit_code, 0);
    const Image quilt = read_exr(folder / "q_qs1x1a1.667.exr");
    EXPECT_EQ(quilt.planes, read_exr(folder / "alone.exr").planes);
    const auto& samples = quilt.planes.at("samples");
    EXPECT_LT(std::ranges::min(samples), std::ranges::max(samples));
    ASSERT_EQ(run("render scene.json -o {eye}.exr --stereo 0.1 " + options).exit_code, 0);
    EXPECT_EQ(std::ranges::max(read_exr(folder / "left.exr").planes.at("samples")), 64);
    const auto noise_of = [&](const char* file) {
        return std::stod(read_exr(folder / file).attributes.at("noise"));
    };
    EXPECT_EQ(noise_of("q_qs1x1a1.667.exr"), noise_of("alone.exr"));
    ASSERT_EQ(run("render scene.json -o both.exr --stereo 0.1 " + options).exit_code, 0);
    EXPECT_NEAR(noise_of("both.exr"),
                std::hypot(noise_of("left.exr"), noise_of("right.exr")) / std::sqrt(2.0), 1e-5);
    ASSERT_EQ(run("render scene.json -o t.exr --quilt 2x1 --light global --time 1 --samples 32")
                  .exit_code,
              0);
    EXPECT_EQ(read_exr(folder / "t_qs2x1a1.667.exr").attributes.at("time target"), "0.5")
        << "of each view";
}

TEST_F(CliQuiltTest, FinishedFramesStay) {
    write_turning_scene();
    const std::string line = "render scene.json -o q.#.png --quilt 2x1 --frames 1-2 ";
    ASSERT_EQ(run(line).exit_code, 0);
    const auto name = [&](int frame) {
        return folder / fmt::format("q.{}_qs2x1a1.667.png", frame);
    };
    const std::string first = bytes_of(name(1)), second = bytes_of(name(2));
    std::filesystem::remove(name(1));
    const ProgramResult resumed = run(line + "--resume");
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr("1 of 2 frames are there already"));
    EXPECT_EQ(bytes_of(name(1)), first);
    const ProgramResult nothing = run(line + "--resume -v --stats-json s.json");
    EXPECT_EQ(nothing.exit_code, 0);
    EXPECT_THAT(nothing.err, HasSubstr("2 of 2 frames are there already"));
    EXPECT_EQ(Json::parse(bytes_of(folder / "s.json"))["files"], 0);
    // Another cone makes other pictures, and a damaged file isn't one.
    EXPECT_THAT(run(line + "--resume --cone 20").err,
                HasSubstr("2 files are of another scene, file, option or version"));
    EXPECT_NE(bytes_of(name(2)), second);
    put_bytes(name(1), "damaged");
    EXPECT_THAT(run(line + "--overwrite never").err, HasSubstr("2 of 2 frames"));
    EXPECT_THAT(run(line + "--cone 20 --resume").err, HasSubstr("1 file is damaged"));
}

TEST_F(CliQuiltTest, FinishedEyesStay) {
    const std::string line = "render scene.json -o {eye}.exr -o pair.exr --stereo 0.1 ";
    ASSERT_EQ(run(line).exit_code, 0);
    const std::string right = bytes_of(folder / "right.exr");
    put_bytes(folder / "right.exr", bytes_of(folder / "left.exr"));
    const ProgramResult resumed = run(line + "--resume");
    EXPECT_THAT(resumed.err, HasSubstr("1 file is of another scene, file, option or version"));
    EXPECT_EQ(bytes_of(folder / "right.exr"), right);
    EXPECT_THAT(run(line + "--resume").err, HasSubstr("1 of 1 frames are there already"));
}

TEST_F(CliQuiltTest, ItsNameHasTheProportionsOfItsViews) {
    ASSERT_EQ(run("render scene.json -o q.png --quilt 2x1 --set render.pixel_aspect=2").exit_code,
              0);
    EXPECT_TRUE(std::filesystem::exists(folder / "q_qs2x1a3.333.png"));
}

TEST_F(CliQuiltTest, ItsStatisticsAreSumsOfItsViews) {
    const std::string options = " --samples 2 --stats-json s.json";
    ASSERT_EQ(run("render scene.json -o one.png" + options).exit_code, 0);
    const Json one = Json::parse(bytes_of(folder / "s.json"));
    write_turning_scene();
    const ProgramResult quilts = run("render scene.json -o q.#.png --quilt 3x1" + options);
    ASSERT_EQ(quilts.exit_code, 0) << quilts.err;
    const Json both = Json::parse(bytes_of(folder / "s.json"));
    EXPECT_EQ(both["files"], 2);
    EXPECT_EQ(both["sight_rays"], 6 * one["sight_rays"].get<int>());
    EXPECT_EQ(both["voxels"], one["voxels"]);
    ASSERT_EQ(both["frames"].size(), 6u);
    EXPECT_EQ(both["frames"][2]["frame"], 1);
    EXPECT_EQ(both["frames"][3]["frame"], 2);
    EXPECT_EQ(both["launches"]["resolve_pixels"], 6 * one["launches"]["resolve_pixels"].get<int>());
    const Json& seconds = both["seconds"];
    EXPECT_GT(seconds["open"].get<double>(), 0.001) << "opening the device belongs to it";
    EXPECT_GT(seconds["total"].get<double>(),
              seconds["open"].get<double>() + seconds["image"].get<double>());
    ASSERT_EQ(run("render scene.json -o e_{eye}.png --stereo 0.1" + options).exit_code, 0);
    EXPECT_EQ(Json::parse(bytes_of(folder / "s.json"))["files"], 2);
}

TEST_F(CliQuiltTest, WhatItTakesIsToldAndKeptToTheLimit) {
    const std::string line = "render scene.json -o q.png --size 1024x1024 --dry-run ";
    const auto process_mb = [&](const std::string& option) {
        const ProgramResult result = run(line + option);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        const size_t at = result.out.find("whole process");
        const std::string text = result.out.substr(at + 13, 20);
        return std::stod(text) * (text.find("GB") < text.find("MB") ? 1e3 : 1);
    };
    const ProgramResult told = run(line + "--quilt 8x8");
    EXPECT_THAT(told.out, testing::ContainsRegex("views +1.1 GB"));
    // Each pixel takes four numbers of four bytes.
    EXPECT_NEAR(process_mb("--quilt 8x8") - process_mb(""), 64 * 16 * 1.048576, 60);
    EXPECT_THAT(expect_failure(8, line + "--quilt 8x8 --memory-limit 1GB"),
                HasSubstr("64 views of 1024x1024 pixels take 1.1 GB of main memory"));
    EXPECT_THAT(
        expect_failure(
            8, "render scene.json -o q.png --size 1024x1024 --quilt 8x8 --memory-limit 1GB"),
        HasSubstr("ask for smaller views"));
    EXPECT_FALSE(std::filesystem::exists(folder / "q_qs8x8a1.png"));
    EXPECT_THAT(run(line + "--quilt 8x8 --memory-limit 1.4GB").err,
                HasSubstr("may take 326 MB beside the 1.1 GB of a quilt's views"));
    EXPECT_THAT(expect_failure(2, line + "--quilt 0x2"), HasSubstr("COLUMNSxROWS"));
    write_scene([](Json& scene) {
        scene["observer"]["display"] = {{"shape", "box"}, {"size", {3, 2, 1}}, {"near", 1}};
        scene["observer"]["display"]["voxels"] = {16, 12, 9};
    });
    const std::string refusal = "an observer whose display is a pyramid";
    EXPECT_THAT(expect_failure(2, line + "--quilt 2x2"), HasSubstr(refusal));
    EXPECT_THAT(expect_failure(2, "render scene.json -o q.png --quilt 2x2"), HasSubstr(refusal));
}

TEST_F(CliQuiltTest, WhatAQuiltCantHaveIsRefused) {
    for (const char* option : {"--crop 0,0,4,4", "--shard 1/2", "--volume v.vdb"})
        EXPECT_THAT(
            expect_failure(2, fmt::format("render scene.json -o q.png --quilt 2x2 {}", option)),
            HasSubstr("can't be had of a quilt"));
    for (const char* views : {"0x2", "2", "2x", "99x99", "x2", "2x2x2"})
        EXPECT_THAT(expect_failure(2, fmt::format("render scene.json -o q.png --quilt {}", views)),
                    HasSubstr("COLUMNSxROWS"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o - --quilt 2x2"),
                HasSubstr("goes to a file with a name"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o q.png --quilt 2x2 --stereo 0.06"),
                HasSubstr("--stereo"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o q.png --stereo 0.06 --crop 0,0,4,4"),
                HasSubstr("can't be had of stereo pairs"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o a{eye}.png -o aleft.png --stereo 0.06"),
                HasSubstr("aleft.png"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.png --cone 20"), HasSubstr("--quilt"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.png --stereo 0.06 --cone 20"),
                HasSubstr("--cone"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.png --focus 2"),
                HasSubstr("add --quilt or --stereo"));
    EXPECT_THAT(expect_failure(2, "render scene.json --volume v.vdb --continue a.exr"),
                HasSubstr("name one by -o"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o {eye}.png"),
                HasSubstr("no placeholder \"eye\""));
}

}  // namespace voxelume
