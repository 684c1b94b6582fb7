// SPDX-License-Identifier: Apache-2.0
// The scripts of `voxelume completion` in zsh and fish themselves, where these are installed.
#include <gmock/gmock.h>

#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Prints what zsh shows when the tabulator is pressed behind a line, and what the line is then.
/// Its arguments are a command that makes zsh know the completion, and the line.
constexpr const char* kAskZsh = R"(zmodload zsh/zpty
zpty shell 'TERM=vt100 zsh -f -i'
zpty -w shell "stty columns 500; PS1=; autoload -Uz compinit
$1
show() { zle complete-word; zle -R; print -r -- '<'\$BUFFER'>' }
zle -N show; bindkey '^I' show; print REA''DY"
zpty -r -m shell text '*READY*'
zpty -n -w shell "$2"$'\t'
zpty -r -m shell text '*<voxelume*>*'
print -r -- "${text//$'\0'/}"
zpty -d shell
)";

class CliShellsTest : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        ASSERT_FALSE(HasFatalFailure());
        put_bytes(folder / "picture.json", "");
        put_bytes(folder / "two words.json", "");
        put_bytes(folder / "ask.zsh", kAskZsh);
    }

    bool has(const std::string& shell) const {
        return run_line(shell + " --version").exit_code == 0;
    }

    /// The completion of a line by zsh, with the script among its functions or evaluated.
    std::string asked_zsh(const std::string& line, bool is_evaluated = false) const {
        const std::string start = is_evaluated
                                      ? "compinit -u -D; eval \"$(voxelume completion zsh)\""
                                      : "fpath=($PWD $fpath); compinit -u -D";
        const ProgramResult result =
            run_line(fmt::format("timeout 60 zsh -f ask.zsh '{}' '{}'", start, line));
        EXPECT_EQ(result.exit_code, 0) << line << result.err;
        return result.out;
    }

    /// The words that fish offers, each with a blank behind it.
    std::string asked_fish(const std::string& line) const {
        const ProgramResult result = run_line(
            fmt::format("fish --no-config -c 'source voxelume.fish; complete -C \"{}\"'", line));
        EXPECT_EQ(result.err, "");
        std::string words;
        for (size_t i = 0; i < result.out.size(); i = result.out.find('\n', i) + 1)
            words += result.out.substr(i, result.out.find_first_of("\t\n", i) - i) + ' ';
        return words;
    }
};

TEST_F(CliShellsTest, ZshCompletesCommandsOptionsAndTheirValues) {
    if (!has("zsh")) GTEST_SKIP() << "there is no zsh";
    put_bytes(folder / "_voxelume", run("completion zsh").out);
    EXPECT_THAT(asked_zsh("voxelume rend"), HasSubstr("<voxelume render >"));
    EXPECT_THAT(asked_zsh("voxelume hel"), HasSubstr("<voxelume help >"));
    EXPECT_THAT(asked_zsh("voxelume --v"), HasSubstr("<voxelume --version >"));
    EXPECT_THAT(asked_zsh("voxelume help doc"), HasSubstr("<voxelume help doctor >"));
    EXPECT_THAT(asked_zsh("voxelume completion z"), HasSubstr("<voxelume completion zsh >"));
    const std::string render = "voxelume render picture.json -o a.png ";
    EXPECT_THAT(asked_zsh(render + "--prog"), HasSubstr("--progress >"));
    EXPECT_THAT(asked_zsh(render + "--progress j"), HasSubstr("--progress json >"));
    EXPECT_THAT(asked_zsh(render + "--view-transform "),
                AllOf(HasSubstr("agx"), HasSubstr("filmic"), HasSubstr("srgb")));
    EXPECT_THAT(asked_zsh(render + "--device "),
                AllOf(HasSubstr("gpu"), HasSubstr("all"), testing::ContainsRegex("0 +-- ")));
    EXPECT_THAT(asked_zsh("voxelume doctor --device cp"), HasSubstr("--device cpu >"));
    EXPECT_THAT(asked_zsh(render + "--channels RGBA,dis"), HasSubstr("RGBA,distance"));
    EXPECT_THAT(asked_zsh("voxelume stress --only ties,ran"), HasSubstr("ties,random"));
    EXPECT_THAT(asked_zsh(render + "--view is"), HasSubstr("--view iso >"));
    EXPECT_THAT(asked_zsh("voxelume render p"), HasSubstr("<voxelume render picture.json >"));
    EXPECT_THAT(asked_zsh("voxelume render tw"), HasSubstr("two\\ words.json >"));
    EXPECT_THAT(asked_zsh(render + "--stats-json pic"), HasSubstr("picture.json >"));
    EXPECT_THAT(asked_zsh(render + "--size pic"), HasSubstr("--size pic>"));
}

TEST_F(CliShellsTest, ZshTakesTheScriptFromItsStartFileToo) {
    if (!has("zsh")) GTEST_SKIP() << "there is no zsh";
    EXPECT_THAT(asked_zsh("voxelume rend", true), HasSubstr("<voxelume render >"));
    EXPECT_THAT(asked_zsh("voxelume render --prog", true), HasSubstr("--progress >"));
}

TEST_F(CliShellsTest, FishCompletesCommandsOptionsAndTheirValues) {
    if (!has("fish")) GTEST_SKIP() << "there is no fish";
    put_bytes(folder / "voxelume.fish", run("completion fish").out);
    EXPECT_EQ(asked_fish("voxelume rend"), "render ");
    EXPECT_THAT(asked_fish("voxelume "),
                AllOf(HasSubstr("help "), HasSubstr("man "), Not(HasSubstr("picture"))));
    EXPECT_EQ(asked_fish("voxelume --"), "--help --version ");
    EXPECT_EQ(asked_fish("voxelume help doc"), "doctor ");
    EXPECT_EQ(asked_fish("voxelume completion "), "bash fish zsh ");
    EXPECT_EQ(asked_fish("voxelume render picture.json --prog"), "--progress ");
    EXPECT_EQ(asked_fish("voxelume render picture.json --progress j"), "json ");
    EXPECT_EQ(asked_fish("voxelume render --view-transform "), "agx filmic none srgb ");
    EXPECT_EQ(asked_fish("voxelume render pic"), "picture.json ");
    EXPECT_EQ(asked_fish("voxelume render --stats-json pic"), "picture.json ");
    EXPECT_EQ(asked_fish("voxelume render --size pic"), "");
    EXPECT_THAT(asked_fish("voxelume render --device "),
                AllOf(HasSubstr("auto "), HasSubstr("all "), HasSubstr("0 ")));
    EXPECT_THAT(asked_fish("voxelume doctor --device "), Not(HasSubstr("all ")));
    EXPECT_EQ(asked_fish("voxelume render --channels RGBA,dis"), "RGBA,distance ");
    EXPECT_EQ(asked_fish("voxelume render --channels dis"), "distance ");
    EXPECT_EQ(asked_fish("voxelume bench --only sphere,bun"), "sphere,bunny ");
    EXPECT_EQ(asked_fish("voxelume render --view is"), "iso ");
    // A file that has a command's name isn't one.
    EXPECT_EQ(asked_fish("voxelume render bench --no-ov"), "--no-overlap ");
    EXPECT_EQ(asked_fish("voxelume render bench --csv"), "");
}

}  // namespace
}  // namespace voxelume
