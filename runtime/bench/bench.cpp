#include "runtime/bench/bench.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <thread>

#include "runtime/renderer.hpp"
#include "runtime/version.hpp"

namespace voxelume {
namespace {

BenchTimes times_of(const RenderReport& report, const DeviceCounters& counters) {
    BenchTimes times;
    times.load = report.world.load_seconds;
    times.voxelize = report.world.voxelize_seconds;
    times.place = report.world.place_seconds;
    times.index = report.world.index_seconds;
    times.image = report.image_seconds;
    times.total = times.load + times.voxelize + times.place + times.index + times.image;
    for (const auto& [kernel, ms] : counters.kernel_ms) times.kernels += ms / 1e3;
    return times;
}

/// The system and its number of threads, without the name of a host.
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
    report.repeats = options.repeats;
    return report;
}

void measure(const Device& device, const Scene& scene, const BenchTruth& truth, int repeats,
             BenchRow& row) {
    // Programs are ready from the rows of one ray a pixel, and more of them take long.
    if (row.samples > 1) repeats = 0;
    double programs = 0;
    row.seconds.total = INFINITY;
    for (int i = 0; i <= repeats; ++i) {
        DeviceCounters& counters = device.counters();
        counters.peak_bytes = counters.bytes_in_use;
        counters.build_ms = 0;
        counters.kernel_ms.clear();
        RenderReport report;
        const Image image = render(device, scene, report);
        device.finish();
        const BenchTimes times = times_of(report, counters);
        if (i == 0) {  // kernels are compiled on the way
            programs = counters.build_ms / 1e3;
            row.errors = measure_errors(truth, image, scene.world.voxel_size.x);
            row.voxels = report.voxels;
            row.world_bytes = report.world_bytes;
            row.peak_bytes = counters.peak_bytes;
            if (repeats == 0) row.seconds = times;
        } else if (times.total < row.seconds.total) {
            row.seconds = times;
        }
    }
    row.seconds.programs = programs;
}

/// The combinations of one subject in the order in which they are measured.
std::vector<BenchRow> planned_rows(const BenchOptions& options, const BenchEntry& entry,
                                   bool has_light) {
    std::vector<BenchRow> rows;
    for (const Surface surface : kBenchSurfaces)
        for (const int samples : has_light ? options.samples : std::vector<int>{1})
            for (const int resolution : options.resolutions) {
                if (resolution < entry.coarsest || resolution > entry.finest) continue;
                BenchRow row;
                row.scene = entry.name;
                row.surface = surface;
                row.samples = samples;
                row.resolution = resolution;
                row.voxel_size = 1.0 / resolution;
                rows.push_back(row);
            }
    return rows;
}

void mark_front(std::span<BenchRow> rows) {
    std::vector<double> seconds, errors;
    std::vector<BenchRow*> compared;
    for (BenchRow& row : rows) {
        if (row.samples != 1) continue;
        compared.push_back(&row);
        seconds.push_back(row.seconds.total);
        errors.push_back(row.errors.depth_rms);
    }
    for (const size_t i : pareto_front(seconds, errors)) compared[i]->is_best = true;
}

SlopeFit fit_rows(std::span<const BenchRow> rows, Surface surface, bool BenchRow::*counts,
                  double BenchErrors::*error) {
    std::vector<double> sizes, errors;
    for (const BenchRow& row : rows) {
        if (row.surface != surface || row.samples != 1 || !(row.*counts)) continue;
        sizes.push_back(row.voxel_size);
        errors.push_back(row.errors.*error);
    }
    return fit_slope(sizes, errors);
}

void choose_fitted(BenchRow& row) {
    if (row.surface != Surface::smooth) return;
    const bool is_fine = row.least_radius == 0 || row.least_radius >= kLeastVoxels * row.voxel_size;
    const double depth_floor = kDepthFloor * row.voxel_size;
    row.fits_depth = is_fine && row.errors.depth_rms > kFloorFactor * depth_floor;
    row.fits_normal = is_fine && row.errors.normal_rms > kFloorFactor * kNormalFloor;
}

}  // namespace

const char* name_of(Surface surface) {
    switch (surface) {
        case Surface::cubes:
            return "cubes";
        case Surface::smooth:
            return "smooth";
        case Surface::exact:
            return "exact";
    }
    return "unknown";
}

void conclude(BenchReport& report) {
    for (BenchRow& row : report.rows) choose_fitted(row);
    for (size_t first = 0, end = 0; first < report.rows.size(); first = end) {
        const std::string scene = report.rows[first].scene;
        while (end < report.rows.size() && report.rows[end].scene == scene) ++end;
        const std::span<BenchRow> rows(report.rows.data() + first, end - first);
        mark_front(rows);
        for (const Surface surface : kBenchSurfaces)
            report.fits.push_back(
                {scene, surface,
                 fit_rows(rows, surface, &BenchRow::fits_depth, &BenchErrors::depth_rms),
                 fit_rows(rows, surface, &BenchRow::fits_normal, &BenchErrors::normal_rms)});
    }
}

size_t count_rows(const BenchOptions& options) {
    size_t count = 0;
    for (const BenchEntry* entry : options.subjects)
        count += planned_rows(options, *entry, entry->has_light).size();
    return count;
}

BenchReport run_bench(const Device& device, const BenchOptions& options,
                      const std::function<void(size_t, size_t)>& progress) {
    BenchReport report = describe(device, options);
    report.peers = options.peers;
    device.time_kernels(true);
    const size_t total = count_rows(options);
    for (const BenchEntry* entry : options.subjects) {
        const BenchSubject subject = entry->open();
        const BenchTruth truth = bench_truth(subject, options.size);
        for (const BenchRow& planned : planned_rows(options, *entry, entry->has_light)) {
            Scene scene = subject.scene(planned.surface, planned.resolution, options.size);
            scene.render.samples = planned.samples;
            BenchRow row = planned;
            row.least_radius = subject.least_radius;
            measure(device, scene, truth, options.repeats, row);
            report.rows.push_back(row);
            progress(report.rows.size(), total);
        }
    }
    conclude(report);
    return report;
}

}  // namespace voxelume
