// SPDX-License-Identifier: Apache-2.0
// What `diff` shows and when it fails, on images whose differences are known.
#include <gmock/gmock.h>

#include "runtime/image/flip.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class CliDiffTest : public ProgramTest {
  protected:
    static constexpr int kDiffWidth = 40, kDiffHeight = 25;
    static constexpr int kDiffPixels = kDiffWidth * kDiffHeight;

    /// An image of grey 0.25 in which the first `count` pixels' green is larger by `offset`.
    static Image changed(int count, float offset) {
        std::vector<float> grey(kDiffPixels, 0.25f), green = grey;
        for (int i = 0; i < count; ++i) green[size_t(i)] += offset;
        return {kDiffWidth, kDiffHeight, {{"R", grey}, {"G", green}, {"B", grey}}, {}, {}};
    }

    void put_exr(const std::string& name, int count, float offset) const {
        write_exr(folder / name, changed(count, offset), ColorDepth::float32);
    }

    Json report_of(const std::string& arguments) const {
        return Json::parse(run("diff --json " + arguments).out);
    }
};

TEST_F(CliDiffTest, PixelsAboveTheThresholdFailByNumberOrShare) {
    put_exr("a.exr", 10, 0.5f);
    put_exr("b.exr", 0, 0);
    const auto code = [&](const std::string& options) {
        return run("diff a.exr b.exr " + options).exit_code;
    };
    EXPECT_EQ(code("--fail-above 10"), 0);
    EXPECT_EQ(code("--fail-above 9"), 1);
    EXPECT_EQ(code("--fail-above 1%"), 0);
    EXPECT_EQ(code("--fail-above 0.9%"), 1);
    EXPECT_EQ(code("--fail-above 0 --threshold 0.5"), 0);
    EXPECT_EQ(code("--fail-above 0 --threshold 0.49"), 1);
    EXPECT_EQ(code("--fail-above 0 --channels R,B"), 0);
    EXPECT_EQ(code("--fail-above 5.5"), 2);
    EXPECT_EQ(code("--fail-above 101%"), 2);
    EXPECT_EQ(code("--threshold -1"), 2);
    EXPECT_THAT(
        run("diff a.exr b.exr --fail-above 0.5%").err,
        HasSubstr("the images differ: 10 of 1000 pixels are above the threshold, and 0.5% "));
    const Json report = report_of("a.exr b.exr --threshold 0.1");
    EXPECT_EQ(report["above"], 10);
    EXPECT_EQ(report["pixels"], 1000);
    EXPECT_EQ(report["channels"][1]["channel"], "G");
    EXPECT_EQ(report["channels"][1]["above"], 10);
    EXPECT_EQ(report["channels"][0]["above"], 0);
}

TEST_F(CliDiffTest, FlipIsALimitToo) {
    put_exr("a.exr", kDiffPixels, 0.25f);
    put_exr("b.exr", 0, 0);
    const double flip = mean_flip(changed(kDiffPixels, 0.25f), changed(0, 0));
    ASSERT_GT(flip, 0.1);
    const auto failing = [&](double limit, const char* more = "") {
        return run(fmt::format("diff a.exr b.exr --fail-flip {} {}", limit, more));
    };
    EXPECT_EQ(failing(flip + 1e-6).exit_code, 0);
    EXPECT_THAT(failing(flip - 1e-3).err, HasSubstr(fmt::format("FLIP is {:.6g}, above", flip)));
    EXPECT_EQ(failing(0.1, "--channels G").exit_code, 2);
    EXPECT_EQ(failing(1.1).exit_code, 2);
}

