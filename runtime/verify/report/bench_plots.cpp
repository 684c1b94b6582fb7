// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/report/bench_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>

#include "runtime/verify/report/bench_global_report.hpp"

namespace voxelume {
namespace {

/// The colours of a surface's curves. Instances are paler.
struct CurveColors {
    const char* world;
    const char* instance;
};

/// One row for each of kSurfaceKinds, in their order.
constexpr auto kCurveColors = std::to_array<CurveColors>({
    {"#b35900", "#e0a060"},  // cubes
    {"#1f6fb4", "#7fb2e0"},  // smooth
    {"#2e8540", "#86c795"},  // exact
});
static_assert(kCurveColors.size() == kSurfaceKinds.size());

const char* color_of(Surface surface, Placement placement) {
    const CurveColors& colors = kCurveColors[size_t(surface)];
    return placement == Placement::instance ? colors.instance : colors.world;
}

std::string curve_name(Surface surface, Placement placement) {
    const std::string name(name_of(surface));
    return placement == Placement::instance ? name + ", instance" : name;
}

using Value = std::function<double(const BenchRow&)>;
using Choice = std::function<bool(const BenchRow&)>;

bool has_one_sample(const BenchRow& row) {
    return row.samples == 1;
}

/// One curve of the chosen rows for every surface and placement. Curves without points are left
/// out.
std::vector<PlotSeries> curves(const BenchReport& report, const std::string& scene, const Value& x,
                               const Value& y, const Choice& is_shown = has_one_sample) {
    std::vector<PlotSeries> all;
    for (const BenchFit& fit : report.fits) {
        if (fit.scene != scene) continue;
        PlotSeries series;
        series.name = curve_name(fit.surface, fit.placement);
        series.color = color_of(fit.surface, fit.placement);
        for (const BenchRow& row : report.rows) {
            if (row.scene != scene || row.surface != fit.surface ||
                row.placement != fit.placement || !is_shown(row))
                continue;
            series.points.emplace_back(x(row), y(row));
            series.marked.push_back(false);
        }
        if (!series.points.empty()) all.push_back(series);
    }
    return all;
}

double voxel_size_of(const BenchRow& row) {
    return row.voxel_size;
}

double depth_of(const BenchRow& row) {
    return row.errors.depth_rms;
}

/// Adds the fitted lines, dashed, with slopes and their intervals in the curves' names.
void add_fits(LogPlot& plot, const BenchReport& report, const std::string& scene,
              SlopeFit BenchFit::*fit) {
    for (const BenchFit& fitted : report.fits) {
        const SlopeFit& slope = fitted.*fit;
        const std::string name = curve_name(fitted.surface, fitted.placement);
        const auto curve = std::ranges::find(plot.series, name, &PlotSeries::name);
        if (fitted.scene != scene || slope.points < 2 || curve == plot.series.end()) continue;
        PlotSeries line;
        line.color = color_of(fitted.surface, fitted.placement);
        line.is_dashed = true;
        for (const glm::dvec2& p : curve->points)
            line.points.emplace_back(p.x, std::exp(slope.intercept) * std::pow(p.x, slope.slope));
        curve->name += std::isfinite(slope.half_width)
                           ? fmt::format(" ({:.2f} \u00b1 {:.2f})", slope.slope, slope.half_width)
                           : fmt::format(" ({:.2f})", slope.slope);
        plot.series.push_back(line);
    }
}

LogPlot size_plot(const BenchReport& report, const std::string& scene, const char* title,
                  const char* label, const Value& error) {
    return {scene + ": " + title, "voxel size, m", label,
            curves(report, scene, voxel_size_of, error)};
}

LogPlot fitted_plot(const BenchReport& report, const std::string& scene, const char* title,
                    const char* label, const Value& error, SlopeFit BenchFit::*fit) {
    LogPlot plot = size_plot(report, scene, title, label, error);
    add_fits(plot, report, scene, fit);
    return plot;
}

/// Adds one curve for every other program.
void add_peers(LogPlot& plot, const BenchReport& report, const std::string& scene) {
    constexpr std::array kColors = {"#8e44ad", "#777", "#c0392b"};
    size_t color = 0;
    std::map<std::string, size_t> curve_of;
    for (const BenchPeerRow& peer : report.peers) {
        if (peer.scene != scene) continue;
        const auto [curve, is_new] = curve_of.try_emplace(peer.program, plot.series.size());
        if (is_new)
            plot.series.push_back({peer.program, kColors[color++ % kColors.size()], {}, {}, false});
        plot.series[curve->second].points.emplace_back(peer.total_seconds(), peer.depth_rms);
    }
}

/// A plot of an error of colours against time: the finest voxels, with one ray per pixel and more.
LogPlot light_plot(const BenchReport& report, const std::string& scene, const char* title,
                   const char* label, const Value& error) {
    int finest = 0;
    for (const BenchRow& row : report.rows)
        if (row.scene == scene) finest = std::max(finest, row.resolution);
    const Value seconds = [](const BenchRow& row) { return row.seconds.total; };
    return {scene + ": " + title, "model to image, s", label,
            curves(report, scene, seconds, error,
                   [&](const BenchRow& row) { return row.resolution == finest; })};
}

bool has_light(const BenchReport& report, const std::string& scene) {
    return std::ranges::any_of(report.rows, [&](const BenchRow& row) {
        return row.scene == scene && row.errors.flip > 0;
    });
}

}  // namespace

LogPlot time_plot(const BenchReport& report, const std::string& scene) {
    const Value seconds = [](const BenchRow& row) { return row.seconds.total; };
    LogPlot plot{scene + ": depth against total time", "model to image, s", "depth RMS, m",
                 curves(report, scene, seconds, depth_of)};
    for (const BenchRow& row : report.rows) {
        if (row.scene != scene || !row.is_best) continue;
        for (PlotSeries& series : plot.series) {
            const auto point = std::ranges::find(
                series.points, glm::dvec2(row.seconds.total, row.errors.depth_rms));
            if (point != series.points.end())
                series.marked[size_t(point - series.points.begin())] = true;
        }
    }
    add_peers(plot, report, scene);
    return plot;
}

std::vector<LogPlot> plots_of(const BenchReport& report, const std::string& scene) {
    const Value normal = [](const BenchRow& row) { return row.errors.normal_rms; };
    const Value outline = [](const BenchRow& row) { return row.errors.silhouette_mean; };
    const Value volume = [](const BenchRow& row) { return std::abs(row.volume_error); };
    const Value area = [](const BenchRow& row) { return std::abs(row.area_error); };
    const Value shadow = [](const BenchRow& row) { return row.shadow.mean; };
    const Value color = [](const BenchRow& row) { return row.errors.color_rmse; };
    const Value flip = [](const BenchRow& row) { return row.errors.flip; };
    const Value kernels = [](const BenchRow& row) { return row.seconds.kernels; };
    std::vector<LogPlot> plots = {
        time_plot(report, scene),
        fitted_plot(report, scene, "depth against voxel size", "depth RMS, m", depth_of,
                    &BenchFit::depth),
        fitted_plot(report, scene, "normals against voxel size", "normal RMS, degrees", normal,
                    &BenchFit::normal),
        size_plot(report, scene, "outline against voxel size (zeros left out)",
                  "mean displacement, pixels", outline),
        {scene + ": depth against kernels' time", "kernels on the device, s", "depth RMS, m",
         curves(report, scene, kernels, depth_of)}};
    if (has_light(report, scene)) {
        plots.push_back(light_plot(report, scene, "colour, 1 ray a pixel and more, finest voxels",
                                   "RMSE of R, G and B", color));
        plots.push_back(light_plot(report, scene, "FLIP, 1 ray a pixel and more, finest voxels",
                                   "mean FLIP", flip));
        return plots;
    }
    plots.push_back(fitted_plot(report, scene, "volume against voxel size",
                                "relative error of volume", volume, &BenchFit::volume));
    plots.push_back(fitted_plot(report, scene, "area against voxel size", "relative error of area",
                                area, &BenchFit::area));
    plots.push_back(size_plot(report, scene, "shadow edge against voxel size (zeros left out)",
                              "mean displacement, pixels", shadow));
    std::erase_if(plots, [](const LogPlot& plot) { return !has_points(plot); });
    return plots;
}

std::vector<std::string> scenes_of(const BenchReport& report) {
    std::vector<std::string> scenes;
    for (const BenchRow& row : report.rows)
        if (scenes.empty() || scenes.back() != row.scene) scenes.push_back(row.scene);
    return scenes;
}

std::string bench_picture(const BenchReport& report) {
    std::vector<LogPlot> plots;
    for (const std::string& scene : scenes_of(report)) {
        const bool is_shown =
            std::ranges::find(report.peers, scene, &BenchPeerRow::scene) != report.peers.end();
        if (report.peers.empty() ? !has_light(report, scene) : is_shown)
            plots.push_back(time_plot(report, scene));
    }
    std::ranges::move(global_plots(report), std::back_inserter(plots));
    return svg_file(plots);
}

}  // namespace voxelume
