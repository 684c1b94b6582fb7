// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/report/bench_page.hpp"

#include <fmt/format.h>

#include <cmath>

#include "runtime/verify/report/bench_fronts.hpp"
#include "runtime/verify/report/bench_global_report.hpp"
#include "runtime/verify/report/bench_plots.hpp"
#include "runtime/verify/report/bench_tables.hpp"
#include "runtime/verify/report/log_plot.hpp"

namespace voxelume {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.45 system-ui,sans-serif;color:#222;background:#fff;max-width:1480px;"
    "margin:1.5em auto;padding:0 1em}"
    "h1{font-size:1.5em}h2{font-size:1.2em;margin-top:1.6em}"
    ".plots{display:flex;flex-wrap:wrap;align-items:flex-start;gap:8px}"
    "svg{width:460px;max-width:100%;height:auto}"
    ".rows{overflow-x:auto}"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums}"
    "td,th{padding:2px 9px;text-align:right;border-bottom:1px solid #e4e4e4;white-space:nowrap}"
    "td:nth-child(-n+3),th:nth-child(-n+3){text-align:left}"
    "dt{float:left;width:6em;color:#666}dd{margin-left:6.5em}";

std::string repeats_text(int repeats) {
    if (repeats == 0) return "Each row is rendered once, and again where that made kernels";
    return fmt::format(
        "Each row is rendered once for its errors and kernels, then up to {} times while that "
        "takes less than {} s; the fastest counts",
        repeats, kMaxRowSeconds);
}

std::string heading(const BenchReport& report) {
    std::string html = "<dl>\n";
    const std::pair<const char*, std::string> lines[] = {
        {"Voxelume", report.version},
        {"Machine", report.machine},
        {"Device", fmt::format("{}, {} lanes", report.device, report.lanes)},
        {"Driver", fmt::format("{}; {}", report.driver, report.platform)},
        {"Time", report.time},
        {"Images", fmt::format("{} x {} pixels, {} x {} of scenes with light. {}", report.size.x,
                               report.size.y, report.light_size.x, report.light_size.y,
                               repeats_text(report.repeats))}};
    for (const auto& [name, value] : lines)
        html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escape_html(value));
    return html + "</dl>\n";
}

std::string slopes(const BenchReport& report) {
    std::string html =
        "<h2>Convergence</h2>\n<p>Slopes of log error against log voxel size, by least squares, "
        "with 95 % intervals and the number of rows fitted. <i>Exact</i> promises a level instead: "
        "its "
        "depth RMS of all sizes, and the largest of them in spacings of floats at the scene's "
        "distance, of which it promises 4 at most.</p>\n<div class=\"rows\"><table>\n"
        "<tr><th>scene<th>surface<th>placed<th>depth slope<th>expected<th>normal slope<th>expected"
        "<th>volume slope<th>area slope<th>depth RMS of all sizes</tr>\n";
    for (const BenchFit& fit : report.fits) {
        const ExpectedSlopes expected = expected_slopes(fit.scene, fit.surface);
        html +=
            fmt::format("<tr><td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}</tr>\n",
                        escape_html(fit.scene), name_of(fit.surface), name_of(fit.placement),
                        slope_text(fit.depth), escape_html(expected.depth), slope_text(fit.normal),
                        escape_html(expected.normal), slope_text(fit.volume), slope_text(fit.area),
                        level_text(fit));
    }
    return html + "</table></div>\n";
}

