// SPDX-License-Identifier: Apache-2.0
// Settings from the environment and from a file, and where they come from.
#include <gmock/gmock.h>

#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class CliConfigTest : public SceneProgramTest {
  protected:
    /// Runs the program with a file of settings, and with nothing else but `variables`.
    ProgramResult run_with(const std::string& file, const std::string& variables,
                           const std::string& arguments) const {
        put_bytes(folder / "home" / "voxelume" / "config", file);
        return run_line(fmt::format(
            "env -u VOXELUME_DEVICE -u VOXELUME_CACHE_MB -u VOXELUME_LANES XDG_CONFIG_HOME='{}' "
            "{} voxelume {}",
            (folder / "home").string(), variables, arguments));
    }

    void SetUp() override {
        SceneProgramTest::SetUp();
        std::filesystem::create_directories(folder / "home" / "voxelume");
    }
};

TEST_F(CliConfigTest, EveryValueHasItsOrigin) {
    const ProgramResult result = run_with("# for all runs\n\ndevice = cpu\ncache_mb=\"77\"\n",
                                          "VOXELUME_CACHE_MB=5", "config --json");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json report = Json::parse(result.out);
    const auto row = [&](const std::string& name) {
        for (const Json& setting : report["settings"])
            if (setting["name"] == name) return setting;
        return Json();
    };
    EXPECT_EQ(row("device")["value"], "cpu");
    EXPECT_THAT(row("device")["origin"].get<std::string>(), testing::EndsWith("config:3"));
    EXPECT_EQ(row("cache_mb")["value"], "5");
    EXPECT_EQ(row("cache_mb")["origin"], "VOXELUME_CACHE_MB");
    EXPECT_EQ(row("lanes")["value"], nullptr);
    EXPECT_EQ(row("lanes")["origin"], "default");
    EXPECT_THAT(run_with("device = cpu\n", "", "config").out,
                AllOf(HasSubstr("  device      \"cpu\""), HasSubstr("config:1\n")));
}

TEST_F(CliConfigTest, CommandsTakeValuesOfTheFileUnlessTheEnvironmentOrAnOptionSaysOtherwise) {
    const std::string none = "device = no such device\n", render = "render scene.json -q -o a.png";
    EXPECT_EQ(run_with(none, "", render).exit_code, 6);
    EXPECT_EQ(run_with(none, "VOXELUME_DEVICE=cpu", render).exit_code, 0);
    EXPECT_EQ(run_with(none, "", render + " --device cpu").exit_code, 0);
    EXPECT_THAT(run_with("progress = json\n", "", "render scene.json -o a.png").err,
                HasSubstr("\"event\":\"written\""));
    EXPECT_EQ(run_with(none, "VOXELUME_CONFIG=", render).exit_code, 0);
}

TEST_F(CliConfigTest, ATildeBeforeASlashIsTheHomeFolderWhereAPathBegins) {
    const std::string file = "cache_dir = ~/base:/a~/b:~/top\ndevice = ~/cpu\n";
    const std::string text =
        run_with(file, "env -u VOXELUME_CACHE_DIR HOME=/home/me", "config").out;
    EXPECT_THAT(text, HasSubstr("\"/home/me/base:/a~/b:/home/me/top\"  /"));
    EXPECT_THAT(text, HasSubstr("\"~/cpu\""));
}

TEST_F(CliConfigTest, AWrongKindOfProgressIsNamedByWhereItWasSet) {
    const std::string render = "render scene.json -o a.png";
    const auto fault = [&](const std::string& file, const std::string& variables,
                           const std::string& options) {
        const ProgramResult result = run_with(file, variables, render + options);
        EXPECT_EQ(result.exit_code, 2);
        return result.err;
    };
    EXPECT_THAT(fault("", "VOXELUME_PROGRESS=wild", ""),
                HasSubstr("VOXELUME_PROGRESS: progress: there is no \"wild\""));
    EXPECT_THAT(fault("\nprogress = wild\n", "", ""), HasSubstr("config:2: progress: there is no"));
    EXPECT_THAT(fault("", "", " --progress wild"), HasSubstr("render: --progress: there is no"));
}

TEST_F(CliConfigTest, AWrongLineStopsNoCommandThatHelpsToFindIt) {
    for (const char* command :
         {"--version", "help", "-h", "help render", "doctor --no-test", "man", "completion bash"}) {
        const ProgramResult result = run_with("devise = cpu\n", "", command);
        EXPECT_EQ(result.exit_code, 0) << command;
        EXPECT_THAT(result.err, HasSubstr("no setting named \"devise\"")) << command;
        EXPECT_NE(result.out, "") << command;
    }
    EXPECT_THAT(run_with("devise = cpu\n", "VOXELUME_CACHE_MB=5", "config").out,
                HasSubstr("VOXELUME_CACHE_MB"));
    EXPECT_EQ(run_with("devise = cpu\n", "", "render scene.json -o a.png").exit_code, 2);
}

TEST_F(CliConfigTest, WrongLinesAreNamedByFileAndLine) {
    const auto fault = [&](const std::string& file) {
        const ProgramResult result = run_with(file, "", "config");
        EXPECT_EQ(result.exit_code, 2) << file;
        return result.err;
    };
    EXPECT_THAT(fault("\ndevise = cpu\n"), HasSubstr("config:2: no setting named \"devise\"; did "
                                                     "you mean \"device\"?"));
    EXPECT_THAT(fault("device\n"), HasSubstr("config:1: \"device\": give a setting as NAME"));
    EXPECT_THAT(fault("lanes = 4\nlanes = 8\n"),
                HasSubstr("config:2: lanes is set already in line 1"));
    const ProgramResult missing = run_with("", "VOXELUME_CONFIG=nowhere", "config");
    EXPECT_EQ(missing.exit_code, 2);
    EXPECT_THAT(missing.err, HasSubstr("\"nowhere\": there is no such file"));
}

}  // namespace
}  // namespace voxelume
