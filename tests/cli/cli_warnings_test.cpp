// SPDX-License-Identifier: Apache-2.0
// Warnings of the commands: a line each on stderr, a list in the statistics, errors if asked for.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/scene_program.hpp"
#include "tests/support/setting.hpp"

namespace voxelume {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

class CliWarningsTest : public SceneProgramTest {
  protected:
    void SetUp() override {
        SceneProgramTest::SetUp();
        move_object_away();
    }
    void move_object_away() {
        write_scene([](Json& scene) { scene["objects"][0]["position"] = {1.5, 9, 0.5}; });
    }
    /// The kinds of warnings in the statistics of a run.
    std::vector<std::string> kinds(const std::string& options) const {
        const ProgramResult result = run("render scene.json --stats-json stats.json " + options);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        const Json statistics = Json::parse(bytes_of(folder / "stats.json"));
        std::vector<std::string> found;
        for (const Json& warning : statistics["warnings"]) found.push_back(warning["kind"]);
        return found;
    }
};

TEST_F(CliWarningsTest, AreALineEachOnStderrAndNoneWithQuiet) {
    const ProgramResult loud = run("render scene.json -o a.png");
    EXPECT_EQ(loud.exit_code, 0);
    EXPECT_THAT(loud.err, StartsWith("warning: scene.json:"));
    EXPECT_THAT(loud.err, HasSubstr(": objects[0]: \"thing\" lies outside the world, from "));
    EXPECT_THAT(loud.err, ContainsRegex("\n20x12 in "));
    EXPECT_THAT(run("render scene.json -o a.png -q").err, IsEmpty());
    EXPECT_THAT(run("check scene.json").err, MatchesRegex("warning: [^\n]+\n"));
    EXPECT_THAT(run("check scene.json -q").err, IsEmpty());
    EXPECT_THAT(run("render scene.json --dry-run").err, MatchesRegex("warning: [^\n]+\n"));
}

TEST_F(CliWarningsTest, StandInTheStatisticsAlsoWithQuiet) {
    ASSERT_EQ(run("render scene.json -o a.png -q --stats-json s.json").exit_code, 0);
    const Json warnings = Json::parse(bytes_of(folder / "s.json"))["warnings"];
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0]["kind"], "outside_world");
    EXPECT_THAT(std::string(warnings[0]["where"]), MatchesRegex("scene.json:[0-9:]+ objects.0."));
    EXPECT_THAT(std::string(warnings[0]["text"]), HasSubstr("move the object"));
    const Json plan = Json::parse(run("check scene.json --json -q").out);
    EXPECT_EQ(plan["warnings"], warnings);
}

TEST_F(CliWarningsTest, AreErrorsWithStrictBeforeAnythingIsWritten) {
    EXPECT_THAT(expect_failure(3, "render scene.json -o a.png --strict"),
                HasSubstr("\"thing\" lies outside the world"));
    EXPECT_THAT(expect_failure(3, "render scene.json -o a.png --strict -q"),
                HasSubstr("\"thing\" lies outside the world"));
    EXPECT_THAT(expect_failure(3, "check scene.json --strict"),
                HasSubstr("\"thing\" lies outside the world"));
    write_scene([](Json&) {});
    EXPECT_EQ(run("render scene.json -o a.png --strict").exit_code, 0);
    EXPECT_EQ(run("check scene.json --strict").exit_code, 0);
}

TEST_F(CliWarningsTest, AreAllSaidWithStrictAndTheErrorCountsThem) {
    write_scene([](Json& scene) {
        scene["objects"][0]["position"] = {1.5, 9, 0.5};
        scene["objects"].push_back({{"model", "thing"}, {"position", {1.5, -9, 0.5}}});
    });
    const ProgramResult result = run("check scene.json --strict");
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.err, MatchesRegex("warning: [^\n]+objects.1.[^\n]+\n"
                                         "voxelume: [^\n]+objects.0.[^\n]+the first of 2 "
                                         "warnings.\n"));
    EXPECT_EQ(run("render scene.json -o a.png --strict").err, result.err);
}

TEST_F(CliWarningsTest, SayThatNothingIsInViewAndWhereToLook) {
    write_scene([](Json& scene) { scene["observer"]["look_at"] = {1.5, 1, 9}; });
    const ProgramResult result = run("render scene.json -o a.png");
    EXPECT_THAT(result.err,
                AllOf(StartsWith("warning: scene.json:"),
                      HasSubstr("no sight ray meets an object: the objects lie around "
                                "[1.5, 1, 0.5]: make that the observer's \"look_at\"")));
    const ProgramResult strict = run("render scene.json -o b.png --strict");
    EXPECT_EQ(strict.exit_code, 3);
    EXPECT_THAT(strict.err, MatchesRegex("voxelume: [^\n]+no sight ray meets an object[^\n]+\n"));
    EXPECT_TRUE(std::filesystem::exists(folder / "b.png"));  // it shows what is wrong
}

