#include "runtime/bench/bench_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "runtime/bench/bench_tables.hpp"
#include "runtime/bench/log_plot.hpp"

namespace voxelume {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.45 system-ui,sans-serif;color:#222;background:#fff;max-width:1480px;"
    "margin:1.5em auto;padding:0 1em}"
    "h1{font-size:1.5em}h2{font-size:1.2em;margin-top:1.6em}"
    ".plots{display:flex;flex-wrap:wrap;gap:8px}"
    "svg{width:460px;max-width:100%;height:auto}"
    "svg text{font:11px system-ui,sans-serif;fill:#333}svg .title{font-size:13px;font-weight:600}"
    "svg .grid{stroke:#ddd}svg rect{fill:none;stroke:#888}"
    "svg polyline{fill:none;stroke-width:1.5}svg .mark{fill:none;stroke:#111;stroke-width:1.5}"
    ".rows{overflow-x:auto}"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums}"
    "td,th{padding:2px 9px;text-align:right;border-bottom:1px solid #e4e4e4;white-space:nowrap}"
    "td:nth-child(-n+2),th:nth-child(-n+2){text-align:left}"
    "dt{float:left;width:6em;color:#666}dd{margin-left:6.5em}";

const char* color_of(Surface surface) {
    switch (surface) {
        case Surface::cubes:
            return "#b35900";
        case Surface::smooth:
            return "#1f6fb4";
        case Surface::exact:
            return "#2e8540";
    }
    return "#000";
}

using Value = std::function<double(const BenchRow&)>;

/// One curve a surface, of the rows with that many rays a pixel.
std::vector<PlotSeries> curves(const BenchReport& report, const std::string& scene, const Value& x,
                               const Value& y, int samples = 1) {
    std::vector<PlotSeries> all;
    for (const Surface surface : kBenchSurfaces) {
        PlotSeries series;
        series.name = name_of(surface);
        series.color = color_of(surface);
        for (const BenchRow& row : report.rows)
            if (row.scene == scene && row.surface == surface && row.samples == samples)
                series.points.emplace_back(x(row), y(row));
        all.push_back(series);
    }
    return all;
}

double size_of(const BenchRow& row) {
    return row.voxel_size;
}

double depth_of(const BenchRow& row) {
    return row.errors.depth_rms;
}

/// The fitted lines, dashed, with their slopes in the curves' names.
void add_fits(LogPlot& plot, const BenchReport& report, const std::string& scene,
              SlopeFit BenchFit::*fit) {
    for (const BenchFit& fitted : report.fits) {
        const SlopeFit& slope = fitted.*fit;
        const auto curve =
            std::ranges::find(plot.series, name_of(fitted.surface), &PlotSeries::name);
        if (fitted.scene != scene || slope.points < 2 || curve == plot.series.end()) continue;
        PlotSeries line;
        line.color = color_of(fitted.surface);
        line.is_dashed = true;
        for (const glm::dvec2& p : curve->points)
            line.points.emplace_back(p.x, std::exp(slope.intercept) * std::pow(p.x, slope.slope));
        curve->name += fmt::format(" ({:.2f})", slope.slope);
        plot.series.push_back(line);
    }
}

LogPlot depth_plot(const BenchReport& report, const std::string& scene) {
    LogPlot plot{scene + ": depth against voxel size", "voxel size, m", "depth RMS, m",
                 curves(report, scene, size_of, depth_of)};
    add_fits(plot, report, scene, &BenchFit::depth);
    return plot;
}

LogPlot normal_plot(const BenchReport& report, const std::string& scene) {
    const Value normal = [](const BenchRow& row) { return row.errors.normal_rms; };
    LogPlot plot{scene + ": normals against voxel size", "voxel size, m", "normal RMS, degrees",
                 curves(report, scene, size_of, normal)};
    add_fits(plot, report, scene, &BenchFit::normal);
    return plot;
}

/// One curve for every other program.
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

/// With rings around the rows that nothing beats in total time.
LogPlot time_plot(const BenchReport& report, const std::string& scene) {
    const Value seconds = [](const BenchRow& row) { return row.seconds.total; };
    LogPlot plot{scene + ": depth against total time", "model to image, s", "depth RMS, m",
                 curves(report, scene, seconds, depth_of)};
    for (PlotSeries& series : plot.series)
        for (const BenchRow& row : report.rows)
            if (row.scene == scene && name_of(row.surface) == series.name && row.samples == 1)
                series.marked.push_back(row.is_best);
    add_peers(plot, report, scene);
    return plot;
}

LogPlot kernel_plot(const BenchReport& report, const std::string& scene) {
    const Value seconds = [](const BenchRow& row) { return row.seconds.kernels; };
    return {scene + ": depth against kernels' time", "kernels on the device, s", "depth RMS, m",
            curves(report, scene, seconds, depth_of)};
}

