// SPDX-License-Identifier: Apache-2.0
// The rows of `voxelume bench` in global light: errors, slopes, other programs' rows.
#include "runtime/verify/bench/bench_global.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/verify/bench/bench.hpp"
#include "runtime/verify/report/bench_global_report.hpp"
#include "runtime/verify/report/bench_page.hpp"
#include "runtime/verify/report/bench_tables.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

constexpr const char* kBallOnFloor = R"({
  "voxelume": 1,
  "world": {"voxel_size": 0.1, "bounds": {"min": [-2, -0.2, -2], "max": [2, 2, 2]},
            "sky": {"kind": "constant", "color": [0.5, 0.7, 1]}},
  "models": {"ball": {"shape": "sphere", "radius": 0.6, "surface": "exact"},
             "floor": {"shape": "box", "size": [4, 0.2, 4], "surface": "exact"}},
  "materials": {"clay": {"color": [0.8, 0.5, 0.3]}},
  "objects": [{"model": "ball", "material": "clay", "position": [0, 0.6, 0]},
              {"model": "floor", "position": [0, -0.1, 0]}],
  "observer": {"position": [1, 1.5, 4], "look_at": [0, 0.4, 0],
               "display": {"shape": "pyramid", "angle": 30}},
  "render": {"size": [32, 24], "light": "global", "bounces": 3}
})";

/// A picture of one value in all pixels: once of red, twice of green, four times of blue.
Image even_image(float value) {
    Image image{4, 3, {}, {}, {}};
    image.planes["R"] = std::vector<float>(12, value);
    image.planes["G"] = std::vector<float>(12, 2 * value);
    image.planes["B"] = std::vector<float>(12, 4 * value);
    return image;
}

TEST(RelativeMse, IsTheProductOfBothDifferencesOverTheLightsSquare) {
    const References references = {even_image(0.9F), even_image(1.1F)};
    // The mean light is 7/3, and a hundredth of its square is 49/900.
    double weight = 0;
    for (const double color : {1, 2, 4}) weight += color * color / (color * color + 49.0 / 900) / 3;
    EXPECT_NEAR(relative_mse(even_image(1.5F), references), 0.6 * 0.4 * weight, 1e-7);
    // Between both references the noise of these is what there is, with its sign.
    EXPECT_NEAR(relative_mse(even_image(1), references), -0.1 * 0.1 * weight, 1e-7);
    EXPECT_EQ(relative_mse(even_image(0), {even_image(0), even_image(0)}), 0);
    EXPECT_TRUE(std::isnan(relative_mse(even_image(1), {even_image(0), even_image(0)})));
}

TEST(RelativeMse, HasNothingOfTheReferencesNoise) {
    constexpr unsigned kSeed = 20261129;
    RecordProperty("seed", int(kSeed));
    std::mt19937 random(kSeed);
    constexpr int kSide = 256;
    const auto noisy = [&](double deviation) {
        std::normal_distribution<float> normal(1, float(deviation));
        Image image{kSide, kSide, {}, {}, {}};
        for (const char* color : {"R", "G", "B"}) {
            std::vector<float> values(size_t{kSide} * kSide);
            for (float& value : values) value = normal(random);
            image.planes[color] = std::move(values);
        }
        return image;
    };
    // The references have four times the variance of the picture. The picture's error is 1e-4,
    // divided by 1.01 and a little more for the variance of the references' mean. A product has a
    // standard deviation of 5.1e-4, and the mean of 196,608 of them 1.15e-6, four of which are
    // allowed.
    const References references = {noisy(0.02), noisy(0.02)};
    EXPECT_NEAR(relative_mse(noisy(0.01), references), 1e-4 / 1.01, 4.6e-6);
}

/// The mean squared error over the squared light and a hundredth of its squared mean.
double error_against(const Image& image, const Image& truth) {
    double mean = 0, sum = 0;
    const double count = 3.0 * image.width * image.height;
    for (const char* color : {"R", "G", "B"})
        for (const float value : truth.planes.at(color)) mean += double(value) / count;
    for (const char* color : {"R", "G", "B"})
        for (size_t i = 0; i < truth.planes.at(color).size(); ++i) {
            const double value = truth.planes.at(color)[i];
            sum += std::pow(double(image.planes.at(color)[i]) - value, 2) /
                   (value * value + 0.01 * mean * mean) / count;
        }
    return sum;
}

