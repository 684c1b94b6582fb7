// SPDX-License-Identifier: Apache-2.0
// The results of `voxelume bench`: errors, fits and fronts, the files it writes.
#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <random>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/verify/bench/bench.hpp"
#include "runtime/verify/report/bench_page.hpp"
#include "runtime/verify/report/log_plot.hpp"
#include "tests/support/program_runner.hpp"

namespace voxelume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(BenchErrors, AreThoseThatWerePutIn) {
    const BenchTruth truth = bench_truth(subject_of(bench_solids()[0]), {40, 30});
    Image image;
    for (const char* name : {"A", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"})
        image.planes[name] = std::vector<float>(40 * 30);
    const auto put = [&](const char* plane, size_t pixel, const glm::dvec3& v) {
        for (int axis = 0; axis < 3; ++axis)
            image.planes[std::string(plane) + "." + "XYZ"[axis]][pixel] = float(v[axis]);
    };
    for (size_t i = 0; i < truth.hits.size(); ++i) {
        if (!truth.hits[i]) continue;
        const glm::dvec3 normal = truth.hits[i]->normal;
        const glm::dvec3 across = glm::normalize(glm::cross(normal, glm::dvec3(0.1, 1, 0.2)));
        image.planes["A"][i] = 1;
        put("P", i, truth.eye + (truth.hits[i]->t + 0.01) * truth.directions[i]);
        put("N", i, std::cos(0.02) * normal + std::sin(0.02) * across);
    }
    const BenchErrors errors = measure_errors(truth, image, 0.1);
    EXPECT_GT(errors.compared, 300u);
    EXPECT_NEAR(errors.depth_rms, 0.01, 1e-6);
    EXPECT_NEAR(errors.depth_max, 0.01, 1e-6);
    EXPECT_NEAR(errors.normal_rms, 0.02 * 180 / 3.14159265358979, 1e-4);
    EXPECT_EQ(errors.silhouette_mean, 0);
    EXPECT_EQ(errors.silhouette_max, 0);
    image.planes["A"][0] = 1;  // the corner, far from the sphere's circle
    const BenchErrors stray = measure_errors(truth, image, 0.1);
    EXPECT_NEAR(stray.silhouette_mean, 1 / truth.silhouette.length, 1e-15);
    EXPECT_GT(stray.silhouette_max, 10);
    EXPECT_EQ(stray.compared, errors.compared);
}

TEST(Convergence, FindsTheSlopeOfAPowerAndItsInterval) {
    const std::vector<double> x = {1, 2, 4, 8, 16};
    std::vector<double> y;
    for (const double at : x) y.push_back(0.3 * at * at * at);
    const SlopeFit exact = fit_slope(x, y);
    EXPECT_EQ(exact.points, 5u);
    EXPECT_NEAR(exact.slope, 3, 1e-14);
    EXPECT_NEAR(std::exp(exact.intercept), 0.3, 1e-14);
    EXPECT_NEAR(exact.half_width, 0, 1e-13);
    // Computed by hand: u = 0 1 2, v = 0 2 1 (in units of ln 2): slope 1/2, residuals -1/2 1 -1/2,
    // so the standard error is sqrt(1.5 / 1 / 2), and t of one degree of freedom is 12.7062.
    const SlopeFit rough = fit_slope(std::vector<double>{1, 2, 4}, std::vector<double>{1, 4, 2});
    EXPECT_NEAR(rough.slope, 0.5, 1e-15);
    EXPECT_NEAR(rough.half_width, 12.7062 * std::sqrt(0.75), 1e-12);
}

TEST(Convergence, LeavesOutWhatHasNoLogarithmAndNeedsThreePointsForAnInterval) {
    const SlopeFit two = fit_slope(std::vector<double>{1, 2, 4}, std::vector<double>{1, 0, 16});
    EXPECT_EQ(two.points, 2u);
    EXPECT_NEAR(two.slope, 2, 1e-15);
    EXPECT_TRUE(std::isinf(two.half_width));
    EXPECT_EQ(fit_slope(std::vector<double>{3}, std::vector<double>{7}).slope, 0);
    EXPECT_EQ(fit_slope(std::vector<double>{3, 3}, std::vector<double>{7, 8}).slope, 0);
}

TEST(Convergence, TheFrontHoldsWhatNothingBeats) {
    const std::vector<double> seconds = {5, 1, 2, 2, 3, 4, 4};
    const std::vector<double> errors = {1, 9, 7, 8, 7, 2, 2};
    EXPECT_THAT(pareto_front(seconds, errors), ElementsAre(1, 2, 5, 6, 0));
}

BenchRow row_of(Surface surface, int resolution, double depth, double seconds) {
    BenchRow row;
    row.scene = "sphere";
    row.surface = surface;
    row.resolution = resolution;
    row.voxel_size = 1.0 / resolution;
    row.min_radius = 0.5;
    row.seconds.total = seconds;
    row.errors.compared = 1;
    row.errors.depth_rms = depth;
    row.errors.normal_rms = 1;
    return row;
}

TEST(BenchReport, FitsSmoothOnlyWhereItIsNeitherTooCoarseNorAtItsFloor) {
    BenchReport report;
    report.rows = {row_of(Surface::smooth, 4, 9, 4),  // 2 voxels to the radius
                   row_of(Surface::smooth, 8, 1e-3, 3), row_of(Surface::smooth, 16, 1.25e-4, 2),
                   row_of(Surface::smooth, 32, 4e-6, 1),  // 1.28e-4 voxel: the rounding's share
                   row_of(Surface::cubes, 4, 1, 5)};
    conclude(report);
    ASSERT_EQ(report.fits.size(), 2u);
    EXPECT_EQ(report.fits[0].surface, Surface::smooth);
    EXPECT_EQ(report.fits[0].depth.points, 2u);
    EXPECT_NEAR(report.fits[0].depth.slope, 3, 1e-14);
    EXPECT_EQ(report.fits[0].normal.points, 3u);
    EXPECT_EQ(report.fits[0].volume.points, 0u);
    EXPECT_EQ(report.fits[1].depth.points, 1u);
    EXPECT_TRUE(report.rows[3].is_best);
    EXPECT_FALSE(report.rows[1].is_best);
}

TEST(BenchReport, ThePageNeedsNothingElseAndTakesNoTextForTags) {
    BenchReport report;
    report.device = "<script>\"A&B\"";
    report.rows = {row_of(Surface::smooth, 8, 1e-3, 3), row_of(Surface::smooth, 16, 0, 2)};
    conclude(report);
    const std::string page = bench_page(report);
    EXPECT_THAT(page, HasSubstr("&lt;script&gt;&quot;A&amp;B&quot;"));
    for (const char* foreign : {"<script", "http", "url(", "src=", "nan", "inf"})
        EXPECT_THAT(page, Not(HasSubstr(foreign)));
}

class BenchProgram : public ProgramTest {
  protected:
    static std::string device_option() {
        const char* name = std::getenv("VXL_TEST_DEVICE");
        return fmt::format(" --device '{}'", name ? name : "cpu");
    }
};

TEST_F(BenchProgram, WritesATableAPageAndFilesThatParse) {
    const ProgramResult result =
        run("bench -q --only box --resolution 16,8 --size 40x30 --repeat 1 -o out.html "
            "--json out.json --csv out.csv --plot out.svg" +
            device_option());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("Pareto"));
    const auto json = nlohmann::json::parse(bytes_of(folder / "out.json"));
    ASSERT_EQ(json["rows"].size(), 12u);
    EXPECT_EQ(json["rows"][0]["voxels_per_metre"], 8);
    EXPECT_EQ(json["rows"][1]["placement"], "world");
    for (const size_t number : {9, 11}) {
        const auto& row = json["rows"][number];
        EXPECT_EQ(row["surface"], "exact");
        EXPECT_EQ(row["placement"], number == 9 ? "world" : "instance");
        EXPECT_LT(row["depth_rms_metres"], 1e-6);
        EXPECT_GT(row["compared_pixels"], 200);
        EXPECT_GT(row["peak_device_bytes"], 0);
        EXPECT_GT(row["seconds"]["kernels"], 0);
        EXPECT_NEAR(row["volume_error"], 0, 1e-6);
        EXPECT_NEAR(row["area_error"], 0, 1e-6);
        EXPECT_LT(row["shadow_mean_pixels"], 0.05);
    }
    EXPECT_EQ(json["fits"].size(), 6u);
    EXPECT_TRUE(json["fits"][0]["depth"]["half_width_95"].is_null());
    const std::string csv = bytes_of(folder / "out.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
    EXPECT_THAT(csv, testing::StartsWith("scene,surface,placement,samples,voxels_per_metre,"));
    const size_t line = csv.find('\n') + 1;
    EXPECT_EQ(std::count(csv.begin(), csv.begin() + long(line), ','),
              std::count(csv.begin() + long(line), csv.begin() + long(csv.find('\n', line)), ','));
    const std::string page = bytes_of(folder / "out.html");
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, testing::EndsWith("</html>\n"));
    EXPECT_THAT(bytes_of(folder / "out.svg"), testing::StartsWith("<svg xmlns="));
}

TEST_F(BenchProgram, TakesScenesWithCommasEachOnce) {
    const ProgramResult result =
        run("bench -q --only torus,box --only box --resolution 8 --placement world --size 12x9 "
            "--repeat 1 --json out.json" +
            device_option());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(bytes_of(folder / "out.json"));
    ASSERT_EQ(json["rows"].size(), 6u);
    EXPECT_EQ(json["rows"][0]["scene"], "torus");
    EXPECT_EQ(json["rows"][3]["scene"], "box");
}

TEST_F(BenchProgram, RefusesWhatItCannotDoBeforeItMeasures) {
    const ProgramResult name = run("bench --only spere");
    EXPECT_EQ(name.exit_code, 2);
    EXPECT_EQ(name.err,
              "voxelume: bench: there is no scene named \"spere\"; did you mean \"sphere\"?\n");
    const ProgramResult names = run("bench --only box,sphere,tours");
    EXPECT_EQ(names.exit_code, 2);
    EXPECT_THAT(names.err, HasSubstr("no scene named \"tours\"; did you mean \"torus\"?"));
    EXPECT_EQ(run("bench -o report.pdf").exit_code, 2);
    EXPECT_EQ(run("bench --json a --csv a").exit_code, 2);
    EXPECT_EQ(run("bench --resolution 3").exit_code, 2);
    const ProgramResult nothing = run("bench --only whitted,sphere --resolution 4");
    EXPECT_EQ(nothing.exit_code, 2);
    EXPECT_THAT(nothing.err, HasSubstr("sphere has no row"));
    EXPECT_EQ(run("bench --placement both").exit_code, 2);
    for (const auto& [options, sentence] :
         {std::pair("--placement worl",
                    "--placement: \"worl\" isn't one; give world, instance, or world,instance"),
          std::pair(
              "--samples 4,,1",
              "--samples: \"4,,1\" has an empty value next to a comma; give numbers like 1,4,16"),
          std::pair("--samples 4,x",
                    "--samples: \"x\" isn't a whole number from 1 to 4096 in "
                    "digits; give numbers like 1,4,16"),
          std::pair("--resolution 16,",
                    "--resolution: \"16,\" has an empty value next to a comma; give "
                    "numbers like 16,32,64")}) {
        const ProgramResult refused = run(std::string("bench ") + options);
        EXPECT_EQ(refused.exit_code, 2) << options;
        EXPECT_EQ(refused.err,
                  fmt::format("voxelume: bench: {}; see `voxelume help bench`\n", sentence));
    }
    EXPECT_EQ(run("bench --plot report.png").exit_code, 2);
    EXPECT_EQ(run("bench --csv missing/a.csv").exit_code, 5);
    EXPECT_THAT(run("help bench").out, HasSubstr("radius 0.47 m"));
}

}  // namespace
}  // namespace voxelume
