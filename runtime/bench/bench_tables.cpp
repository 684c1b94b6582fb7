#include "runtime/bench/bench_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace voxelume {
namespace {

nlohmann::ordered_json json_of(const SlopeFit& fit) {
    // What isn't finite is written as null.
    const double slope = fit.points < 2 ? NAN : fit.slope;
    return {{"points", fit.points}, {"slope", slope}, {"half_width_95", fit.half_width}};
}

nlohmann::ordered_json json_of(const BenchRow& row) {
    const BenchTimes& s = row.seconds;
    const BenchErrors& e = row.errors;
    return {{"scene", row.scene},
            {"surface", name_of(row.surface)},
            {"voxels_per_metre", row.resolution},
            {"voxel_size_metres", row.voxel_size},
            {"seconds",
             {{"load", s.load},
              {"voxelize", s.voxelize},
              {"place", s.place},
              {"index", s.index},
              {"image", s.image},
              {"total", s.total},
              {"programs", s.programs},
              {"kernels", s.kernels}}},
            {"voxels", row.voxels},
            {"world_bytes", row.world_bytes},
            {"peak_device_bytes", row.peak_bytes},
            {"compared_pixels", e.compared},
            {"depth_rms_metres", e.depth_rms},
            {"depth_max_metres", e.depth_max},
            {"normal_rms_degrees", e.normal_rms},
            {"silhouette_mean_pixels", e.silhouette_mean},
            {"silhouette_max_pixels", e.silhouette_max},
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

ExpectedSlopes expected_slopes(const std::string& scene, Surface surface) {
    if (surface == Surface::exact) return {"0 (float)", "0 (float)"};
    if (surface == Surface::cubes) return {"1.0", "0"};
    if (scene == "box") return {};  // its edges are no part of what smooth surfaces promise
    return {">= 2.9", ">= 1.95"};
}

std::string bench_text(const BenchReport& report) {
    std::string text = fmt::format(
        "{:<7} {:<7} {:>6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>6} {:>9} {:>9} {:>9} {:>9} "
        "{:>9}\n",
        "scene", "surface", "1/size", "voxelize", "place", "index", "image", "total", "programs",
        "kernels", "MB", "depth", "max", "normal", "outline", "max");
    text += fmt::format(
        "{:<7} {:<7} {:>6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>6} {:>9} {:>9} {:>9} {:>9} "
        "{:>9}\n",
        "", "", "1/m", "ms", "ms", "ms", "ms", "ms", "ms", "ms", "peak", "RMS m", "m", "RMS deg",
        "mean px", "px");
    for (const BenchRow& r : report.rows) {
        const BenchTimes& s = r.seconds;
        const BenchErrors& e = r.errors;
        text += fmt::format(
            "{:<7} {:<7} {:>6} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f} {:>8.1f} "
            "{:>6.1f} "
            "{:>9.2e} {:>9.2e} {:>9.2e} {:>9.2e} {:>9.2e}{}\n",
            r.scene, name_of(r.surface), r.resolution, s.voxelize * 1e3, s.place * 1e3,
            s.index * 1e3, s.image * 1e3, s.total * 1e3, s.programs * 1e3, s.kernels * 1e3,
            double(r.peak_bytes) / 1e6, e.depth_rms, e.depth_max, e.normal_rms, e.silhouette_mean,
            e.silhouette_max, r.is_best ? " *" : "");
    }
    text += "* on the Pareto front of total time and depth RMS\n\n";
    text += fmt::format("{:<7} {:<7}  {:<20} {:<10} {:<20} {:<10}\n", "scene", "surface",
                        "depth slope", "expected", "normal slope", "expected");
    for (const BenchFit& f : report.fits) {
        const ExpectedSlopes expected = expected_slopes(f.scene, f.surface);
        text +=
            fmt::format("{:<7} {:<7}  {:<20} {:<10} {:<20} {:<10}\n", f.scene, name_of(f.surface),
                        slope_text(f.depth), expected.depth, slope_text(f.normal), expected.normal);
    }
    return text;
}

std::string bench_csv(const BenchReport& report) {
    std::string text;
    for (const BenchRow& row : report.rows) {
        std::vector<std::string> names, values;
        const nlohmann::ordered_json flat = json_of(row).flatten();
        for (const auto& [path, value] : flat.items()) {
            names.push_back(path.substr(1));
            std::ranges::replace(names.back(), '/', '_');
            values.push_back(value.is_string() ? value.get<std::string>() : value.dump());
        }
        if (text.empty()) text = fmt::format("{}\r\n", fmt::join(names, ","));
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
                                   {"repeats", report.repeats},
                                   {"rows", nlohmann::ordered_json::array()},
                                   {"fits", nlohmann::ordered_json::array()}};
    for (const BenchRow& row : report.rows) json["rows"].push_back(json_of(row));
    for (const BenchFit& fit : report.fits)
        json["fits"].push_back({{"scene", fit.scene},
                                {"surface", name_of(fit.surface)},
                                {"depth", json_of(fit.depth)},
                                {"normal", json_of(fit.normal)}});
    return json;
}

}  // namespace voxelume