TEST(GlobalRows, HaveTheErrorAgainstManySamplesOfTheSameScene) {
    const Device device = test_device();
    const Scene scene = parse_scene(kBallOnFloor, "ball.json", {});
    constexpr int kSamples[] = {4, 16};
    int done = 0;
    const std::vector<GlobalRow> rows =
        measure_global(device, {"ball", scene, {}}, kSamples, 0, [&] { ++done; });
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(done, 2);
    Scene truth = scene;
    truth.render.samples = 1024;
    RenderReport report;
    const Image exact = render(device, truth, report);
    for (const GlobalRow& row : rows) {
        EXPECT_EQ(row.scene, "ball");
        EXPECT_GT(row.seconds, 0);
        EXPECT_NEAR(row.light, 1, 0.02);
        Scene few = scene;
        few.render.samples = row.samples;
        const double error = error_against(render(device, few, report), exact);
        // If the references had the picture's own samples, the error would be a fourth too small.
        // The products of two differences over 768 pixels leave noise of about 3 %.
        EXPECT_NEAR(row.relative_mse / error, 1, 0.1) << row.samples << " samples";
    }
}

GlobalRow row_of(const std::string& program, int samples, double error, double seconds) {
    GlobalRow row;
    row.program = program;
    row.scene = "box<1>";
    row.samples = samples;
    row.relative_mse = error;
    row.seconds = seconds;
    return row;
}

/// Ours falls with the samples and takes 10 ms more than in proportion; another takes twice that.
BenchReport report_of_two() {
    BenchReport report;
    for (const int samples : {1, 4, 16})
        report.global_rows.push_back(row_of("", samples, 0.1 / samples, 0.01 * samples));
    for (const int samples : {1, 4, 16})
        report.global_rows.push_back(row_of("Other, 2.0", samples, 0.1 / samples, 0.02 * samples));
    conclude(report);
    return report;
}

TEST(GlobalRows, HaveSlopesAndComparisonsInTextPageAndJson) {
    const BenchReport report = report_of_two();
    ASSERT_EQ(report.global_fits.size(), 2u);
    EXPECT_EQ(report.global_fits[1].program, "Other, 2.0");
    for (const GlobalFit& fit : report.global_fits) {
        EXPECT_NEAR(fit.by_samples.slope, -1, 1e-12);
        EXPECT_NEAR(fit.by_seconds.slope, -1, 1e-12);
        EXPECT_EQ(fit.by_seconds.points, 3u);
    }
    const std::string text = bench_text(report), page = bench_page(report);
    EXPECT_THAT(text, testing::StartsWith("scene "));  // without tables that would be empty
    EXPECT_THAT(text, HasSubstr("box<1>, Other, 2.0: Voxelume is 2 times as quick from 0.1 of "
                                "relative MSE down to 0.0063"));
    EXPECT_THAT(text, HasSubstr("-1.00 +- 0.00 (3 rows)"));
    EXPECT_THAT(page, HasSubstr("box&lt;1&gt;, Other, 2.0: Voxelume is 2 times as quick"));
    for (const char* foreign : {"<script", "http", "box<1>", "nan", "inf"})
        EXPECT_THAT(page, testing::Not(HasSubstr(foreign)));
    const nlohmann::json json = bench_json(report)["global"];
    EXPECT_EQ(json["rows"].size(), 6u);
    EXPECT_EQ(json["fits"][1]["program"], "Other, 2.0");
    EXPECT_NEAR(json["fronts"][0]["pieces"][0]["least_times_of_ours"].get<double>(), 2, 1e-12);
    ASSERT_EQ(global_plots(report).size(), 1u);
    EXPECT_EQ(global_plots(report)[0].series.size(), 2u);
    const std::string csv = bench_csv(report);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
    EXPECT_THAT(csv, HasSubstr("box<1>,\"Other, 2.0\",16,"));
}

class GlobalProgram : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        std::ofstream(folder / "ball.json") << kBallOnFloor;
    }

    std::string measured(const std::string& options) {
        const char* name = std::getenv("VXL_TEST_DEVICE");
        const ProgramResult result =
            run(fmt::format("bench -q --scene ball.json --samples 4,1,4 --repeat 1 {} --device {}",
                            options, name ? name : "cpu"));
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result.out;
    }

    std::string refusal(const std::string& peers) {
        std::ofstream(folder / "peers.json") << peers;
        const ProgramResult result = run("bench -q --scene ball.json --peers peers.json");
        EXPECT_EQ(result.exit_code, 4) << peers;
        return result.err;
    }
};

TEST_F(GlobalProgram, MeasuresPeoplesScenesAlongsideOtherPrograms) {
    // Against references that are nearly its own pictures, ours has hardly an error.
    ASSERT_EQ(
        run("render ball.json -o a.exr --samples 1 -q --channels RGBA --device cpu").exit_code, 0);
    std::ofstream(folder / "peers.json") << R"({"global": {
        "references": {"ball": ["a.exr", "a.exr"], "elsewhere": ["no.exr", "no.exr"]},
        "rows": [{"program": "Other", "scene": "ball", "samples": 9, "relative_mse": 0.5,
                  "seconds": 1e-6},
                 {"program": "Other", "scene": "elsewhere", "samples": 1, "relative_mse": 1,
                  "seconds": 1}]}})";
    const std::string text =
        measured("--peers peers.json --json out.json --csv out.csv -o out.html --plot out.svg");
    const auto rows = nlohmann::json::parse(bytes_of(folder / "out.json"))["global"]["rows"];
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0]["samples"], 1);
    EXPECT_LT(rows[0]["relative_mse"], 1e-6);  // of colours as halves
    EXPECT_EQ(rows[1]["samples"], 4);
    EXPECT_GT(rows[1]["relative_mse"], 1e-3);
    EXPECT_GT(rows[1]["seconds"]["voxelize"], 0);
    EXPECT_EQ(rows[2]["program"], "Other");
    EXPECT_THAT(text, HasSubstr("ball, Other: Other is"));
    EXPECT_THAT(bytes_of(folder / "out.svg"), HasSubstr("noise against the picture"));
    EXPECT_THAT(bytes_of(folder / "out.html"), testing::EndsWith("</html>\n"));
}