std::string peers(const BenchReport& report) {
    if (report.peers.empty()) return {};
    std::string html =
        "<h2>Other programs</h2>\n<p>The same rays and errors; building their structures counts. "
        "Fronts are compared along straight lines of logarithms between their points:</p>\n<ul>\n";
    for (const FrontComparison& comparison : front_comparisons(report))
        html += fmt::format("<li>{}</li>\n", escape_html(sentence_of(comparison)));
    html +=
        "</ul>\n<p>The last columns name the quickest row above whose depth RMS is at most theirs, "
        "and how "
        "many times its total they took.</p>\n<div class=\"rows\"><table>\n<tr><th>scene"
        "<th>program<th>setting<th>build ms<th>trace ms<th>depth RMS m<th>normal RMS &deg;"
        "<th>other parts px<th>as accurate<th>times</tr>\n";
    for (const BenchPeerRow& p : report.peers) {
        const BenchRow* row = row_as_accurate(report, p);
        html += fmt::format("<tr><td>{}<td>{}<td>{}<td>{:.2f}<td>{:.2f}<td>{:.3g}<td>{:.3g}<td>{}",
                            escape_html(p.scene), escape_html(p.program), escape_html(p.setting),
                            p.build_seconds * 1e3, p.trace_seconds * 1e3, p.depth_rms, p.normal_rms,
                            p.other_parts);
        html += row ? fmt::format("<td>{} {} {}<td>{:.2f}</tr>\n", name_of(row->surface),
                                  name_of(row->placement), row->resolution,
                                  p.total_seconds() / row->seconds.total)
                    : "<td>none<td></tr>\n";
    }
    return html + "</table></div>\n";
}

std::string rows(const BenchReport& report) {
    std::string html = "<h2>Rows</h2>\n<div class=\"rows\"><table>\n<tr>";
    for (const char* name : {"scene",
                             "surface",
                             "placed",
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
                             "volume",
                             "area",
                             "shadow mean px",
                             "shadow max px",
                             "other parts px",
                             "colour RMSE",
                             "FLIP",
                             "front"})
        html += fmt::format("<th>{}", name);
    html += "</tr>\n";
    for (const BenchRow& r : report.rows) {
        const BenchTimes& s = r.seconds;
        const BenchErrors& e = r.errors;
        html += fmt::format("<tr><td>{}<td>{}<td>{}<td>{}<td>{}", escape_html(r.scene),
                            name_of(r.surface), name_of(r.placement), r.resolution, r.samples);
        for (const double seconds :
             {s.load, s.voxelize, s.place, s.index, s.image, s.total, s.kernels, s.programs})
            html += fmt::format("<td>{:.2f}", seconds * 1e3);
        html += fmt::format("<td>{:.1f}", double(r.peak_bytes) / 1e6);
        for (const double error :
             {e.depth_rms, e.depth_max, e.normal_rms, e.silhouette_mean, e.silhouette_max,
              r.volume_error, r.area_error, r.shadow.mean, r.shadow.max})
            html += std::isnan(error) ? "<td>" : fmt::format("<td>{:.3g}", error);
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
        "2020 for 67 pixels a degree. Volume and area are relative errors of what the voxels "
        "enclose, summed in double over what the device stores: of <i>cubes</i> the set of voxels "
        "whose centres are inside, of <i>smooth</i> the zero of the fields, of <i>exact</i> the "
        "triangles or solids. The shadow is that of a sun on a ground below, its edge compared as "
        "the outline is. <i>Instance</i> carries rays into the model's own voxels; elsewhere the "
        "model is resampled into the world's.</p>\n<p><i>Cubes</i> in images are the supercover, "
        "as scenes have it "
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
        kMinCosine, kSamePartVoxels, kFloorFactor, kDepthFloor, kNormalFloor, kMinVoxels);
}

}  // namespace

std::string bench_page(const BenchReport& report) {
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
        "name=\"viewport\" content=\"width=device-width\">\n<title>Voxelume: run time against "
        "error</title>\n<style>{}{}</style>\n</head>\n<body>\n<h1>Run time against error</h1>\n",
        kStyle, kPlotStyle);
    html += heading(report);
    for (const std::string& scene : scenes_of(report)) {
        html += fmt::format("<h2>{}</h2>\n<div class=\"plots\">\n", escape_html(scene));
        for (const LogPlot& plot : plots_of(report, scene)) html += svg_of(plot);
        html += "</div>\n";
    }
    if (!report.rows.empty()) html += slopes(report) + peers(report) + rows(report) + method();
    return html + global_section(report) + "</body>\n</html>\n";
}

}  // namespace voxelume
