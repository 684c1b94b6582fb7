// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/report/bench_global_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/verify/report/bench_fronts.hpp"
#include "runtime/verify/report/bench_tables.hpp"

namespace voxelume {
namespace {

constexpr const char* kOurs = "Voxelume";

std::string program_of(const std::string& program) {
    return program.empty() ? kOurs : program;
}

/// A value as text; empty if unknown.
std::string known(double value, const char* format) {
    return value > 0 ? fmt::format(fmt::runtime(format), value) : "";
}

/// An error as text; a dash if unknown.
std::string error_text(double error, const char* format) {
    return std::isnan(error) ? "-" : fmt::format(fmt::runtime(format), error);
}

/// A row's error times its time, which is constant where errors fall as those of independent
/// samples.
double product_of(const GlobalRow& row) {
    return row.relative_mse * row.seconds;
}

}  // namespace

std::string global_text(const BenchReport& report) {
    if (report.global_rows.empty()) return {};
    size_t width = 5, names = 7;
    for (const GlobalRow& row : report.global_rows) {
        width = std::max(width, row.scene.size());
        names = std::max(names, program_of(row.program).size());
    }
    std::string text = fmt::format("\n{:<{}} {:<{}} {:>7} {:>12} {:>7} {:>10} {:>10} {:>10}\n",
                                   "scene", width, "program", names, "samples", "relative MSE",
                                   "light", "image ms", "total ms", "MSE x s");
    for (const GlobalRow& row : report.global_rows)
        text += fmt::format("{:<{}} {:<{}} {:>7} {:>12} {:>7} {:>10.1f} {:>10} {:>10}\n", row.scene,
                            width, program_of(row.program), names, row.samples,
                            error_text(row.relative_mse, "{:.3e}"), known(row.light, "{:.4f}"),
                            row.seconds * 1e3, known(row.times.total * 1e3, "{:.1f}"),
                            error_text(product_of(row), "{:.2e}"));
    text += fmt::format("\n{:<{}} {:<{}} {:<24} {}\n", "scene", width, "program", names,
                        "slope by samples", "slope by time");
    for (const GlobalFit& fit : report.global_fits)
        text += fmt::format("{:<{}} {:<{}} {:<24} {}\n", fit.scene, width, program_of(fit.program),
                            names, slope_text(fit.by_samples), slope_text(fit.by_seconds));
    const std::vector<FrontComparison> comparisons = noise_comparisons(report);
    if (!comparisons.empty()) text += '\n';
    for (const FrontComparison& comparison : comparisons) text += sentence_of(comparison) + "\n";
    return text;
}

std::vector<LogPlot> global_plots(const BenchReport& report) {
    constexpr std::array kColors = {"#b35900", "#8e44ad", "#777", "#1f6fb4", "#c0392b"};
    std::vector<LogPlot> plots;
    std::vector<std::string> programs;
    for (const GlobalFit& fit : report.global_fits) {
        const std::string title = fit.scene + ": noise against the picture's time";
        auto plot = std::ranges::find(plots, title, &LogPlot::title);
        if (plot == plots.end())
            plot = plots.insert(plots.end(), {title, "picture, s", "relative MSE", {}});
        auto color = std::ranges::find(programs, fit.program);
        if (color == programs.end()) color = programs.insert(programs.end(), fit.program);
        PlotSeries series;
        series.name = program_of(fit.program);
        if (fit.by_seconds.points >= 2)
            series.name += fmt::format(" ({:.2f})", fit.by_seconds.slope);
        series.color = kColors[size_t(color - programs.begin()) % kColors.size()];
        for (const GlobalRow& row : report.global_rows)
            if (row.scene == fit.scene && row.program == fit.program)
                series.points.emplace_back(row.seconds, row.relative_mse);
        plot->series.push_back(series);
    }
    return plots;
}

std::string global_section(const BenchReport& report) {
    if (report.global_rows.empty()) return {};
    std::string html =
        "<h2>Noise in global light</h2>\n<p>Relative MSE is the mean over pixels and colours of "
        "the squared error over the squared light, to which a hundredth of the picture's squared "
        "mean is added. The error is the difference from two pictures whose noise has nothing to "
        "do with that of each other, and so doesn't count. The image's time has no part of its "
        "world's. In brackets: the slope.</p>\n<div class=\"plots\">\n";
    for (const LogPlot& plot : global_plots(report)) html += svg_of(plot);
    html += "</div>\n<ul>\n";
    for (const FrontComparison& comparison : noise_comparisons(report))
        html += fmt::format("<li>{}</li>\n", escape_html(sentence_of(comparison)));
    html +=
        "</ul>\n<div class=\"rows\"><table>\n<tr><th>scene<th>program<th>samples"
        "<th>relative MSE<th>light<th>image ms<th>total ms<th>kernels ms<th>programs ms"
        "<th>peak MB<th>MSE &times; s</tr>\n";
    for (const GlobalRow& row : report.global_rows) {
        html += fmt::format("<tr><td>{}<td>{}<td>{}<td>{}<td>{}<td>{:.1f}", escape_html(row.scene),
                            escape_html(program_of(row.program)), row.samples, row.relative_mse,
                            known(row.light, "{:.4f}"), row.seconds * 1e3);
        for (const double seconds : {row.times.total, row.times.kernels, row.times.programs})
            html += "<td>" + known(seconds * 1e3, "{:.1f}");
        html += fmt::format("<td>{}<td>{}</tr>\n", known(double(row.peak_bytes) / 1e6, "{:.1f}"),
                            product_of(row));
    }
    html +=
        "</table></div>\n<div class=\"rows\"><table>\n<tr><th>scene<th>program"
        "<th>slope by samples<th>slope by time</tr>\n";
    for (const GlobalFit& fit : report.global_fits)
        html += fmt::format("<tr><td>{}<td>{}<td>{}<td>{}</tr>\n", escape_html(fit.scene),
                            escape_html(program_of(fit.program)), slope_text(fit.by_samples),
                            slope_text(fit.by_seconds));
    return html + "</table></div>\n";
}

nlohmann::ordered_json json_of(const GlobalRow& row) {
    nlohmann::ordered_json json = {{"scene", row.scene},
                                   {"program", program_of(row.program)},
                                   {"samples", row.samples},
                                   {"relative_mse", row.relative_mse},
                                   {"light", row.light > 0 ? row.light : NAN}};
    if (row.program.empty()) {
        json["seconds"] = json_of(row.times);
        json["peak_device_bytes"] = row.peak_bytes;
    } else {
        json["seconds"] = {{"image", row.seconds}};
    }
    return json;
}

nlohmann::ordered_json global_json(const BenchReport& report) {
    auto rows = nlohmann::ordered_json::array(), fits = rows;
    for (const GlobalRow& row : report.global_rows) rows.push_back(json_of(row));
    for (const GlobalFit& fit : report.global_fits)
        fits.push_back({{"scene", fit.scene},
                        {"program", program_of(fit.program)},
                        {"by_samples", json_of(fit.by_samples)},
                        {"by_seconds", json_of(fit.by_seconds)}});
    return {{"rows", rows}, {"fits", fits}, {"fronts", json_of(noise_comparisons(report), "mse")}};
}

}  // namespace voxelume