TEST_F(GlobalProgram, TakesScenesOfLocalLightInGlobalLightAlongsideNamedOnes) {
    std::string local = kBallOnFloor;
    local.replace(local.find("\"light\": \"global\""), 17, "\"light\": \"local\"");
    std::ofstream(folder / "local.json") << local;
    const ProgramResult result =
        run("bench -q --scene ball.json --scene local.json --size 8x4 --samples 1 --json out.json "
            "--only cornell");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(bytes_of(folder / "out.json"));
    EXPECT_TRUE(json["rows"].empty());
    const auto& rows = json["global"]["rows"];
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0]["scene"], "cornell");
    EXPECT_EQ(rows[1]["scene"], "ball");
    EXPECT_EQ(rows[2]["scene"], "local");
    EXPECT_EQ(rows[1]["relative_mse"], rows[2]["relative_mse"]);
}

TEST_F(GlobalProgram, RefusesWhatItCannotCompareInWords) {
    const std::string start = "voxelume: peers.json: not a file of bench_peers: ";
    EXPECT_EQ(refusal(R"({"global": []})"),
              start + "\"global\" isn't an object with a list of \"rows\"\n");
    EXPECT_EQ(refusal(R"({"global": {"rows": [{}]}})"),
              start + "row 0 of \"global\": there is no \"program\"\n");
    EXPECT_EQ(
        refusal(R"({"global": {"rows": [{"program": "a", "scene": "ball", "samples": 0,
                      "relative_mse": 1, "seconds": 1}]}})"),
        start + "row 0 of \"global\": \"samples\" is 0, not a whole number from 1 to 1000000\n");
    EXPECT_EQ(refusal(R"({"global": {"rows": [], "references": {"ball": "a.exr"}}})"),
              start +
                  "the references of \"ball\": it is a string, not the names of two "
                  "pictures\n");
    EXPECT_THAT(refusal(R"({"global": {"rows": [], "references": {"ball": ["a.exr", "a.exr"]}}})"),
                HasSubstr("a.exr"));
    ASSERT_EQ(run("render ball.json -o a.exr --size 8x4 -q --device cpu").exit_code, 0);
    EXPECT_EQ(refusal(R"({"global": {"rows": [], "references": {"ball": ["a.exr", "a.exr"]}}})"),
              "voxelume: a.exr: has 8 x 4 pixels, and ball is measured with 32 x 24: add --size "
              "8x4\n");
    EXPECT_THAT(refusal(R"({"rows": "oops", "global": {"rows": []}})"),
                HasSubstr("it isn't an object with a \"size\" and a list of \"rows\""));
    EXPECT_EQ(run("bench --scene missing.json").exit_code, 4);
    // A scene's files that can't be read are reported before anything is measured.
    std::ofstream(folder / "bad.obj") << "v 1 2 x\n";
    std::ofstream(folder / "later.json") << R"({"voxelume": 1,
        "world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]}},
        "models": {"bad": {"mesh": "bad.obj"}}, "objects": [{"model": "bad"}],
        "observer": {"position": [0, 0, 3], "look_at": [0, 0, 0],
                     "display": {"shape": "pyramid", "angle": 40}}})";
    const ProgramResult bad = run("bench --scene ball.json --scene later.json --samples 1");
    EXPECT_EQ(bad.exit_code, 4);
    EXPECT_THAT(bad.err, HasSubstr("bad.obj:1"));
    EXPECT_THAT(bad.err, testing::Not(HasSubstr("1/2")));
    const ProgramResult twice = run("bench --scene ball.json --scene ./ball.json");
    EXPECT_EQ(twice.exit_code, 2);
    EXPECT_THAT(twice.err, HasSubstr("two scenes are named \"ball\""));
    std::filesystem::copy(folder / "ball.json", folder / "cornell.json");
    const ProgramResult known = run("bench --scene cornell.json --only cornell");
    EXPECT_EQ(known.exit_code, 2);
    EXPECT_THAT(known.err, HasSubstr("two scenes are named \"cornell\""));
}

}  // namespace
}  // namespace voxelume
