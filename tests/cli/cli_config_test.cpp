// SPDX-License-Identifier: Apache-2.0
// Settings from the environment and from a file, and where they come from.
#include <gmock/gmock.h>

#include <cctype>
#include <regex>
#include <set>

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
                AllOf(HasSubstr("  device         \"cpu\""), HasSubstr("config:1\n")));
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
    EXPECT_THAT(text, HasSubstr("\"/home/me/base:/a~/b:/home/me/top\" "));
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
                HasSubstr("VOXELUME_PROGRESS=wild: there is no \"wild\"; known are "));
    EXPECT_THAT(fault("\nprogress = wild\n", "", ""), HasSubstr("config:2: progress: there is no"));
    EXPECT_THAT(fault("", "", " --progress wild"), HasSubstr("render: --progress: there is no"));
}

TEST_F(CliConfigTest, WrongValuesAreRefusedWhereverTheyAreSet) {
    const std::pair<const char*, const char*> wrong[] = {
        {"cache_mb", "abc"},   {"cache_mb", "-1"},         {"lanes", "3"},
        {"memory_mb", "0"},    {"buffer_mb", "1e3"},       {"progress", "wild"},
        {"self_test", "on"},   {"units", "nan"},           {"units", " 2"},
        {"work_group", "010"}, {"cache_mb", "99999999999"}};
    for (const auto& [name, value] : wrong) {
        std::string variable = fmt::format("VOXELUME_{}", name);
        std::ranges::transform(variable, variable.begin(), [](char c) { return std::toupper(c); });
        const std::string set = fmt::format("'{}={}'", variable, value);
        const std::string line = fmt::format("{} = \"{}\"\n", name, value);
        for (const char* command : {"config", "info scene.json"}) {
            const ProgramResult result = run_with("", set, command);
            EXPECT_EQ(result.exit_code, 2) << set;
            EXPECT_THAT(result.err, HasSubstr(fmt::format("{}={}: ", variable, value)));
            EXPECT_EQ(run_with(line, "", command).exit_code, 2) << line;
            EXPECT_THAT(run_with(line, "", command).err, HasSubstr("config:1: "));
        }
        EXPECT_THAT(run_with("", set, "config").out, HasSubstr(variable));
        EXPECT_EQ(run_with("", variable + "=", "config").exit_code, 0) << variable;
    }
}

/// The program's sources, which say what variables it reads.
std::string sources() {
    std::string text;
    const std::filesystem::path root = VXL_SOURCE_DIR;
    for (const char* name : {"cli", "runtime", "python"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / name)) {
            const std::string file = entry.path().string();
            const bool is_table = file.ends_with("settings_table.cpp");
            if (!is_table && (file.ends_with(".cpp") || file.ends_with(".hpp")))
                text += bytes_of(entry.path());
        }
    return text;
}

TEST_F(CliConfigTest, EveryVariableThatTheSourcesReadIsListed) {
    const std::string text = sources();
    std::set<std::string> read, listed;
    const std::regex name(
        "(?:env|environment|environment_path|number_in_environment|is_set)\\((?:[a-z]+, "
        ")?\"([A-Z_]+)\"|"
        "\"((?:VOXELUME|POCL|XDG|OCL)_[A-Z_]+)\"");
    for (std::sregex_iterator match(text.begin(), text.end(), name), end; match != end; ++match)
        read.insert((*match)[1].matched ? (*match)[1] : (*match)[2]);
    for (const char* prefix : {"POCL_", "OCL_"}) read.erase(prefix);  // of doctor's list
    EXPECT_THAT(read, testing::IsSupersetOf({"HOME", "CI", "VOXELUME_UNITS", "VOXELUME_CONFIG"}));
    const Json report = Json::parse(run_with("", "", "config --json").out);
    for (const char* part : {"settings", "environment"})
        for (const Json& row : report[part]) listed.insert(row["variable"].get<std::string>());
    read.erase("VOXELUME_");
    EXPECT_THAT(read, testing::ElementsAreArray(listed));
    const std::string page = run("man").out, shown = run("config").out;
    const std::string manual = bytes_of(std::filesystem::path(VXL_SOURCE_DIR) / "cli/MANUAL.md");
    for (const std::string& variable : listed) {
        EXPECT_THAT(page, HasSubstr("\\fB" + variable + "\\fR")) << variable;
        if (!variable.starts_with("VOXELUME_")) continue;
        EXPECT_THAT(manual, HasSubstr("`" + variable + "`"));
    }
    EXPECT_THAT(
        shown, AllOf(HasSubstr("  work_group "), HasSubstr("  config "), HasSubstr("  NO_COLOR ")));
}

TEST_F(CliConfigTest, AVariableThatIsNoSettingIsToldOf) {
    const char* set = "VOXELUME_CAHCE_MB=5 VOXELUME_PROGRESS=bar";
    EXPECT_THAT(run_with("", set, "config").out,
                HasSubstr("\nVOXELUME_CAHCE_MB isn't read; did you mean \"VOXELUME_CACHE_MB\"?\n"));
    const Json report = Json::parse(run_with("", set, "config --json").out);
    EXPECT_EQ(report["unknown"].size(), 1u);
}

TEST_F(CliConfigTest, TheFileOfSettingsIsNamedByItsOrigin) {
    const auto row = [&](const std::string& variables) {
        return Json::parse(
                   run_line("env -u VOXELUME_CONFIG " + variables + " voxelume config --json")
                       .out)["settings"]
            .back();
    };
    const Json home = row("-u XDG_CONFIG_HOME HOME=/home/me");
    EXPECT_EQ(home["name"], "config");
    EXPECT_EQ(home["value"], "/home/me/.config/voxelume/config");
    EXPECT_EQ(home["origin"], "HOME");
    EXPECT_EQ(row("XDG_CONFIG_HOME=/shared")["origin"], "XDG_CONFIG_HOME");
    EXPECT_EQ(row("VOXELUME_CONFIG= XDG_CONFIG_HOME=/shared")["origin"], "VOXELUME_CONFIG");
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
