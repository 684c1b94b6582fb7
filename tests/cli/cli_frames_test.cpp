// SPDX-License-Identifier: Apache-2.0
// Frames of moving scenes on the command line.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "runtime/io/image/exr.hpp"
#include "tests/cli/scene_program.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Tests with the fixture's scene and an object that turns until frame 3.
class CliFramesTest : public SceneProgramTest {
  protected:
    /// With `blind`, the observer looks at itself in frame 2.
    void write_moving_scene(int frames, bool blind = false) {
        write_scene([&](Json& scene) {
            scene["animation"] = Json::parse(R"({"tracks": [
                {"target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                       {"frame": 3, "value": [90, 40, 0]}]}]})");
            scene["animation"]["frames"] = frames;
            if (!blind) return;
            scene["animation"]["tracks"].push_back({{"target", "observer.look_at"},
                                                    {"keys",
                                                     {{{"frame", 1}, {"value", {1.5, 1, 3}}},
                                                      {{"frame", 3}, {"value", {1.5, 1, 5}}}}}});
        });
    }
};

TEST_F(CliFramesTest, ANameWithAPlaceForTheNumberGetsAllFrames) {
    write_moving_scene(3);
    const ProgramResult result = run("render scene.json -o f.##.exr --stats-json stats.json");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(names(),
                ElementsAre("f.01.exr", "f.02.exr", "f.03.exr", "scene.json", "stats.json"));
    EXPECT_THAT(result.err,
                HasSubstr("frame 1: f.01.exr\nframe 2: f.02.exr\nframe 3: f.03.exr\n20x12"));
    EXPECT_NE(read_exr(folder / "f.01.exr").planes.at("Z"),
              read_exr(folder / "f.03.exr").planes.at("Z"));
    EXPECT_EQ(read_exr(folder / "f.02.exr").attributes.at("frame"), "2");
    const Json stats = Json::parse(bytes_of(folder / "stats.json"));
    EXPECT_EQ(stats["files"], 3);
    EXPECT_EQ(stats["sight_rays"], 3 * 240);
}

TEST_F(CliFramesTest, OneNameIsTheFirstFrame) {
    write_moving_scene(3);
    ASSERT_EQ(run("render scene.json -o one.exr").exit_code, 0);
    ASSERT_EQ(run("render scene.json --frames 1 -o f.#.exr").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "one.exr"), bytes_of(folder / "f.1.exr"));
}

TEST_F(CliFramesTest, ChosenFramesAreTheSameFramesAndMayLieOutside) {
    write_moving_scene(3);
    ASSERT_EQ(run("render scene.json -o all.#.exr").exit_code, 0);
    ASSERT_EQ(run("render scene.json --frames 3-5x2,2 -o some.#.exr --volume v.#.nrrd").exit_code,
              0);
    EXPECT_THAT(names(),
                ElementsAre("all.1.exr", "all.2.exr", "all.3.exr", "scene.json", "some.2.exr",
                            "some.3.exr", "some.5.exr", "v.2.nrrd", "v.3.nrrd", "v.5.nrrd"));
    EXPECT_EQ(bytes_of(folder / "all.2.exr"), bytes_of(folder / "some.2.exr"));
    EXPECT_NE(bytes_of(folder / "v.2.nrrd"), bytes_of(folder / "v.3.nrrd"));
    // After the last key nothing moves.
    EXPECT_EQ(read_exr(folder / "some.3.exr").planes, read_exr(folder / "some.5.exr").planes);
}

