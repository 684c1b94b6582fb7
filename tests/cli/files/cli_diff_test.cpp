// SPDX-License-Identifier: Apache-2.0
// The output of `diff`, and when it fails, for images whose differences are known.
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

TEST_F(CliDiffTest, APictureOfAFrameNeverReplacesAnother) {
    for (const int frame : {1, 2}) {
        put_exr(fmt::format("a{}.exr", frame), 1, 1);
        put_exr(fmt::format("b{}.exr", frame), 2, 1);
    }
    std::filesystem::create_symlink("a2.exr", folder / "link.1.exr");
    std::filesystem::create_symlink("b1.exr", folder / "link.2.exr");
    const std::string before = bytes_of(folder / "a2.exr");
    for (const char* output :
         {"-o a%d.exr", "-o ./b#.exr", "-o link.#.exr", "--flip-map ../$(basename $PWD)/a#.exr"})
        EXPECT_THAT(run(std::string("diff a#.exr b#.exr ") + output).err,
                    HasSubstr("would replace"))
            << output;
    const ProgramResult twice = run("diff a#.exr b#.exr -o x.####.exr --flip-map x.%04d.exr");
    EXPECT_EQ(twice.exit_code, 2);
    EXPECT_THAT(twice.err, HasSubstr("two outputs are one file"));
    EXPECT_THAT(run("diff a1.exr b1.exr -o link.2.exr").err, HasSubstr("would replace b1.exr"));
    EXPECT_EQ(bytes_of(folder / "a2.exr"), before);
    EXPECT_FALSE(std::filesystem::exists(folder / "x.0001.exr"));
}

TEST_F(CliDiffTest, ColorsThatAreNoNumbersHaveNoFlipAndFail) {
    put_exr("b.exr", 0, 0);
    Image image = changed(0, 0);
    std::vector<float> red(kDiffPixels, 0.25f);
    red[7] = std::numeric_limits<float>::quiet_NaN();
    image.planes.erase("R");
    image.planes["Q"] = red;  // the program writes no such colours, so Q becomes R in the file
    write_exr(folder / "a.exr", image, ColorDepth::float32);
    std::string bytes = bytes_of(folder / "a.exr");
    const size_t name = bytes.find(std::string_view("Q\0\2\0", 4));
    ASSERT_NE(name, std::string::npos);
    bytes[name] = 'R';
    put_bytes(folder / "a.exr", bytes);
    for (const char* option : {"--fail-flip 1", "--flip-map f.exr"}) {
        const ProgramResult result = run(std::string("diff a.exr b.exr ") + option);
        EXPECT_EQ(result.exit_code, 1) << option;
        EXPECT_THAT(result.err, HasSubstr("colours aren't numbers")) << option;
        EXPECT_THAT(result.out, HasSubstr("unmatched")) << option;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "f.exr"));
    EXPECT_THAT(run("diff a.exr b.exr --fail 0").err,
                HasSubstr("1 pixel of R differs where a value isn't finite"));
}

TEST_F(CliDiffTest, FlipNeedsColorsOfBothImages) {
    put_exr("a.exr", 0, 0);
    Image image = changed(0, 0);
    image.planes.erase("B");
    write_exr(folder / "b.exr", image, ColorDepth::float32);
    for (const char* option : {"--fail-flip 0.1", "--flip-map f.exr"}) {
        const ProgramResult result = run(std::string("diff a.exr b.exr ") + option);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.err, HasSubstr("b.exr has no B"));
    }
    write_exr(folder / "z.exr", {kDiffWidth, kDiffHeight, {{"Z", image.planes.at("R")}}, {}, {}});
    EXPECT_THAT(run("diff a.exr z.exr -o d.exr").err, HasSubstr("no channel in common"));
    EXPECT_EQ(run("diff a.exr z.exr").exit_code, 1);
}

TEST_F(CliDiffTest, LimitsAreNumbersFromZeroOn) {
    put_exr("a.exr", 1, 1);
    for (const char* limit : {"nan", "-1", "x", "inf"})
        EXPECT_EQ(run(std::string("diff a.exr a.exr --fail ") + limit).exit_code, 2) << limit;
    EXPECT_EQ(run("diff a.exr a.exr --fail 0").exit_code, 0);
}

