#include "runtime/bench/bench_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

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
            {"voxel_size", row.voxel_size},
            {"seconds",
             {{"load", s.load},
              {"voxelize", s.voxelize},
              {"place", s.place},
              {"index", s.index},
              {"image", s.image},
              {"total", s.total}}},
            {"voxels", row.voxels},
            {"world_bytes", row.world_bytes},
            {"peak_device_bytes", row.peak_bytes},
            {"compared_pixels", e.compared},
            {"depth_rms", e.depth_rms},
            {"depth_max", e.depth_max},
            {"normal_rms_degrees", e.normal_rms},
            {"silhouette_mean_pixels", e.silhouette_mean},
            {"silhouette_max_pixels", e.silhouette_max},
            {"above_floor", row.above_floor},
            {"pareto", row.is_best}};
}

}  // namespace

std::string slope_text(const SlopeFit& fit) {
    if (fit.points < 2) return "-";
    if (!std::isfinite(fit.half_width)) return fmt::format("{:.2f}", fit.slope);
    return fmt::format("{:.2f} +- {:.2f}", fit.slope, fit.half_width);
}

ExpectedSlopes expected_slopes(const std::string& scene, Surface surface) {
    if (surface == Surface::exact) return {"0", "0"};
    if (surface == Surface::cubes) return {"1.0", "0"};
    if (scene == "box") return {};  // its edges are no part of what smooth surfaces promise
    return {">= 2.9", ">= 1.95"};
}

std::string bench_text(const BenchReport& report) {
    std::string text = fmt::format(
        "{:<7} {:<7} {:>6} {:>9} {:>7} {:>7} {:>9} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "scene",
        "surface", "1/size", "voxelize", "place", "index", "image ms", "MB", "depth", "max m",
        "normal", "outline", "max px");
    for (const BenchRow& r : report.rows) {
        const BenchTimes& s = r.seconds;
        const BenchErrors& e = r.errors;
        text += fmt::format(
            "{:<7} {:<7} {:>6} {:>9.2f} {:>7.2f} {:>7.2f} {:>9.2f} {:>7.1f} {:>9.2e} {:>9.2e} "
            "{:>9.2e} {:>9.2e} {:>9.2e}{}\n",
            r.scene, name_of(r.surface), r.resolution, s.voxelize * 1e3, s.place * 1e3,
            s.index * 1e3, s.image * 1e3, double(r.peak_bytes) / 1e6, e.depth_rms, e.depth_max,
            e.normal_rms, e.silhouette_mean, e.silhouette_max, r.is_best ? " *" : "");
    }
    text += "* on the Pareto front of total time and depth RMS\n\n";
    text += fmt::format("{:<7} {:<7} {:>6}  {:<16} {:<10} {:<16} {:<10}\n", "scene", "surface",
                        "points", "depth slope", "expected", "normal slope", "expected");
    for (const BenchFit& f : report.fits) {
        const ExpectedSlopes expected = expected_slopes(f.scene, f.surface);
        text += fmt::format("{:<7} {:<7} {:>6}  {:<16} {:<10} {:<16} {:<10}\n", f.scene,
                            name_of(f.surface), f.depth.points, slope_text(f.depth), expected.depth,
                            slope_text(f.normal), expected.normal);
    }
    return text;
}

std::string bench_csv(const BenchReport& report) {
    std::string text =
        "scene,surface,voxels_per_metre,voxel_size_m,load_s,voxelize_s,place_s,index_s,image_s,"
        "total_s,voxels,world_bytes,peak_device_bytes,compared_pixels,depth_rms_m,depth_max_m,"
        "normal_rms_deg,silhouette_mean_px,silhouette_max_px,above_floor,pareto\r\n";
    for (const BenchRow& r : report.rows) {
        const BenchTimes& s = r.seconds;
        const BenchErrors& e = r.errors;
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n",
                        r.scene, name_of(r.surface), r.resolution, r.voxel_size, s.load, s.voxelize,
                        s.place, s.index, s.image, s.total, r.voxels, r.world_bytes, r.peak_bytes,
                        e.compared, e.depth_rms, e.depth_max, e.normal_rms, e.silhouette_mean,
                        e.silhouette_max, int(r.above_floor), int(r.is_best));
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
