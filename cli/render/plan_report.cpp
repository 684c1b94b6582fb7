// SPDX-License-Identifier: Apache-2.0
// Prints what rendering a scene takes, for people and programs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "cli/shared/progress.hpp"
#include "cli/shared/report.hpp"
#include "cli/shared/scene_options.hpp"
#include "cli/shared/warnings.hpp"
#include "runtime/base/json_text.hpp"

namespace voxelume::cli {
namespace {

/// Rounds to three digits, the precision of an estimate.
double three_digits(double value) {
    return std::stod(fmt::format("{:.3g}", value));
}

double megabytes(double bytes) {
    return three_digits(bytes / 1e6);
}

uint64_t count(double estimate) {
    return uint64_t(std::llround(estimate));
}

/// The edges of voxels in metres; one number if they are equal.
std::string edges_text(const std::array<double, 3>& size) {
    const bool is_cube = size[0] == size[1] && size[1] == size[2];
    return is_cube ? fmt::format("{:.4g}", size[0])
                   : fmt::format("{:.4g}x{:.4g}x{:.4g}", size[0], size[1], size[2]);
}

Report grid_row(const GridPlan& grid) {
    Report row = {{"grid", grid.name},
                  {"voxels", fmt::format("{}", fmt::join(grid.size, "x"))},
                  {"edge", edges_text(grid.voxel_size)},
                  {"instances", grid.instances},
                  {"triangles", nullptr},
                  {"surface voxels", count(grid.surface_voxels)},
                  {"bricks", count(grid.bricks)},
                  {"MB while made", megabytes(grid.made_bytes)},
                  {"MB kept", megabytes(grid.kept_bytes)}};
    if (grid.triangles) row["triangles"] = *grid.triangles;
    return row;
}

Report surface_rows(const Plan& plan) {
    Report rows = Report::array();
    for (const SurfacePlan& surface : plan.surfaces)
        rows.push_back(
            {{"model", surface.model}, {"surface", surface.surface}, {"because", surface.reason}});
    return rows;
}

Report plan_report(const Plan& plan) {
    Report report;
    if (!plan.surfaces.empty()) report["surfaces"] = surface_rows(plan);
    report["grids"] = Report::array();
    for (const GridPlan& grid : plan.grids) report["grids"].push_back(grid_row(grid));
    report["device"] = plan.device;
    report["stages"] = Report::array();
    for (const StagePlan& stage : plan.stages)
        report["stages"].push_back(
            {{"stage", stage.name},
             {"MB", megabytes(stage.bytes)},
             {"% of device", three_digits(stage.bytes / plan.device_bytes * 100)}});
    if (plan.views_bytes > 0) report["views"] = bytes_text(plan.views_bytes);
    report["largest buffer"] = bytes_text(plan.largest_buffer_bytes);
    report["main memory"] = bytes_text(plan.host_bytes);
    report["whole process"] = bytes_text(plan.process_bytes);
    return report;
}

/// Adds the verdict at the end of the text, for programs.
void add_verdict(const Plan& plan, Report& report) {
    report["verdict"] = name_of(plan.verdict);
    report["least MB"] = megabytes(plan.min_bytes);
    report["most MB"] = megabytes(plan.max_bytes);
    report["device MB"] = megabytes(plan.device_bytes);
    report["process MB"] = megabytes(plan.process_bytes);
    report["bands"] = plan.bands;
    report["warnings"] = Report::array();
    for (const Warning& warning : plan.warnings)
        report["warnings"].push_back(
            {{"kind", name_of(warning.kind)}, {"where", warning.where}, {"text", warning.text}});
}

/// Prints the values that the scene leaves out, in a form to copy into the scene.
void print_fitted(const Scene& scene) {
    if (scene.has_default_light())
        fmt::print(
            "The scene has no \"lights\", so one shines from the observer's upper left.\n\n");
    if (scene.fitted().empty()) return;
    fmt::print("What the scene leaves out was found from its objects. To keep it, copy:\n");
    std::istringstream lines(scene.fitted());
    for (std::string line; std::getline(lines, line);) fmt::print("  {}\n", line);
    fmt::print("\n");
}

/// Returns the fitted values as a JSON object, for programs.
Report fitted_report(const Scene& scene) {
    std::string text = scene.fitted();
    if (!text.empty()) text.pop_back();
    std::ranges::replace(text, '\n', ',');
    return parse_json_text<Report>("{" + text + "}");
}

/// The maximum bytes on the device if the stage `shown` replaced the output stages that are asked
/// for.
double bytes_with(const Plan& plan, std::string_view shown) {
    double bytes = 0;
    for (const StagePlan& stage : plan.stages)
        if (stage.name == shown || (stage.name != "image" && stage.name != "volume"))
            bytes = std::max(bytes, stage.bytes);
    return bytes;
}

/// Prints what a volumetric image takes, if it takes more than the image.
void print_volume(const Plan& plan) {
    const double bytes = bytes_with(plan, "volume");
    if (bytes > plan.max_bytes)
        fmt::print("a volumetric image of its display needs at most {}\n", bytes_text(bytes));
}

void print_verdict(const Plan& plan, size_t frames) {
    if (plan.bands > 1)
        fmt::print("\n{} is rendered in {} bands of {} rows, as memory doesn't suffice for it\n",
                   frames > 1 ? "each image" : "the image", plan.bands, plan.band_rows);
    const std::string of_frames = frames > 1 ? fmt::format(" by frame {}", plan.frame) : "";
    const std::string chosen =
        plan.chosen_frames > 0
            ? fmt::format(" for {} frames, chosen from {}", plan.chosen_frames, frames)
            : "";
    const std::string needed = plan.verdict == Verdict::fits
                                   ? fmt::format("fits: at most {}", bytes_text(plan.max_bytes))
                                   : fmt::format("may fit: {} to {}", bytes_text(plan.min_bytes),
                                                 bytes_text(plan.max_bytes));
    fmt::print("\n{} of {} are needed{}; counts and memory are estimates{}\n", needed,
               bytes_text(plan.device_bytes), of_frames, chosen);
}

/// Plans a scene, and shows a bar to a person, because many frames take long.
Plan watched_plan(const Scene& scene, const std::string& selector, PlanOptions options,
                  bool is_quiet) {
    std::optional<Progress> bar;
    size_t told = 0;
    options.progress = [&](size_t done, size_t frames) {
        if (frames == 1) return;
        if (!bar)
            bar.emplace("check", frames, stderr,
                        is_quiet ? Drawing::never : Drawing::where_watched);
        bar->advance(done - told);
        told = done;
    };
    return voxelume::plan(scene, selector, options);
}

}  // namespace

void print_plan(const Scene& scene, const std::string& selector, const PlanOptions& options,
                const PlanPrint& print) {
    const Plan plan = watched_plan(scene, selector, options, print.quiet);
    tell_warnings(plan.warnings, print.quiet, print.strict);
    const bool as_json = print.as_json;
    if (!as_json) {
        fmt::print("{}\n", scene.describe());
        print_fitted(scene);
    }
    Report report = plan_report(plan);
    if (scene.moves()) report["frame"] = plan.frame;
    if (plan.chosen_frames > 0) report["chosen frames"] = plan.chosen_frames;
    if (as_json) {
        if (!scene.fitted().empty()) report["fitted"] = fitted_report(scene);
        add_verdict(plan, report);
    }
    print_report(report, as_json);
    if (plan.refusal) throw *plan.refusal;
    if (as_json) return;
    const size_t frames =
        options.frames.empty() ? size_t(scene.moves() ? scene.frames() : 1) : options.frames.size();
    print_verdict(plan, frames);
    if (print.tells_volume && frames == 1) print_volume(plan);
}

}  // namespace voxelume::cli