TEST_F(CliDiffTest, PartsOfDifferentPlacesArentCompared) {
    Image image = changed(0, 0);
    const auto put = [&](const char* name, glm::ivec2 first, glm::ivec2 frame) {
        image.first = first, image.frame = frame;
        write_exr(folder / name, image, ColorDepth::float32);
    };
    put("whole.exr", {0, 0}, {0, 0});
    put("left.exr", {0, 0}, {90, 25});
    put("right.exr", {50, 0}, {90, 25});
    EXPECT_EQ(run("diff left.exr left.exr --fail 0").exit_code, 0);
    const ProgramResult result = run("diff left.exr right.exr");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, AllOf(HasSubstr("at 0,0 of 90 x 25"), HasSubstr("at 50,0 of 90 x 25")));
    EXPECT_EQ(run("diff left.exr whole.exr").exit_code, 1);
}

TEST_F(CliDiffTest, FramesTellWhatIsMissingOrNotFinite) {
    for (const char* name : {"a1.exr", "a2.exr", "b1.exr"}) put_exr(name, 0, 0);
    Image image = changed(0, 0);
    image.planes.erase("G");
    std::vector<float> depth(kDiffPixels, 1);
    image.planes["Z"] = depth;
    write_exr(folder / "b1.exr", image, ColorDepth::float32);
    depth[3] = depth[4] = std::numeric_limits<float>::infinity();
    image.planes["Z"] = depth;
    write_exr(folder / "b2.exr", image, ColorDepth::float32);
    image.planes["Z"] = std::vector<float>(kDiffPixels, 1);
    write_exr(folder / "a2.exr", image, ColorDepth::float32);
    const Json rows = report_of("a#.exr b#.exr")["frames"];
    EXPECT_EQ(rows[0]["missing"], (Json{"G", "Z"}));
    EXPECT_EQ(rows[0]["only in B"], Json{"Z"});
    EXPECT_EQ(rows[0]["unmatched"], 0);
    EXPECT_EQ(rows[1]["missing"], Json());
    EXPECT_EQ(rows[1]["unmatched"], 2);
    EXPECT_EQ(rows[1]["channels"][2]["unmatched"], 2);
    EXPECT_THAT(run("diff a#.exr b#.exr").out, AllOf(HasSubstr("unmatched"), HasSubstr("G Z")));
}

TEST_F(CliDiffTest, FramesThatCantBeComparedStopNoOthers) {
    for (const int frame : {1, 2, 3, 4}) {
        put_exr(fmt::format("a{}.exr", frame), frame == 4 ? 7 : 0, 0.5f);
        put_exr(fmt::format("b{}.exr", frame), 0, 0);
    }
    std::filesystem::remove(folder / "b2.exr");
    const ProgramResult missing = run("diff a#.exr b#.exr --json -o d#.exr");
    EXPECT_EQ(missing.exit_code, 4);
    EXPECT_EQ(missing.err, "voxelume: b2.exr: no such file\n");
    const Json report = Json::parse(missing.out);
    EXPECT_EQ(report["not compared"], Json{2});
    ASSERT_EQ(report["frames"].size(), 3u);
    EXPECT_EQ(report["frames"][2]["frame"], 4);
    EXPECT_EQ(report["frames"][2]["above"], 7);
    EXPECT_TRUE(std::filesystem::exists(folder / "d4.exr"));
    EXPECT_FALSE(std::filesystem::exists(folder / "d2.exr"));
    put_bytes(folder / "a3.exr", "no image");
    const ProgramResult damaged = run("diff a#.exr b#.exr --fail-above 6 --frames 2-5");
    EXPECT_EQ(damaged.exit_code, 4);
    EXPECT_THAT(damaged.out, AllOf(HasSubstr("worst"), HasSubstr("not compared    2 3 5\n")));
    EXPECT_THAT(damaged.err, AllOf(HasSubstr("b2.exr: no such file; 3 frames can't be compared; "),
                                   HasSubstr("frame 4: 7 of 1000 pixels are above")));
    write_exr(folder / "b2.exr", Image{2, 1, {{"R", {1, 2}}}, {}, {}});
    const ProgramResult other_size = run("diff a#.exr b#.exr --frames 1,2");
    EXPECT_EQ(other_size.exit_code, 1);
    EXPECT_THAT(other_size.out, HasSubstr("not compared    2\n"));
    EXPECT_EQ(run("diff a#.exr b#.exr --frames 5").exit_code, 4);
}

}  // namespace
}  // namespace voxelume