LogPlot outline_plot(const BenchReport& report, const std::string& scene) {
    const Value outline = [](const BenchRow& row) { return row.errors.silhouette_mean; };
    return {scene + ": outline against voxel size (zeros left out)", "voxel size, m",
            "mean displacement, pixels", curves(report, scene, size_of, outline)};
}

/// Against the rays of a pixel: the finest voxels of each surface.
LogPlot light_plot(const BenchReport& report, const std::string& scene, const char* title,
                   const char* label, const Value& error) {
    LogPlot plot{scene + ": " + title, "model to image, s", label, {}};
    for (const Surface surface : kBenchSurfaces) {
        PlotSeries series{name_of(surface), color_of(surface), {}, {}, false};
        int finest = 0;
        for (const BenchRow& row : report.rows)
            if (row.scene == scene && row.surface == surface)
                finest = std::max(finest, row.resolution);
        for (const BenchRow& row : report.rows)
            if (row.scene == scene && row.surface == surface && row.resolution == finest)
                series.points.emplace_back(row.seconds.total, error(row));
        plot.series.push_back(series);
    }
    return plot;
}

bool has_light(const BenchReport& report, const std::string& scene) {
    return std::ranges::any_of(report.rows, [&](const BenchRow& row) {
        return row.scene == scene && row.errors.flip > 0;
    });
}

std::string light_plots(const BenchReport& report, const std::string& scene) {
    if (!has_light(report, scene)) return {};
    const Value color = [](const BenchRow& row) { return row.errors.color_rmse; };
    const Value flip = [](const BenchRow& row) { return row.errors.flip; };
    return svg_of(light_plot(report, scene, "colour, 1 ray a pixel and more, finest voxels",
                             "RMSE of R, G and B", color)) +
           svg_of(light_plot(report, scene, "FLIP, 1 ray a pixel and more, finest voxels",
                             "mean FLIP", flip));
}

std::string heading(const BenchReport& report) {
    std::string html = "<dl>\n";
    const std::pair<const char*, std::string> lines[] = {
        {"Voxelume", report.version},
        {"Machine", report.machine},
        {"Device", fmt::format("{}, {} lanes", report.device, report.lanes)},
        {"Driver", fmt::format("{}; {}", report.driver, report.platform)},
        {"Time", report.time},
        {"Images", fmt::format("{} x {} pixels; times are those of the fastest of {} "
                               "renders after one that compiles",
                               report.size.x, report.size.y, report.repeats)}};
    for (const auto& [name, value] : lines)
        html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escape_html(value));
    return html + "</dl>\n";
}

std::string slopes(const BenchReport& report) {
    std::string html =
        "<h2>Convergence</h2>\n<p>Slopes of log error against log voxel size, by least squares, "
        "with 95 % intervals and the number of rows fitted.</p>\n<div class=\"rows\"><table>\n"
        "<tr><th>scene<th>surface<th>depth slope<th>expected<th>normal slope<th>expected</tr>\n";
    for (const BenchFit& fit : report.fits) {
        const ExpectedSlopes expected = expected_slopes(fit.scene, fit.surface);
        html +=
            fmt::format("<tr><td>{}<td>{}<td>{}<td>{}<td>{}<td>{}</tr>\n", escape_html(fit.scene),
                        name_of(fit.surface), slope_text(fit.depth), escape_html(expected.depth),
                        slope_text(fit.normal), escape_html(expected.normal));
    }
    return html + "</table></div>\n";
}

std::string peers(const BenchReport& report) {
    if (report.peers.empty()) return {};
    std::string html =
        "<h2>Other programs</h2>\n<p>The same rays and errors; building their structures counts. "
        "The last columns name the quickest row above whose depth RMS is at most theirs, and how "
        "many times its total they took.</p>\n<div class=\"rows\"><table>\n<tr><th>scene"
        "<th>program<th>setting<th>build ms<th>trace ms<th>depth RMS m<th>normal RMS &deg;"
        "<th>as accurate<th>times</tr>\n";
    for (const BenchPeerRow& p : report.peers) {
        const BenchRow* row = row_as_accurate(report, p);
        html +=
            fmt::format("<tr><td>{}<td>{}<td>{}<td>{:.2f}<td>{:.2f}<td>{:.3g}<td>{:.3g}",
                        escape_html(p.scene), escape_html(p.program), escape_html(p.setting),
                        p.build_seconds * 1e3, p.trace_seconds * 1e3, p.depth_rms, p.normal_rms);
        html += row ? fmt::format("<td>{} {}<td>{:.2f}</tr>\n", name_of(row->surface),
                                  row->resolution, p.total_seconds() / row->seconds.total)
                    : "<td>none<td></tr>\n";
    }
    return html + "</table></div>\n";
}

