// SPDX-License-Identifier: Apache-2.0
// Other programs compared by `voxelume bench`: where they are quicker at equal error, and their
// files.
#include "runtime/verify/report/bench_fronts.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/verify/bench/bench.hpp"
#include "runtime/verify/report/bench_page.hpp"
#include "runtime/verify/report/bench_tables.hpp"
#include "tests/support/program_runner.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

TEST(BenchFronts, AFrontIsWhatNothingBeatsFromCoarseToFine) {
    const ErrorFront front =
        error_front({{1e-3, 4}, {1e-2, 2}, {1e-1, 3}, {1e-2, 2}, {1e-3, 5}, {0, 1}, {1e-5, 9}});
    const ErrorFront expected = {{1e-2, 2}, {1e-3, 4}, {1e-5, 9}};
    EXPECT_EQ(front, expected);
}

TEST(BenchFronts, TheyCrossWhereStraightLinesOfLogarithmsDo) {
    // The other program takes 1 s at 1e-1 and 10,000 s at 1e-5, ten times as long per decade. Ours
    // always takes 100 s, so both are equal at 1e-3.
    const std::vector<FrontPiece> pieces =
        compare_fronts({{1e-2, 100}, {1e-6, 100.0000001}}, {{1e-1, 1}, {1e-5, 1e4}}, 1e-1);
    ASSERT_EQ(pieces.size(), 2u);
    EXPECT_NEAR(pieces[0].coarse, 1e-1, 1e-9);
    EXPECT_NEAR(pieces[0].fine, 1e-3, 1e-9);
    EXPECT_NEAR(pieces[0].minimum, 0.01, 1e-9);
    EXPECT_NEAR(pieces[0].maximum, 1, 1e-9);
    EXPECT_NEAR(pieces[1].coarse, 1e-3, 1e-9);
    EXPECT_NEAR(pieces[1].fine, 1e-5, 1e-12);
    EXPECT_NEAR(pieces[1].minimum, 1, 1e-9);
    EXPECT_NEAR(pieces[1].maximum, 100, 1e-4);
}

TEST(BenchFronts, OnlyErrorsThatBothReachAreCompared) {
    const std::vector<FrontPiece> pieces =
        compare_fronts({{1e-2, 1}, {1e-4, 4}}, {{1e-3, 10}, {1e-6, 100}}, 1e-3);
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_NEAR(pieces[0].coarse, 1e-3, 1e-12);
    EXPECT_NEAR(pieces[0].fine, 1e-4, 1e-12);
    EXPECT_NEAR(pieces[0].minimum, 5, 1e-9);                   // 10 s over 2 s
    EXPECT_NEAR(pieces[0].maximum, std::cbrt(1e4) / 4, 1e-9);  // 21.5 s over 4 s
    // A coarser image takes as long as the front's coarsest.
    EXPECT_NEAR(compare_fronts({{1e-2, 1}, {1e-4, 4}}, {{1e-3, 10}, {1e-6, 100}}, 1e-1)[0].maximum,
                10, 1e-9);
    EXPECT_TRUE(compare_fronts({{1e-2, 1}}, {{1e-3, 1}}, 1e-3).empty());
}

BenchReport report_with_peers() {
    BenchReport report;
    for (const auto& [error, seconds] : {std::pair(1e-2, 1.0), std::pair(1e-6, 2.0)}) {
        BenchRow row;
        row.scene = "sphere";
        row.errors.compared = 1;
        row.errors.depth_rms = error;
        row.seconds.total = seconds;
        report.rows.push_back(row);
    }
    report.peers = {{"Quick 1.0", "sphere", "few", 0.1, 0.1, 1e-2, 0, 0, 0},
                    {"Quick 1.0", "sphere", "many", 100, 100, 1e-4, 0, 0, 0},
                    {"Slow 2.0", "sphere", "voxels", 5, 5, 1e-3, 0, 0, 73}};
    conclude(report);
    return report;
}

TEST(BenchFronts, AreSaidInTheTextAndOnThePage) {
    const BenchReport report = report_with_peers();
    const auto comparisons = front_comparisons(report);
    ASSERT_EQ(comparisons.size(), 2u);
    const std::string first = sentence_of(comparisons[0]), second = sentence_of(comparisons[1]);
    EXPECT_THAT(first, testing::MatchesRegex(
                           "sphere, Quick 1.0: Quick 1.0 is up to 5 times as quick from 0.01 m of "
                           "depth RMS down to 0.0032 m; Voxelume is up to 141 times as quick from "
                           "0.0032 m of depth RMS down to 0.0001 m; only Voxelume comes nearer, to "
                           "1e-06 m\\."));
    EXPECT_THAT(second, HasSubstr("Voxelume is 8.41 times as quick at"));
    for (const std::string& sentence : {first, second}) {
        EXPECT_THAT(bench_text(report), HasSubstr(sentence));
        EXPECT_THAT(bench_page(report), HasSubstr("<li>" + sentence));
    }
}

TEST(BenchFronts, ThatTakeTheSameTimeAreNotCalledUpToOneTimesAsQuick) {
    for (const double maximum : {1.004, 1 / 1.004}) {
        const FrontComparison equal{"Twin",
                                    "box",
                                    {{1e-2, 1e-3, std::min(maximum, 1.0), std::max(maximum, 1.0)}},
                                    1e-6,
                                    1e-3};
        EXPECT_THAT(sentence_of(equal), HasSubstr(" is as quick from 0.01 m of depth RMS"));
    }
}

