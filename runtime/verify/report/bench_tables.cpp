// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/report/bench_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "runtime/verify/report/bench_fronts.hpp"
#include "runtime/verify/report/bench_global_report.hpp"

namespace voxelume {

nlohmann::ordered_json json_of(const SlopeFit& fit) {
    // JSON has null for values that aren't finite.
    const double slope = fit.points < 2 ? NAN : fit.slope;
    return {{"points", fit.points}, {"slope", slope}, {"half_width_95", fit.half_width}};
}

nlohmann::ordered_json json_of(const BenchTimes& times) {
    return {{"load", times.load},       {"voxelize", times.voxelize}, {"place", times.place},
            {"index", times.index},     {"image", times.image},       {"total", times.total},
            {"kernels", times.kernels}, {"programs", times.programs}};
}

nlohmann::ordered_json json_of(const std::vector<FrontComparison>& comparisons,
                               const std::string& error) {
    auto fronts = nlohmann::ordered_json::array();
    for (const FrontComparison& c : comparisons) {
        auto pieces = nlohmann::ordered_json::array();
        for (const FrontPiece& piece : c.pieces)
            pieces.push_back({{"from_" + error, piece.coarse},
                              {"to_" + error, piece.fine},
                              {"least_times_of_ours", piece.minimum},
                              {"most_times_of_ours", piece.maximum}});
        fronts.push_back({{"program", c.program}, {"scene", c.scene}, {"pieces", pieces}});
    }
    return fronts;
}

namespace {

nlohmann::ordered_json json_of(const BenchRow& row) {
    const BenchErrors& e = row.errors;
    return {{"scene", row.scene},
            {"surface", name_of(row.surface)},
            {"placement", name_of(row.placement)},
            {"samples", row.samples},
            {"voxels_per_metre", row.resolution},
            {"voxel_size_metres", row.voxel_size},
            {"seconds", json_of(row.seconds)},
            {"voxels", row.voxels},
            {"world_bytes", row.world_bytes},
            {"peak_device_bytes", row.peak_bytes},
            {"compared_pixels", e.compared},
            {"depth_rms_metres", e.depth_rms},
            {"depth_max_metres", e.depth_max},
            {"normal_rms_degrees", e.normal_rms},
            {"silhouette_mean_pixels", e.silhouette_mean},
            {"silhouette_max_pixels", e.silhouette_max},
            {"other_part_pixels", e.other_parts},
            {"volume_error", row.volume_error},
            {"area_error", row.area_error},
            {"shadow_mean_pixels", row.shadow.mean},
            {"shadow_max_pixels", row.shadow.max},
            {"color_rmse", e.color_rmse},
            {"flip", e.flip},
            {"fits_depth", row.fits_depth},
            {"fits_normal", row.fits_normal},
            {"pareto", row.is_best}};
}

}  // namespace

std::string slope_text(const SlopeFit& fit) {
    if (fit.points < 2) return fmt::format("- ({} rows)", fit.points);
    if (!std::isfinite(fit.half_width)) return fmt::format("{:.2f} (2 rows)", fit.slope);
    return fmt::format("{:.2f} +- {:.2f} ({} rows)", fit.slope, fit.half_width, fit.points);
}

std::string level_text(const BenchFit& fit) {
    if (!lists_primitives(fit.surface) || fit.depth_max == 0) return {};
    return fmt::format("{:.1e} to {:.1e} m, at most {:.1f} floats", fit.depth_min, fit.depth_max,
                       fit.depth_max_floats);
}

ExpectedSlopes expected_slopes(const std::string& scene, Surface surface) {
    if (lists_primitives(surface) && scene == "gyroid") return {"facets", "facets"};
    if (lists_primitives(surface)) return {"4 floats", "level"};
    if (shows_voxels(surface)) return {"1.0", "0"};
    // Smooth surfaces promise nothing for edges and facets.
    if (scene != "sphere" && scene != "torus") return {};
    return {">= 2.9", ">= 1.95"};
}

namespace {

/// A number as text. A value that wasn't measured is a dash.
std::string number_text(double value) {
    return std::isnan(value) ? fmt::format(" {:>9}", "-") : fmt::format(" {:>9.2e}", value);
}

std::string geometry_text(const BenchReport& report) {
    std::string names =
        fmt::format("{:<7} {:<7} {:<8} {:>6}", "scene", "surface", "placed", "1/size");
    std::string units = fmt::format("{:<7} {:<7} {:<8} {:>6}", "", "", "", "1/m");
    for (const char* name :
         {"load", "voxelize", "place", "index", "image", "total", "kernels", "programs"})
        names += fmt::format(" {:>8}", name), units += fmt::format(" {:>8}", "ms");
    names += fmt::format(" {:>6}", "MB"), units += fmt::format(" {:>6}", "peak");
    const std::pair<const char*, const char*> errors[] = {
        {"depth", "RMS m"},     {"max", "m"},          {"normal", "RMS deg"},
        {"outline", "mean px"}, {"max", "px"},         {"volume", "relative"},
        {"area", "relative"},   {"shadow", "mean px"}, {"max", "px"}};
    for (const auto& [name, unit] : errors)
        names += fmt::format(" {:>9}", name), units += fmt::format(" {:>9}", unit);
    std::string text = names + "  other\n" + units + "  parts\n";
    for (const BenchRow& r : report.rows) {
        if (r.samples != 1) continue;
        const BenchTimes& s = r.seconds;
        const BenchErrors& e = r.errors;
        text += fmt::format("{:<7} {:<7} {:<8} {:>6}", r.scene, name_of(r.surface),
                            name_of(r.placement), r.resolution);
        for (const double seconds :
             {s.load, s.voxelize, s.place, s.index, s.image, s.total, s.kernels, s.programs})
            text += fmt::format(" {:>8.1f}", seconds * 1e3);
        text += fmt::format(" {:>6.1f}", double(r.peak_bytes) / 1e6);
        for (const double error :
             {e.depth_rms, e.depth_max, e.normal_rms, e.silhouette_mean, e.silhouette_max,
              r.volume_error, r.area_error, r.shadow.mean, r.shadow.max})
            text += number_text(error);
        text += fmt::format(" {:>6}{}\n", e.other_parts, r.is_best ? " *" : "");
    }
    return text + "* on the Pareto front of total time and depth RMS\n\n";
}

std::string slopes_text(const BenchReport& report) {
    constexpr const char* kLine =
        "{:<7} {:<7} {:<8}  {:<20} {:<10} {:<20} {:<10} {:<20} {:<20} {}\n";
    std::string text =
        fmt::format(kLine, "scene", "surface", "placed", "depth slope", "expected", "normal slope",
                    "expected", "volume slope", "area slope", "depth RMS of all sizes");
    for (const BenchFit& f : report.fits) {
        const ExpectedSlopes expected = expected_slopes(f.scene, f.surface);
        text +=
            fmt::format(kLine, f.scene, name_of(f.surface), name_of(f.placement),
                        slope_text(f.depth), expected.depth, slope_text(f.normal), expected.normal,
                        slope_text(f.volume), slope_text(f.area), level_text(f));
    }
    return text;
}

std::string light_text(const BenchReport& report) {
    std::string text;
    for (const BenchRow& r : report.rows) {
        if (r.errors.flip == 0) continue;
        text +=
            fmt::format("{:<7} {:<7} {:>6} {:>8} {:>8.1f} {:>8.1f} {:>10.3e} {:>8.5f}\n", r.scene,
                        name_of(r.surface), r.resolution, r.samples, r.seconds.image * 1e3,
                        r.seconds.total * 1e3, r.errors.color_rmse, r.errors.flip);
    }
    if (text.empty()) return text;
    return fmt::format("\n{:<7} {:<7} {:>6} {:>8} {:>8} {:>8} {:>10} {:>8}\n", "scene", "surface",
                       "1/size", "samples", "image ms", "total ms", "color RMSE", "FLIP") +
           text;
}

std::string peers_text(const BenchReport& report) {
    if (report.peers.empty()) return {};
    std::string text =
        fmt::format("\n{:<16} {:<7} {:<22} {:>9} {:>9} {:>9} {:>11} {:>9}  {}\n", "program",
                    "scene", "setting", "build ms", "trace ms", "depth m", "other parts", "times",
                    "of the quickest row that is as accurate");
    for (const BenchPeerRow& p : report.peers) {
        const BenchRow* row = row_as_accurate(report, p);
        text += fmt::format("{:<16} {:<7} {:<22} {:>9.1f} {:>9.1f} {:>9.2e} {:>11} ", p.program,
                            p.scene, p.setting, p.build_seconds * 1e3, p.trace_seconds * 1e3,
                            p.depth_rms, p.other_parts);
        text +=
            row ? fmt::format("{:>9.2f}  {} {} {}, {:.1f} ms\n",
                              p.total_seconds() / row->seconds.total, name_of(row->surface),
                              name_of(row->placement), row->resolution, row->seconds.total * 1e3)
                : fmt::format("{:>9}\n", "-");
    }
    text += '\n';
    for (const FrontComparison& comparison : front_comparisons(report))
        text += sentence_of(comparison) + "\n";
    return text;
}

/// A text in a table after RFC 4180.
std::string in_csv(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char letter : text) quoted += letter == '"' ? "\"\"" : std::string(1, letter);
    return quoted + "\"";
}

}  // namespace