TEST_F(CliFramesTest, AnEmptyListIsAMistake) {
    write_moving_scene(3);
    for (const char* line :
         {"render scene.json --frames '' -o f.#.exr", "render scene.json --frames 1,, -o f.#.exr"})
        EXPECT_THAT(expect_failure(2, line),
                    HasSubstr("--frames: can't read \"\"; write a frame or a range, like 1-10"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o f.#.exr --frames="),
                HasSubstr("--frames: 1 required FRAMES missing"));
}

TEST_F(CliFramesTest, ANameWithoutAPlaceForTheNumberGetsItAlongsideOneThatHasIt) {
    write_moving_scene(2);
    ASSERT_EQ(run("render scene.json -o x.exr -o y.##.exr -q").exit_code, 0);
    EXPECT_THAT(names(),
                ElementsAre("scene.json", "x0001.exr", "x0002.exr", "y.01.exr", "y.02.exr"));
    EXPECT_EQ(bytes_of(folder / "x0002.exr"), bytes_of(folder / "y.02.exr"));
}

TEST_F(CliFramesTest, ADotIsBetweenAViewsNumberAndAFrames) {
    write_moving_scene(2);
    ASSERT_EQ(run("render scene.json -q --frames 1 --views 2 -o v-{view}.png --volume "
                  "s{view}##.png")
                  .exit_code,
              0);
    for (const char* file : {"v-1.0001.png", "v-2.0001.png", "s1.0001.08.png", "s2.0001.json"})
        EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
    EXPECT_EQ(names().size(), 1u + 2u + 2u * 10u);
}

TEST_F(CliFramesTest, SlicesKeepTheirOwnNumberBehindTheFrames) {
    write_moving_scene(2);
    ASSERT_EQ(run("render scene.json --volume s.##.png --frames 1-2").exit_code, 0);
    ASSERT_EQ(run("render scene.json --volume f#_s##.png --frames 1-2").exit_code, 0);
    std::vector<std::string> expected = {"scene.json"};
    for (const char* frame : {"s.0001", "s.0002", "f1_s", "f2_s"}) {
        expected.push_back(std::string(frame) + ".json");
        for (int slice = 0; slice < 9; ++slice)
            expected.push_back(
                fmt::format("{}{}{:02}.png", frame, frame[0] == 's' ? "." : "", slice));
    }
    EXPECT_THAT(names(), testing::UnorderedElementsAreArray(expected));
    EXPECT_THAT(expect_failure(2, "render scene.json --volume s.png --frames 1-2"),
                HasSubstr("s.png: a stack of slices needs their number in its name: s.####.png"));
}

TEST_F(CliFramesTest, AFrameThatIsWrongIsToldBeforeAnyIsRendered) {
    write_moving_scene(3, true);
    for (const char* line :
         {"check scene.json", "render scene.json --dry-run", "render scene.json -o f.#.exr",
          "render scene.json --frames 1-3 -o f.exr"})
        EXPECT_THAT(expect_failure(3, line),
                    AllOf(HasSubstr("observer.look_at: is the position itself"),
                          HasSubstr("(at frame 2)")));
    EXPECT_THAT(names(), ElementsAre("scene.json"));
    EXPECT_EQ(run("render scene.json --frames 1,3 -o f.#.exr").exit_code, 0);
}

TEST_F(CliFramesTest, APlacementThatIsWrongLaterIsToldWithItsFrame) {
    write_scene([&](Json& scene) {
        scene["objects"][0]["placement"] = "instance";
        scene["animation"] = Json::parse(R"({"frames": 9, "tracks": [
            {"target": "materials.brick.opacity", "interpolation": "step",
             "keys": [{"frame": 1, "value": 1}, {"frame": 7, "value": 0.5}]}]})");
    });
    for (const char* line : {"check scene.json", "render scene.json --frames 6-8 -o f.#.exr"})
        EXPECT_THAT(expect_failure(3, line), AllOf(HasSubstr("can't be placed as an instance"),
                                                   testing::EndsWith("(at frame 7)\n")));
    EXPECT_EQ(run("render scene.json --frames 6 -o f.exr").exit_code, 0);
}

TEST_F(CliFramesTest, ThePlanIsThatOfTheFrameThatTakesTheMost) {
    write_scene([&](Json& scene) {
        scene["animation"] = Json::parse(R"({"frames": 3, "tracks": [
            {"target": "models.thing.size", "keys": [{"frame": 1, "value": [0.2, 0.2, 0.2]},
                                                     {"frame": 2, "value": [1.2, 0.8, 0.4]},
                                                     {"frame": 3, "value": [0.2, 0.2, 0.2]}]}]})");
    });
    EXPECT_EQ(Json::parse(run("check scene.json --json").out)["frame"], 2);
    EXPECT_THAT(run("render scene.json --dry-run --frames 1,3").out, HasSubstr("by frame 1;"));
}