TEST(BenchFronts, PixelsThatAPeersErrorsLeaveOutAreShown) {
    const BenchReport report = report_with_peers();
    EXPECT_THAT(bench_text(report), HasSubstr("1.00e-03          73 "));
    EXPECT_THAT(bench_page(report), HasSubstr("<td>0.001<td>0<td>73<td>"));
    EXPECT_EQ(bench_json(report)["peers"][2]["other_part_pixels"], 73);
}

class BenchPeers : public ProgramTest {
  protected:
    std::string refusal(const std::string& text) {
        std::ofstream(folder / "peers.json") << text;
        const ProgramResult result = run("bench -q --only sphere --peers peers.json --size 4x4");
        EXPECT_EQ(result.exit_code, 4) << text;
        return result.err;
    }
};

/// A file with one row, in which one value is replaced, or left out if `text` is empty.
std::string file_with(const std::string& key, const std::string& text) {
    std::string row;
    for (const auto& [name, value] :
         {std::pair("program", "\"a\""), std::pair("scene", "\"sphere\""),
          std::pair("setting", "\"b\""), std::pair("build_seconds", "1"),
          std::pair("trace_seconds", "1"), std::pair("depth_rms_metres", "1"),
          std::pair("depth_max_metres", "1"), std::pair("normal_rms_degrees", "1"),
          std::pair("other_part_pixels", "0")}) {
        if (key == name && text.empty()) continue;
        row +=
            fmt::format("{}\"{}\": {}", row.empty() ? "" : ", ", name, key == name ? text : value);
    }
    return fmt::format(R"({{"size": [4, 4], "rows": [{{{}}}]}})", row);
}

TEST_F(BenchPeers, FilesOfOtherThingsAreRefusedInWords) {
    for (const char* text : {"null", "[]", "{", "", R"({"size": [4, 4], "rows": null})", "{}"})
        EXPECT_EQ(refusal(text),
                  "voxelume: peers.json: not a file of bench_peers: it isn't an object with a "
                  "\"size\" and a list of \"rows\"\n");
    EXPECT_EQ(run("bench -q --peers missing.json").err, "voxelume: missing.json: no such file\n");
    EXPECT_EQ(run("bench -q --peers missing.json").exit_code, 4);
    EXPECT_EQ(run("bench -q --peers .").exit_code, 4);
    EXPECT_THAT(run("bench -q --peers .").err, HasSubstr("a folder, not a file of bench_peers"));
}

TEST_F(BenchPeers, SizesThatAreNoneOrOthersAreRefused) {
    for (const char* size : {"null", "4", "[4]", "[4,4,4]", "[4,null]", "[4,4.5]", "[-4,4]",
                             "[0,4]", "[1e300,4]", "\"4x4\"", "[99999999999,4]"})
        EXPECT_THAT(refusal(fmt::format(R"({{"size": {}, "rows": []}})", size)),
                    HasSubstr("not two numbers of pixels like [1024, 1024]"));
    EXPECT_EQ(
        refusal(R"({"size": [8, 4], "rows": []})"),
        "voxelume: peers.json: measured with 8 x 4 pixels, and this run has 4 x 4: add --size "
        "8x4\n");
}

TEST_F(BenchPeers, EveryWrongValueIsNamedWithItsRow) {
    const auto fault = [&](const char* key, const char* text) {
        const std::string err = refusal(file_with(key, text));
        const std::string start = "voxelume: peers.json: not a file of bench_peers: row 0: ";
        EXPECT_THAT(err, testing::StartsWith(start));
        return err.substr(std::min(err.size(), start.size()));
    };
    EXPECT_EQ(fault("program", ""), "there is no \"program\"\n");
    EXPECT_EQ(fault("program", "7"), "\"program\" is a number, not a text\n");
    EXPECT_EQ(fault("setting", "null"), "\"setting\" is null, not a text\n");
    EXPECT_EQ(fault("scene", "\"spere\""),
              "there is no scene named \"spere\"; did you mean \"sphere\"?\n");
    EXPECT_EQ(fault("depth_rms_metres", "null"), "\"depth_rms_metres\" is null, not a number\n");
    EXPECT_EQ(fault("depth_max_metres", "[1]"), "\"depth_max_metres\" is an array, not a number\n");
    EXPECT_EQ(fault("trace_seconds", "\"1\""), "\"trace_seconds\" is a string, not a number\n");
    EXPECT_EQ(fault("build_seconds", "-1"), "\"build_seconds\" is below 0\n");
    for (const char* extreme : {"1e31", "1e-310"})
        EXPECT_THAT(fault("depth_rms_metres", extreme),
                    HasSubstr("what was measured lies from 1e-30 to 1e+30, or is 0\n"));
    EXPECT_EQ(fault("other_part_pixels", ""), "there is no \"other_part_pixels\"\n");
    EXPECT_EQ(fault("other_part_pixels", "0.5"),
              "\"other_part_pixels\" is 0.5, not a number of pixels\n");
    EXPECT_EQ(
        refusal(R"({"size": [4, 4], "rows": [1]})"),
        "voxelume: peers.json: not a file of bench_peers: row 0: it is a number, not an object\n");
}

TEST_F(BenchPeers, OutputsMayNotHaveOneNameInAnySpelling) {
    EXPECT_EQ(run("bench --json a --csv ./a").exit_code, 2);
    EXPECT_EQ(run("bench --json a --csv \"$PWD/a\"").exit_code, 2);
}

}  // namespace
}  // namespace voxelume
