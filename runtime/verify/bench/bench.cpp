// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>
#include <iterator>
#include <thread>

#include "runtime/base/version.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/verify/bench/bench_extent.hpp"

namespace voxelume {
namespace {

/// The system and its number of hardware threads, without the name of a host.
std::string describe_machine() {
    utsname names{};
    if (uname(&names) != 0) return "unknown";
    return fmt::format("{} {} {}, {} hardware threads", names.sysname, names.release, names.machine,
                       std::thread::hardware_concurrency());
}

BenchReport describe(const Device& device, const BenchOptions& options) {
    BenchReport report;
    const DeviceInfo& info = device.info();
    report.version = version();
    report.device = info.name;
    report.driver = info.driver;
    report.platform = info.platform + ", " + info.platform_version;
    report.machine = describe_machine();
    report.time = fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)));
    report.lanes = device.lanes();
    report.size = options.size;
    report.light_size = options.light_size;
    report.repeats = options.repeats;
    return report;
}

/// The truths with which the rows of one subject and size are compared.
struct Measured {
    const BenchSubject& subject;
    const BenchTruth& truth;
    const ShadowTruth* shadow;  ///< null where no shadow edges are measured
    glm::ivec2 size;
};

Scene scene_of(const BenchSubject& subject, const BenchRow& row, glm::ivec2 size) {
    Scene scene = subject.scene(row.surface, row.resolution, size);
    scene.render.samples = row.samples;
    for (Object& object : scene.objects) object.placement = row.placement;
    return scene;
}

/// Measures volume and area. For cubes it measures the voxel set `solid`, which stands for the
/// volume, whatever set the image shows.
void measure_extent(const Device& device, Scene scene, const Pyramid& shown,
                    const std::optional<Extent>& truth, BenchRow& row) {
    if (!truth) return;
    const glm::dvec3 side(scene.objects.front().world_from_object[0]);
    const double scale = row.placement == Placement::instance ? glm::length(side) : 1;
    std::optional<Extent> extent;
    if (shows_voxels(row.surface)) {
        scene.models.front().set = VoxelSet::solid;
        WorldReport report;
        extent = extent_of(build_world(device, scene, report), row.surface, scale);
    } else {
        extent = extent_of(shown, row.surface, scale);
    }
    if (!extent) return;
    row.volume_error = extent->volume / truth->volume - 1;
    row.area_error = extent->area / truth->area - 1;
}

void measure_shadow_edge(const Device& device, const Measured& measured, BenchRow& row) {
    if (!measured.shadow) return;
    Scene scene = shadow_scene(measured.subject, row.surface, row.resolution, measured.size);
    scene.objects.front().placement = row.placement;
    RenderReport report;
    row.shadow = measure_shadow(*measured.shadow, render(device, scene, report));
}

/// Measures the first render and takes all errors from it.
BenchTimes measure_first(const Device& device, const Scene& scene, const Measured& measured,
                         BenchRow& row) {
    DeviceCounters& counters = device.counters();
    RenderReport report;
    const BuiltWorld world = WorldBuilder(device, false).build(scene, report.world);
    const Image image = Renderer(device, false).new_image(scene, world, report);
    device.finish();
    const BenchTimes times = times_of(report, counters);
    row.errors = measure_errors(measured.truth, image, scene.world.voxel_size.x);
    row.voxels = report.voxels;
    row.world_bytes = report.world_bytes;
    row.peak_bytes = counters.peak_bytes;
    row.seconds.programs = counters.build_ms / 1e3;
    if (row.samples == 1)
        measure_extent(device, scene, world.pyramid, measured.subject.extent, row);
    return times;
}

void measure(const Device& device, const Measured& measured, int repeats, BenchRow& row) {
    const Scene scene = scene_of(measured.subject, row, measured.size);
    clear_counters(device);
    BenchTimes best = measure_first(device, scene, measured, row);
    const double programs = row.seconds.programs;
    // The first render counts if it made no kernels and takes kMaxRowSeconds or more, or if there
    // are no repeats.
    double spent = best.total;
    if (programs > 0 || (repeats > 0 && spent < kMaxRowSeconds)) best.total = INFINITY;
    for (int i = 0; std::isinf(best.total) || (i < repeats && spent < kMaxRowSeconds); ++i) {
        clear_counters(device);
        RenderReport report;
        render(device, scene, report);
        device.finish();
        const BenchTimes times = times_of(report, device.counters());
        spent += times.total;
        if (times.total < best.total) best = times;
    }
    row.seconds = best;
    row.seconds.programs = programs;
    if (row.samples == 1) measure_shadow_edge(device, measured, row);
}

/// The combinations of one subject, in the order of measurement.
std::vector<BenchRow> planned_rows(const BenchOptions& options, const BenchEntry& entry) {
    std::vector<BenchRow> rows;
    const int finest =
        entry.has_light ? std::min(entry.finest, options.finest_with_light) : entry.finest;
    for (const SurfaceKind& kind : kSurfaceKinds)
        for (const Placement placement : options.placements) {
            // Cubes of glass can't be instances.
            if (entry.has_light && kind.shows_voxels && placement == Placement::instance) continue;
            for (const int samples : entry.has_light ? options.samples : std::vector<int>{1})
                for (const int resolution : options.resolutions) {
                    if (resolution < entry.coarsest || resolution > finest) continue;
                    BenchRow row;
                    row.scene = entry.name;
                    row.surface = kind.surface;
                    row.placement = placement;
                    row.samples = samples;
                    row.resolution = resolution;
                    row.voxel_size = 1.0 / resolution;
                    rows.push_back(row);
                }
        }
    return rows;
}