std::string bench_text(const BenchReport& report) {
    std::string text;
    if (!report.rows.empty()) text = geometry_text(report) + slopes_text(report);
    text += light_text(report) + peers_text(report) + global_text(report);
    return text.starts_with('\n') ? text.substr(1) : text;
}

std::string bench_csv(const BenchReport& report) {
    std::vector<std::map<std::string, std::string>> rows;
    std::vector<std::string> names;  // names in all rows, in the order in which they come
    const auto add = [&](const nlohmann::ordered_json& flat) {
        std::map<std::string, std::string> values;
        for (const auto& [path, value] : flat.items()) {
            std::string name = path.substr(1);
            std::ranges::replace(name, '/', '_');
            const bool is_missing = value.is_number_float() && !std::isfinite(value.get<double>());
            values[name] = value.is_string() ? in_csv(value.get<std::string>())
                           : is_missing      ? ""
                                             : value.dump();
            if (std::ranges::find(names, name) == names.end()) names.push_back(name);
        }
        rows.push_back(std::move(values));
    };
    for (const BenchRow& row : report.rows) add(json_of(row).flatten());
    for (const GlobalRow& row : report.global_rows) add(json_of(row).flatten());
    std::string text = fmt::format("{}\r\n", fmt::join(names, ","));
    for (auto& row : rows) {
        std::vector<std::string> values;
        values.reserve(names.size());
        for (const std::string& name : names) values.push_back(row[name]);
        text += fmt::format("{}\r\n", fmt::join(values, ","));
    }
    return text;
}