TEST_F(CliWarningsTest, SayThatObjectsInViewAreSmallerThanAPixel) {
    write_scene([](Json& scene) {
        scene["models"]["thing"] = {{"shape", "sphere"}, {"radius", 0.0005}};
        scene["observer"]["look_at"] = scene["objects"][0]["position"];
    });
    EXPECT_THAT(run("render scene.json -o a.png").err,
                HasSubstr("no sight ray meets an object: the objects around [1.5, 1, 0.5] are "
                          "smaller than a pixel: move the observer closer"));
    write_scene([](Json& scene) {
        scene["models"]["thing"] = {{"shape", "sphere"}, {"radius", 0.0005}};
        scene["observer"]["look_at"] = {1.5, 1, 9};
    });
    EXPECT_THAT(run("render scene.json -o a.png").err, HasSubstr("make that the observer's"));
    // A sector of more than half of a circle sees what is behind.
    for (const int angle : {350, 170}) {
        write_scene([&](Json& scene) {
            scene["models"]["thing"] = {{"shape", "sphere"}, {"radius", 0.0005}};
            scene["observer"]["look_at"] = {1.5, 1.6, 9};
            scene["observer"]["display"] = {{"shape", "sector"}, {"angle", angle}};
        });
        EXPECT_THAT(run("render scene.json -o a.png").err,
                    HasSubstr(angle > 180 ? "smaller than a pixel" : "make that the observer's"));
    }
}

TEST_F(CliWarningsTest, SayThatTheDisplayEndsBeforeTheObjects) {
    write_scene([](Json& scene) { scene["observer"]["display"]["far"] = 0.5; });
    EXPECT_THAT(run("render scene.json -o a.png").err,
                HasSubstr("the display ends at 0.5 m, and the nearest object may be at "));
    write_scene([](Json& scene) {
        scene["observer"]["display"]["near"] = 7;
        scene["observer"]["display"]["far"] = 8;
    });
    EXPECT_THAT(run("render scene.json -o a.png").err, HasSubstr("change \"near\""));
}

TEST_F(CliWarningsTest, SayThatNothingIsInViewOnlyIfNoFrameShowsAnything) {
    write_scene([](Json& scene) {
        scene["animation"] = Json::parse(R"({"frames": 3, "tracks": [{"target": "observer.look_at",
            "keys": [{"frame": 1, "value": [1.5, 1, 9]}, {"frame": 3, "value": [1.5, 1, 0]}],
            "interpolation": "step"}]})");
    });
    EXPECT_THAT(kinds("-o a.#.png --frames 1-2"), testing::ElementsAre("nothing_in_view"));
    EXPECT_THAT(kinds("-o a.#.png"), IsEmpty());
}

TEST_F(CliWarningsTest, SayTheSameOfAVolume) {
    write_scene([](Json& scene) { scene["observer"]["look_at"] = {1.5, 1, 9}; });
    EXPECT_THAT(kinds("--volume v.nrrd"), testing::ElementsAre("nothing_in_view"));
    write_scene([](Json&) {});
    EXPECT_THAT(kinds("--volume v.nrrd"), IsEmpty());
}

TEST_F(CliWarningsTest, SayThatNoLightReachesWhatIsInView) {
    const auto shade = [](Json& scene) {
        scene["world"]["ambient"] = {0, 0, 0};
        scene["lights"][0]["direction"] = {0, 0, 1};  // from behind the thing
    };
    write_scene(shade);
    EXPECT_THAT(kinds("-o a.png"), testing::ElementsAre("no_light"));
    EXPECT_THAT(kinds("-o a.exr --channels Z"), IsEmpty());
    write_scene([&](Json& scene) {
        shade(scene);
        scene["materials"]["brick"]["color"] = {0, 0, 0};  // black on purpose
        scene["materials"]["default"]["color"] = {0, 0, 0};
    });
    EXPECT_THAT(kinds("-o a.png"), IsEmpty());
}

TEST_F(CliWarningsTest, SayThatAnObjectBecameNoVoxelInEveryRun) {
    write_scene([](Json& scene) {
        // The box's corner is in the world, and no part of the ring.
        scene["models"]["ring"] = {
            {"shape", "torus"}, {"radius", 3}, {"tube", 0.1}, {"surface", "exact"}};
        scene["objects"].push_back({{"name", "ring"},
                                    {"model", "ring"},
                                    {"turn", {0, 90, 0}},
                                    {"position", {1.5, 1, 0.5}}});
    });
    for (int i = 0; i < 2; ++i)  // the second one finds what the first one kept
        EXPECT_THAT(kinds("-o a.png"), testing::ElementsAre("no_voxels"));
}