std::string rows(const BenchReport& report) {
    std::string html = "<h2>Rows</h2>\n<div class=\"rows\"><table>\n<tr>";
    for (const char* name : {"scene",
                             "surface",
                             "voxels a metre",
                             "rays a pixel",
                             "load ms",
                             "voxelize ms",
                             "place ms",
                             "index ms",
                             "image ms",
                             "total ms",
                             "kernels ms",
                             "programs ms",
                             "peak MB",
                             "depth RMS m",
                             "depth max m",
                             "normal RMS &deg;",
                             "outline mean px",
                             "outline max px",
                             "other parts px",
                             "colour RMSE",
                             "FLIP",
                             "front"})
        html += fmt::format("<th>{}", name);
    html += "</tr>\n";
    for (const BenchRow& r : report.rows) {
        const BenchTimes& s = r.seconds;
        const BenchErrors& e = r.errors;
        html += fmt::format("<tr><td>{}<td>{}<td>{}<td>{}", escape_html(r.scene),
                            name_of(r.surface), r.resolution, r.samples);
        for (const double seconds :
             {s.load, s.voxelize, s.place, s.index, s.image, s.total, s.kernels, s.programs})
            html += fmt::format("<td>{:.2f}", seconds * 1e3);
        html += fmt::format("<td>{:.1f}", double(r.peak_bytes) / 1e6);
        for (const double error :
             {e.depth_rms, e.depth_max, e.normal_rms, e.silhouette_mean, e.silhouette_max})
            html += fmt::format("<td>{:.3g}", error);
        html += fmt::format("<td>{}", e.other_parts);
        for (const double error : {e.color_rmse, e.flip})
            html += error > 0 ? fmt::format("<td>{:.3g}", error) : "<td>";
        html += fmt::format("<td>{}</tr>\n", r.is_best ? "*" : "");
    }
    return html + "</table></div>\n";
}

std::string method() {
    return fmt::format(
        "<h2>Method</h2>\n<p>The truth is computed in double, in closed form for sphere and box, "
        "by bisection for torus and gyroid, over a tree of triangles for meshes, and shares "
        "nothing "
        "with the kernels. Depth is along the sight "
        "ray; depth and normals are compared where both meet the solid with an incidence cosine of "
        "at least {}. The outline's mean is the area that only one of both covers over the true "
        "outline's length, its max the largest distance of such a pixel's centre from the true "
        "outline. A hit more than {} voxels from the true one shows another part of the surface: "
        "it is "
        "counted, and left out of depth and normals. Colours are compared with the mean light over "
        "each pixel's square, by 16 or 64 rays traced in double; FLIP is that of Andersson et al. "
        "2020 for 67 pixels a degree.</p>\n<p><i>Cubes</i> are the supercover, as scenes have it "
        "without a "
        "<code>set</code>. The total is all stages from the model to the image, without writing "
        "files. Of it, <i>kernels</i> is the time that the device ran them; <i>programs</i> is "
        "what the first "
        "render of the row took to make kernels ready, and no part of the total. Rings "
        "mark the Pareto front: no other row of the scene is both faster in total and nearer to "
        "the truth.</p>\n<p>Dashed lines are fits, their slopes in brackets, over these rows: of "
        "<i>cubes</i> and <i>exact</i> all; of <i>smooth</i> those whose RMS is more than {} times "
        "the floor that the rounding of its 16-bit distances was measured to leave ({} voxel of "
        "depth, {} degrees of normals), with at least {} voxels to the least radius of "
        "curvature.</p>\n",
        kLeastCosine, kSamePartVoxels, kFloorFactor, kDepthFloor, kNormalFloor, kLeastVoxels);
}

}  // namespace

std::string bench_page(const BenchReport& report) {
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
        "name=\"viewport\" content=\"width=device-width\">\n<title>Voxelume: run time against "
        "error</title>\n<style>{}</style>\n</head>\n<body>\n<h1>Run time against error</h1>\n",
        kStyle);
    html += heading(report);
    for (size_t i = 0; i < report.fits.size(); i += std::size(kBenchSurfaces)) {
        const std::string& scene = report.fits[i].scene;
        html += fmt::format("<h2>{}</h2>\n<div class=\"plots\">\n", escape_html(scene));
        for (const LogPlot& plot :
             {depth_plot(report, scene), normal_plot(report, scene), outline_plot(report, scene),
              time_plot(report, scene), kernel_plot(report, scene)})
            html += svg_of(plot);
        html += light_plots(report, scene) + "</div>\n";
    }
    return html + slopes(report) + peers(report) + rows(report) + method() + "</body>\n</html>\n";
}

}  // namespace voxelume