void mark_front(std::span<BenchRow> rows) {
    std::vector<double> seconds, errors;
    std::vector<BenchRow*> compared;
    for (BenchRow& row : rows) {
        if (row.samples != 1 || row.errors.compared == 0) continue;
        compared.push_back(&row);
        seconds.push_back(row.seconds.total);
        errors.push_back(row.errors.depth_rms);
    }
    for (const size_t i : pareto_front(seconds, errors)) compared[i]->is_best = true;
}

/// Fits the rows of a surface and placement whose `error` has a positive value.
SlopeFit fit_rows(std::span<const BenchRow> rows, const BenchFit& fit,
                  const std::function<double(const BenchRow&)>& error) {
    std::vector<double> sizes, errors;
    for (const BenchRow& row : rows) {
        if (row.surface != fit.surface || row.placement != fit.placement || row.samples != 1)
            continue;
        sizes.push_back(row.voxel_size);
        errors.push_back(error(row));
    }
    return fit_slope(sizes, errors);
}

void measure_level(std::span<const BenchRow> rows, BenchFit& fit) {
    fit.depth_min = INFINITY;
    for (const BenchRow& row : rows) {
        if (row.surface != fit.surface || row.placement != fit.placement || row.samples != 1)
            continue;
        const BenchErrors& e = row.errors;
        if (e.compared == 0) continue;
        fit.depth_min = std::min(fit.depth_min, e.depth_rms);
        fit.depth_max = std::max(fit.depth_max, e.depth_rms);
        if (e.float_spacing > 0)
            fit.depth_max_floats = std::max(fit.depth_max_floats, e.depth_rms / e.float_spacing);
    }
    if (std::isinf(fit.depth_min)) fit.depth_min = 0;
}

BenchFit fit_of(std::span<const BenchRow> rows, const BenchRow& first) {
    BenchFit fit;
    fit.scene = first.scene, fit.surface = first.surface, fit.placement = first.placement;
    fit.depth = fit_rows(
        rows, fit, [](const BenchRow& row) { return row.fits_depth ? row.errors.depth_rms : 0; });
    fit.normal = fit_rows(
        rows, fit, [](const BenchRow& row) { return row.fits_normal ? row.errors.normal_rms : 0; });
    fit.volume =
        fit_rows(rows, fit, [](const BenchRow& row) { return std::abs(row.volume_error); });
    fit.area = fit_rows(rows, fit, [](const BenchRow& row) { return std::abs(row.area_error); });
    measure_level(rows, fit);
    return fit;
}

void choose_fitted(BenchRow& row) {
    if (!stores_distances(row.surface)) return;
    const bool is_fine = row.min_radius == 0 || row.min_radius >= kMinVoxels * row.voxel_size;
    const double depth_floor = kDepthFloor * row.voxel_size;
    row.fits_depth = is_fine && row.errors.depth_rms > kFloorFactor * depth_floor;
    row.fits_normal = is_fine && row.errors.normal_rms > kFloorFactor * kNormalFloor;
}

}  // namespace

std::string_view name_of(Surface surface) {
    return kind_of(surface).name;
}

const char* name_of(Placement placement) {
    return placement == Placement::instance ? "instance" : "world";
}

void conclude(BenchReport& report) {
    for (BenchRow& row : report.rows) choose_fitted(row);
    for (size_t first = 0, end = 0; first < report.rows.size(); first = end) {
        const std::string scene = report.rows[first].scene;
        while (end < report.rows.size() && report.rows[end].scene == scene) ++end;
        const std::span<BenchRow> rows(report.rows.data() + first, end - first);
        mark_front(rows);
        for (size_t i = 0; i < rows.size(); ++i)
            if (i == 0 || rows[i].surface != rows[i - 1].surface ||
                rows[i].placement != rows[i - 1].placement)
                report.fits.push_back(fit_of(rows, rows[i]));
    }
    report.global_fits = fit_global(report.global_rows);
}

size_t count_rows(const BenchOptions& options) {
    size_t count = 0;
    for (const BenchEntry* entry : options.subjects) count += planned_rows(options, *entry).size();
    return count + options.global_scenes.size() * options.global_samples.size();
}

BenchReport run_bench(const Device& device, const BenchOptions& options,
                      const std::function<void(size_t, size_t)>& progress) {
    BenchReport report = describe(device, options);
    report.peers = options.peers;
    device.time_kernels(true);
    const size_t total = count_rows(options);
    for (const GlobalScene& scene : options.global_scenes) check_global(device, scene);
    for (const BenchEntry* entry : options.subjects) {
        const BenchSubject subject = entry->open();
        const glm::ivec2 size = entry->has_light ? options.light_size : options.size;
        const BenchTruth truth = bench_truth(subject, size);
        std::optional<ShadowTruth> shadow;
        if (options.measures_shadows && !entry->has_light) shadow = shadow_truth(subject, size);
        for (BenchRow row : planned_rows(options, *entry)) {
            row.min_radius = subject.min_radius;
            measure(device, {subject, truth, shadow ? &*shadow : nullptr, size}, options.repeats,
                    row);
            report.rows.push_back(row);
            progress(report.rows.size(), total);
        }
    }
    size_t done = report.rows.size();
    for (const GlobalScene& scene : options.global_scenes) {
        std::ranges::move(measure_global(device, scene, options.global_samples, options.repeats,
                                         [&] { progress(++done, total); }),
                          std::back_inserter(report.global_rows));
        std::ranges::copy_if(options.global_peers, std::back_inserter(report.global_rows),
                             [&](const GlobalRow& row) { return row.scene == scene.name; });
    }
    conclude(report);
    return report;
}

}  // namespace voxelume