/// A plate of 1 mm between the middles of two layers of voxels, in the middle of the picture.
Json thin_plate() {
    return {{"shape", "box"}, {"size", {0.5, 0.5, 0.001}}, {"surface", "cubes"}, {"set", "solid"}};
}

TEST_F(CliWarningsTest, SayThatAThinObjectBecameNoVoxelAndNotWhereElseToLook) {
    write_scene([](Json& scene) {
        scene["models"]["plate"] = thin_plate();
        scene["objects"] =
            Json::array({{{"name", "plate"}, {"model", "plate"}, {"position", {1.5, 1, 0.503}}}});
    });
    EXPECT_THAT(kinds("-o a.png"), testing::ElementsAre("thinner_than_voxel", "no_voxels"));
    EXPECT_THAT(run("render scene.json -o a.png").err,
                HasSubstr("\"plate\" became no voxel, so nothing shows it"));
}

TEST_F(CliWarningsTest, SayWhereTheObjectsLieThatBecameVoxels) {
    write_scene([](Json& scene) {
        // The world is within the ring, and a part of the ring's box at the world's end.
        scene["models"]["ring"] = {
            {"shape", "torus"}, {"radius", 3.3}, {"tube", 0.1}, {"surface", "exact"}};
        scene["objects"].push_back({{"name", "ring"},
                                    {"model", "ring"},
                                    {"turn", {0, 0, 90}},
                                    {"position", {2.9, 1, 0.5}}});
        scene["observer"]["look_at"] = {2.7, 1, 0.5};
        scene["observer"]["display"]["angles"] = {8, 6};
    });
    EXPECT_THAT(run("render scene.json -o a.png").err,
                AllOf(HasSubstr("\"ring\" became no voxel"),
                      HasSubstr("the objects lie around [1.5, 1, 0.5]")));
}

TEST_F(CliWarningsTest, SayThatTheCacheCannotBeWritten) {
    write_scene([](Json&) {});
    put_bytes(folder / "file", "no folder");
    const Setting setting("VOXELUME_CACHE_DIR", (folder / "file" / "cache").c_str());
    const std::string line = run("render scene.json -o a.exr --channels Z").err;
    EXPECT_THAT(line, HasSubstr("/file/cache/models: nothing can be kept in this folder (Not a "
                                "directory)"));
    EXPECT_THAT(run("render scene.json -o a.exr --channels Z --no-cache").err,
                Not(HasSubstr("warning")));
}

/// Access rights don't keep the superuser from writing; a file and a file system do.
TEST_F(CliWarningsTest, SayOnceThatTheCacheCannotBeWrittenToTheSuperuser) {
    write_scene([](Json&) {});
    put_bytes(folder / "file", "no folder");
    std::filesystem::create_directory(folder / "fixed");
    const auto is_told_once = [&](const std::string& line, const std::string& cause) {
        const std::string err = run_line(line).err;
        const std::string told = "nothing can be kept in this folder (" + cause + ")";
        const size_t first = err.find(told);
        EXPECT_NE(first, std::string::npos) << err;
        if (first == std::string::npos) return;
        EXPECT_EQ(err.find("nothing can be kept", first + 1), std::string::npos) << err;
    };
    const std::string render = "voxelume render scene.json -o a.exr --channels Z";
    is_told_once("VOXELUME_CACHE_DIR=file " + render, "Not a directory");
    std::filesystem::create_directories(folder / "cache" / "programs");
    std::filesystem::permissions(folder / "cache" / "programs", std::filesystem::perms::all);
    is_told_once("VOXELUME_CACHE_DIR=cache voxelume check scene.json",
                 "other users may write to it; `chmod go-w` forbids them");
    const std::string mount =
        "unshare -m sh -c 'mount -t tmpfs none fixed && mount -o remount,ro fixed && ";
    if (run_line(mount + "true'").exit_code != 0) GTEST_SKIP() << "nothing can be mounted here";
    is_told_once(mount + "VOXELUME_CACHE_DIR=fixed " + render + "'", "Read-only file system");
    is_told_once(
        "unshare -m sh -c 'mount -t tmpfs -o size=220k none fixed && "
        "VOXELUME_CACHE_DIR=fixed voxelume check scene.json'",
        "its disk has only 0.1 MB left");
}

TEST_F(CliWarningsTest, CannotSteerTheTerminal) {
    put_bytes(folder / "a\x1b[2J.json", bytes_of(folder / "scene.json"));
    for (const char c : run("check 'a\x1b[2J.json'").err)
        EXPECT_TRUE(c == '\n' || (c >= 0x20 && c != 0x7f)) << int(c);
}

}  // namespace voxelume