TEST_F(CliFramesTest, WhatNoFrameReachesNeedNotFit) {
    write_scene([](Json& scene) {
        scene["world"]["voxel_size"] = 0.02;
        scene["models"]["fine"] =
            Json::parse(R"({"shape": "sphere", "radius": 0.2, "voxel_size": 0.0005,
                            "surface": "cubes"})");
        scene["objects"].push_back({{"model", "fine"}, {"position", {0.3, 0.3, 0.5}}});
        scene["observer"]["display"]["angles"] = {4, 3};
        scene["render"]["shadows"] = false;
        scene["animation"] = Json::parse(R"({"frames": 2, "tracks": [
            {"target": "materials.brick.diffuse", "keys": [{"frame": 1, "value": 1},
                                                           {"frame": 2, "value": 0.5}]}]})");
    });
    const auto in_little_memory = [this](const char* line) {
        setenv("VOXELUME_MEMORY_MB", "20", 1);
        const ProgramResult result = run(line);
        unsetenv("VOXELUME_MEMORY_MB");
        return result;
    };
    for (const char* line :
         {"render scene.json --frames 1 -o f.#.exr", "render scene.json -o f.#.exr",
          "render scene.json --dry-run", "check scene.json"}) {
        const ProgramResult result = in_little_memory(line);
        EXPECT_EQ(result.exit_code, 0) << line << "\n" << result.err;
    }
    write_scene([](Json& scene) { scene["models"]["thing"]["voxel_size"] = 0.0005; });
    EXPECT_EQ(in_little_memory("check scene.json").exit_code, 8);
}

TEST_F(CliFramesTest, WhatCantBeKeptForTheNextFrameIsToldWithAndWithoutOverlap) {
    write_scene([](Json& scene) {
        scene["world"]["voxel_size"] = 0.007;  // planned: 0.7 MB at once, 1.2 MB kept
        scene["animation"] = Json::parse(R"({"frames": 2, "tracks": [
            {"target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                   {"frame": 2, "value": [90, 40, 0]}]}]})");
    });
    for (const char* option : {"", "--no-overlap"}) {
        SCOPED_TRACE(option);
        const std::string line =
            fmt::format("render scene.json -o f.#.exr -v --stats-json stats.json {}", option);
        EXPECT_THAT(run(line).err, Not(HasSubstr("keep nothing")));
        EXPECT_FALSE(Json::parse(bytes_of(folder / "stats.json")).contains("nothing_kept_from"));
        setenv("VOXELUME_MEMORY_MB", "1", 1);
        const ProgramResult crowded = run(line);
        unsetenv("VOXELUME_MEMORY_MB");
        EXPECT_THAT(crowded.err,
                    HasSubstr("1 of 2 frames keep nothing for the next, frame 1 the first: mem"));
        EXPECT_EQ(Json::parse(bytes_of(folder / "stats.json"))["nothing_kept_from"], 1);
    }
}

TEST_F(CliFramesTest, OfSeveralDevicesOnlyFramesThatTheirOwnNextFollowsKeepNothing) {
    if (test_device().info().compute_units < 2) GTEST_SKIP() << "a device that can't be cut";
    write_scene([](Json& scene) {
        scene["world"]["voxel_size"] = 0.007;
        scene["animation"] = Json::parse(R"({"frames": 6, "tracks": [
            {"target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                   {"frame": 6, "value": [90, 40, 0]}]}]})");
    });
    for (const char* frames : {"1-2", "1-6"}) {
        setenv("VOXELUME_MEMORY_MB", "1", 1);  // for each half
        const ProgramResult result =
            run(fmt::format("render scene.json -o f.#.exr -v --stats-json stats.json --device "
                            "all/2 --frames {}",
                            frames));
        unsetenv("VOXELUME_MEMORY_MB");
        ASSERT_EQ(result.exit_code, 0) << result.err;
        const Json stats = Json::parse(bytes_of(folder / "stats.json"));
        std::vector<int> crowded;
        for (size_t i = 0; i < stats["frames"].size(); ++i)
            for (size_t j = i + 1; j < stats["frames"].size(); ++j)
                if (stats["frames"][i]["device"] == stats["frames"][j]["device"]) {
                    crowded.push_back(stats["frames"][i]["frame"]);
                    break;
                }
        EXPECT_EQ(stats.contains("nothing_kept_from"), !crowded.empty());
        const size_t told = result.err.find("keep nothing");
        EXPECT_EQ(told != std::string::npos, !crowded.empty()) << result.err;
        if (crowded.empty()) continue;
        EXPECT_EQ(stats["nothing_kept_from"], crowded[0]);
        EXPECT_THAT(result.err,
                    HasSubstr(fmt::format("{} of {} frames keep nothing for the next, frame {} the",
                                          crowded.size(), stats["frames"].size(), crowded[0])));
        EXPECT_EQ(result.err.find("keep nothing", told + 1), std::string::npos);
    }
}

}  // namespace voxelume