nlohmann::ordered_json bench_json(const BenchReport& report) {
    nlohmann::ordered_json json = {{"version", report.version},
                                   {"time", report.time},
                                   {"machine", report.machine},
                                   {"device", report.device},
                                   {"driver", report.driver},
                                   {"platform", report.platform},
                                   {"lanes", report.lanes},
                                   {"size", {report.size.x, report.size.y}},
                                   {"light_size", {report.light_size.x, report.light_size.y}},
                                   {"repeats", report.repeats},
                                   {"rows", nlohmann::ordered_json::array()},
                                   {"fits", nlohmann::ordered_json::array()}};
    for (const BenchRow& row : report.rows) json["rows"].push_back(json_of(row));
    for (const BenchFit& fit : report.fits)
        json["fits"].push_back({{"scene", fit.scene},
                                {"surface", name_of(fit.surface)},
                                {"placement", name_of(fit.placement)},
                                {"depth", json_of(fit.depth)},
                                {"normal", json_of(fit.normal)},
                                {"volume", json_of(fit.volume)},
                                {"area", json_of(fit.area)},
                                {"depth_rms_least_metres", fit.depth_min},
                                {"depth_rms_most_metres", fit.depth_max},
                                {"depth_rms_most_floats", fit.depth_max_floats}});
    json["peers"] = nlohmann::ordered_json::array();
    for (const BenchPeerRow& peer : report.peers) {
        const BenchRow* row = row_as_accurate(report, peer);
        json["peers"].push_back(
            {{"program", peer.program},
             {"scene", peer.scene},
             {"setting", peer.setting},
             {"build_seconds", peer.build_seconds},
             {"trace_seconds", peer.trace_seconds},
             {"depth_rms_metres", peer.depth_rms},
             {"depth_max_metres", peer.depth_max},
             {"normal_rms_degrees", peer.normal_rms},
             {"other_part_pixels", peer.other_parts},
             {"times_of_ours", row ? peer.total_seconds() / row->seconds.total : NAN}});
    }
    json["fronts"] = json_of(front_comparisons(report), "depth_rms_metres");
    json["global"] = global_json(report);
    return json;
}

}  // namespace voxelume
