// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/progress.hpp"

#include <gmock/gmock.h>

#include <map>

#include "tests/support/file_fixture.hpp"

namespace voxelume {

namespace {

Variables environment_of(std::map<std::string, std::string> variables) {
    return [variables = std::move(variables)](const char* name) {
        const auto found = variables.find(name);
        return found == variables.end() ? nullptr : found->second.c_str();
    };
}

Terminal plain(int columns) {
    return {true, false, columns};
}

}  // namespace

TEST(DescribeTerminal, DrawsOnlyWhereAPersonWatches) {
    EXPECT_TRUE(describe_terminal(true, environment_of({{"TERM", "xterm"}})).draws_bars);
    EXPECT_FALSE(describe_terminal(false, environment_of({{"TERM", "xterm"}})).draws_bars);
    EXPECT_FALSE(describe_terminal(true, environment_of({{"TERM", "dumb"}})).draws_bars);
    EXPECT_FALSE(describe_terminal(true, environment_of({})).draws_bars);
    const Variables ci = environment_of({{"TERM", "xterm"}, {"CI", "true"}});
    EXPECT_FALSE(describe_terminal(true, ci).draws_bars);
}

TEST(DescribeTerminal, NoColorTakesTheColourAndLeavesTheBar) {
    const Variables no_color = environment_of({{"TERM", "xterm"}, {"NO_COLOR", "1"}});
    EXPECT_TRUE(describe_terminal(true, no_color).draws_bars);
    EXPECT_FALSE(describe_terminal(true, no_color).has_color);
    const Variables empty = environment_of({{"TERM", "xterm"}, {"NO_COLOR", ""}});
    EXPECT_TRUE(describe_terminal(true, empty).has_color);
}

TEST(ProgressLine, ShowsPartBarAndTimeLeft) {
    EXPECT_EQ(progress_line({"frame", 1, 4, 10.0, 30.0}, plain(37)),
              "frame [##--------]  25% 0:30 left   ");
    EXPECT_EQ(progress_line({"frame", 4, 4, 75.0}, plain(37)),
              "frame [##########] 100% 1:15        ");
}

TEST(ProgressLine, SaysHundredOnlyWhenNothingIsLeft) {
    EXPECT_THAT(progress_line({"f", 9999, 10000, 1.0}, plain(80)), testing::HasSubstr(" 99%"));
    EXPECT_THAT(progress_line({"f", 0, 0, 1.0}, plain(80)), testing::HasSubstr("100%"));
}

TEST(ProgressLine, FitsAnyTerminal) {
    for (int columns = 0; columns < 120; ++columns)
        EXPECT_LE(progress_line({"voxelizing bunny", 1, 3, 5000.0}, plain(columns)).size(),
                  static_cast<size_t>(std::max(0, columns - 1)));
}

TEST(Progress, SaysNothingInAFile) {
    std::FILE* file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    Progress progress("frame", 3, file);
    progress.say("compiling kernels: 1 of 2");
    progress.clear();
    EXPECT_EQ(std::ftell(file), 0);
    std::fclose(file);
}

TEST(Progress, IsSilentInAFile) {
    std::FILE* file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    {
        Progress progress("frame", 3, file);
        for (int i = 0; i < 3; ++i) progress.advance();
    }
    EXPECT_EQ(std::ftell(file), 0);
    std::fclose(file);
}

}  // namespace voxelume