TEST_F(CliDiffTest, PicturesShowTheDifferenceAndFlip) {
    put_exr("a.exr", 10, 0.5f);
    put_exr("b.exr", 0, 0);
    ASSERT_EQ(run("diff a.exr b.exr -o d.exr --flip-map f.exr").exit_code, 0);
    const Image difference = read_exr(folder / "d.exr");
    EXPECT_EQ(difference.planes.at("G")[9], 0.5f);
    EXPECT_EQ(difference.planes.at("G")[10], 0.0f);
    EXPECT_EQ(difference.planes.at("R")[9], 0.0f);
    const Image map = read_exr(folder / "f.exr");
    const std::vector<float> expected = flip_map(changed(10, 0.5f), changed(0, 0));
    EXPECT_EQ(map.planes.at("FLIP"), Plane<float>(expected));
    ASSERT_EQ(run("diff a.exr b.exr --flip-map f.png").exit_code, 0);
    const Picture heat = read_png(folder / "f.png");
    for (size_t i = 0; i < expected.size(); ++i)  // red comes first, then green, then blue
        for (size_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(heat.pixels[i][channel],
                        255 * std::clamp(3 * expected[i] - float(channel), 0.0f, 1.0f), 1.0);
}

TEST_F(CliDiffTest, APictureOfCodesHasTheirDifferencesAsCodes) {
    const auto put = [&](const char* name, float value) {
        write_png(folder / name,
                  {2, 1, {{"R", {value, 1}}, {"G", {1, 1}}, {"B", {0, 0.5f}}}, {}, {}});
        return int(read_png(folder / name).pixels[0][0]);
    };
    const int a = put("a.png", 0.8f), b = put("b.png", 0.1f);
    ASSERT_EQ(run("diff a.png b.png -o d.png").exit_code, 0);
    const Picture picture = read_png(folder / "d.png");
    EXPECT_EQ(picture.pixels[0], (std::array<uint8_t, 4>{uint8_t(a - b), 0, 0, 255}));
    EXPECT_EQ(picture.pixels[1], (std::array<uint8_t, 4>{0, 0, 0, 255}));
}

TEST_F(CliDiffTest, AnimationsAreComparedFrameByFrame) {
    for (const int frame : {8, 9, 10}) {
        put_exr(fmt::format("a.{:04}.exr", frame), frame, 0.5f);
        put_exr(fmt::format("b{}.exr", frame), frame == 9 ? 9 : 0, 0.5f);
    }
    put_exr("a.extra.exr", 1, 1);
    const std::string line = "a.####.exr b%d.exr";
    const Json rows = report_of(line)["frames"];
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0]["frame"], 8);
    EXPECT_EQ(rows[0]["worst"], "G");
    EXPECT_EQ(rows[0]["above"], 8);
    EXPECT_EQ(rows[1]["rmse"], 0);
    EXPECT_EQ(rows[2]["above"], 10);
    EXPECT_THAT(run("diff " + line).out, HasSubstr("frame"));
    const ProgramResult failed = run("diff --fail-above 8 -o d.##.png " + line);
    EXPECT_EQ(failed.exit_code, 1);
    EXPECT_THAT(failed.err, HasSubstr("frame 10: 10 of 1000 pixels"));
    EXPECT_EQ(read_png(folder / "d.10.png").width, kDiffWidth);
    EXPECT_EQ(run("diff --fail 0 --frames 9 " + line).exit_code, 0);
    std::filesystem::remove(folder / "b9.exr");
    EXPECT_THAT(run("diff " + line).err, AllOf(HasSubstr("b9.exr"), HasSubstr("no such file")));
    EXPECT_EQ(run("diff " + line).exit_code, 4);
    EXPECT_EQ(run("diff c.####.exr d.####.exr").exit_code, 2);
    EXPECT_THAT(run("diff a.####.exr b8.exr").err, HasSubstr("b8.exr: frames have their number"));
}

TEST_F(CliDiffTest, APictureNeverReplacesWhatIsCompared) {
    put_exr("a.exr", 1, 1);
    for (const char* output : {"-o a.exr", "--flip-map ./a.exr", "-o c.exr --flip-map c.exr"})
        EXPECT_EQ(run(std::string("diff a.exr a.exr ") + output).exit_code, 2) << output;
    EXPECT_EQ(run("diff a.exr a.exr -o c.gif").exit_code, 2);
}

}  // namespace
}  // namespace voxelume
