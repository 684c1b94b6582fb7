// SPDX-License-Identifier: Apache-2.0
// Help, completion, manual page and manual come from one table of options, and agree.
#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

/// All matches of a pattern's first group.
std::set<std::string> matches(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    std::set<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
        found.insert((*match)[1]);
    return found;
}

class CliCompletionTest : public ProgramTest {
  protected:
    std::set<std::string> command_names() const {
        return matches(run("help").out, "\n  ([a-z]+) +[a-z]");
    }
    std::set<std::string> options_of(const std::string& command) const {
        return matches(run("help " + command).out, "[\n,!](?:  )?(--[a-z-]+)");
    }
};

TEST_F(CliCompletionTest, EveryOptionOfHelpIsInEveryScriptAndOnThePage) {
    const std::string bash = run("completion bash").out, zsh = run("completion zsh").out;
    const std::string fish = run("completion fish").out;
    const std::string page = std::regex_replace(run("man").out, std::regex("\\\\-"), "-");
    EXPECT_THAT(command_names(), IsSupersetOf({"render", "check", "doctor", "completion"}));
    for (const std::string& command : command_names()) {
        if (command == "help") continue;
        EXPECT_THAT(page, HasSubstr(".SS \"voxelume " + command + "\"\n"));
        EXPECT_THAT(fish, HasSubstr("-f -a " + command + " -d "));
        const auto names = matches(bash, "            " + command + "\\) words=\"([^\"]*)\"");
        ASSERT_EQ(names.size(), 1u) << command;
        for (const std::string& option : options_of(command)) {
            EXPECT_THAT(" " + *names.begin() + " ", HasSubstr(" " + option + " ")) << command;
            EXPECT_THAT(zsh, HasSubstr("'*" + option + "[")) << command;
            EXPECT_THAT(page, HasSubstr("\\fB" + option + "\\fR")) << command;
            EXPECT_TRUE(
                std::regex_search(fish, std::regex("__voxelume_command " + command + "'[^\n]* -l " +
                                                   option.substr(2) + "[ \n]")))
                << command << option;
        }
    }
}

TEST_F(CliCompletionTest, BashCompletesCommandsOptionsAndTheirWords) {
    const auto completed = [&](const std::string& words) {
        put_bytes(folder / "try.sh", "source <(voxelume completion bash)\nCOMP_WORDS=(" + words +
                                         ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_voxelume\n"
                                         "echo \"${COMPREPLY[*]}\"\n");
        return run_line("bash try.sh").out;
    };
    EXPECT_EQ(completed("voxelume rend"), "render\n");
    EXPECT_EQ(completed("voxelume render a.json --prog"), "--progress\n");
    EXPECT_EQ(completed("voxelume render a.json --progress j"), "json\n");
    EXPECT_EQ(completed("voxelume render a.json --light g"), "global\n");
    EXPECT_EQ(completed("voxelume completion z"), "zsh\n");
    EXPECT_EQ(completed("voxelume help doc"), "doctor\n");
    EXPECT_EQ(completed("voxelume --v"), "--version\n");
    EXPECT_EQ(completed("voxelume render tr"), "try.sh\n");
    EXPECT_EQ(completed("voxelume render -o tr"), "try.sh\n");
    EXPECT_EQ(completed("voxelume render --size tr"), "\n");
    put_bytes(folder / "two words.json", "");
    EXPECT_EQ(completed("voxelume render tw"), "two words.json\n");
    EXPECT_EQ(completed("voxelume render a.json --device a"), "auto all\n");
    EXPECT_EQ(completed("voxelume doctor --device a"), "auto\n");
    EXPECT_THAT(completed("voxelume voxelize a.obj --device ''"), HasSubstr("gpu 0"));
    EXPECT_EQ(completed("voxelume render --channels Crypto"), "CryptoObject CryptoMaterial\n");
    EXPECT_EQ(completed("voxelume render --channels RGBA,Z,obj"), "RGBA,Z,objectId\n");
    EXPECT_EQ(completed("voxelume render --channels = RGBA,P"), "RGBA,P\n");
    EXPECT_EQ(completed("voxelume diff --channels R,object"), "R,objectId\n");
    EXPECT_EQ(completed("voxelume render --view is"), "iso\n");
    EXPECT_EQ(completed("voxelume stress --only ties,ran"), "ties,random\n");
    EXPECT_EQ(completed("voxelume bench --only sph"), "sphere\n");
    EXPECT_EQ(completed("voxelume bench --placement world,ins"), "world,instance\n");
    EXPECT_EQ(completed("voxelume render --light ="), "local global\n");
    EXPECT_EQ(completed("voxelume render --light = g"), "global\n");
}

TEST_F(CliCompletionTest, ZshAndFishOfferTheWordsOfArguments) {
    const std::string zsh = run("completion zsh").out;
    const size_t command = zsh.find("        completion)\n");
    ASSERT_NE(command, zsh.npos);
    EXPECT_THAT(zsh.substr(command, zsh.find(";;", command) - command),
                AllOf(HasSubstr("'1:value:(bash zsh fish)'\n"), Not(HasSubstr("_files"))));
    EXPECT_THAT(run("completion fish").out,
                HasSubstr("'__voxelume_command completion' -f -x -a 'bash zsh fish' -d "));
    if (run_line("zsh --version").exit_code != 0) GTEST_SKIP() << "there is no zsh";
    EXPECT_EQ(run_line("bash -c 'voxelume completion zsh >z && zsh -n z'").exit_code, 0);
}

TEST_F(CliCompletionTest, ThePageIsReadWithoutWarnings) {
    if (run_line("groff --version").exit_code != 0) GTEST_SKIP() << "there is no groff";
    const ProgramResult result = run_line("sh -c 'voxelume man | groff -man -Tascii -ww -z'");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
}

TEST_F(CliCompletionTest, AnUnknownShellIsAMistake) {
    const ProgramResult result = run("completion bahs");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("did you mean \"bash\"?"));
}

TEST_F(CliCompletionTest, TheDoctorReportsWhatAFaultsReportNeeds) {
    const ProgramResult result = run("doctor --json --no-test");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json report = Json::parse(result.out);
    for (const char* key : {"version", "commit", "built by", "with", "system", "processors",
                            "cache", "environment", "devices"})
        EXPECT_TRUE(report.contains(key)) << key;
    EXPECT_FALSE(report.contains("tests"));
    EXPECT_THAT(run_line("env VOXELUME_SIXTEEN=x voxelume doctor --no-test").out,
                HasSubstr("  VOXELUME_SIXTEEN x\n"));
    EXPECT_EQ(run("doctor --no-test").exit_code, 0);
    EXPECT_EQ(run("doctor --device nothing").exit_code, 6);
}

}  // namespace
}  // namespace voxelume
