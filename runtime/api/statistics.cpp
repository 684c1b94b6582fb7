// SPDX-License-Identifier: Apache-2.0
// Reports of frames and counters of devices -> statistics for callers.
#include "runtime/voxelume/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/api/render.hpp"

namespace voxelume {
namespace {

v1::StageSeconds seconds_of(const RenderReport& report) {
    return {report.world.load_seconds,  report.world.voxelize_seconds, report.world.place_seconds,
            report.world.index_seconds, report.world.keep_seconds,     report.image_seconds};
}

void add(const v1::StageSeconds& seconds, v1::StageSeconds& sum) {
    sum.load += seconds.load;
    sum.voxelize += seconds.voxelize;
    sum.place += seconds.place;
    sum.index += seconds.index;
    sum.cache += seconds.cache;
    sum.image += seconds.image;
}

std::optional<double> mean_of(const NoiseReached& noise) {
    return noise.tiles > 0 ? std::optional(noise.mean()) : std::nullopt;
}

v1::RayCounts rays_of(const RenderReport& report) {
    return {.sight_rays = report.sight_rays,
            .beams = report.beams,
            .clear_beams = report.clear_beams,
            .display_lines = report.display_lines,
            .clear_display_lines = report.clear_display_lines,
            .contrasting_pixels = report.contrasting_pixels,
            .shadow_rays = report.shadow_rays,
            .light_beams = report.light_beams,
            .secondary_rays = report.secondary_rays,
            .ended_paths = report.ended_paths,
            .medium_overflows = report.medium_overflows,
            .not_finite = report.not_finite,
            .noise = mean_of(report.noise),
            .volume_noise = mean_of(report.volume_noise)};
}

/// The root mean square of two means over so many images; one may be missing.
std::optional<double> joint_mean(std::optional<double> a, size_t of_a, std::optional<double> b,
                                 size_t of_b) {
    if (!a || !b) return a ? a : b;
    return std::sqrt((double(of_a) * *a * *a + double(of_b) * *b * *b) / double(of_a + of_b));
}

void add_rays(const v1::RayCounts& rays, v1::RayCounts& sum) {
    sum.sight_rays += rays.sight_rays;
    sum.beams += rays.beams;
    sum.clear_beams += rays.clear_beams;
    sum.display_lines += rays.display_lines;
    sum.clear_display_lines += rays.clear_display_lines;
    sum.contrasting_pixels += rays.contrasting_pixels;
    sum.shadow_rays += rays.shadow_rays;
    sum.light_beams += rays.light_beams;
    sum.secondary_rays += rays.secondary_rays;
    sum.ended_paths += rays.ended_paths;
    sum.medium_overflows += rays.medium_overflows;
    sum.not_finite += rays.not_finite;
}

v1::WorldReuse reuse_of(WorldChange change) {
    switch (change) {
        case WorldChange::none:
            return v1::WorldReuse::kept;
        case WorldChange::instances:
            return v1::WorldReuse::instances_moved;
        case WorldChange::built:
            break;
    }
    return v1::WorldReuse::built;
}

/// Adds a frame's times, and takes its sizes where they are the largest so far.
void add_report(const RenderReport& report, v1::Statistics& sum) {
    add(seconds_of(report), sum.seconds);
    sum.voxels = std::max(sum.voxels, report.voxels);
    sum.world_bytes = std::max(sum.world_bytes, report.world_bytes);
    sum.triangles = std::max(sum.triangles, report.world.triangles);
    sum.culled_objects = std::max(sum.culled_objects, report.world.culled);
    const InstanceReport& i = report.world.instances;
    if (i.instances >= sum.instances.instances)
        sum.instances = {i.instances, i.models, i.voxels, i.bytes, i.seconds};
}

void add_counters(const DeviceCounters& counters, v1::Statistics& sum) {
    for (const auto& [name, count] : counters.launches) sum.launches[name] += count;
    for (const auto& [name, ms] : counters.kernel_ms) sum.kernel_ms[name] += ms;
    for (const auto& [name, bytes] : counters.allocated_bytes) sum.allocated_bytes[name] += bytes;
    sum.peak_device_bytes += counters.peak_bytes;
    sum.programs_made += counters.programs_built;
    sum.programs_from_cache += counters.programs_from_cache;
    sum.programs_ms += counters.build_ms;
}

}  // namespace

const char* v1::name_of(WorldReuse world) {
    switch (world) {
        case WorldReuse::kept:
            return "kept";
        case WorldReuse::instances_moved:
            return "instances moved";
        case WorldReuse::built:
            break;
    }
    return "formed";
}

const char* v1::name_of(ImageReuse image) {
    return image == ImageReuse::kept ? "kept" : image == ImageReuse::shaded ? "shaded" : "traced";
}

void v1::add_statistics(const Statistics& later, Statistics& sum) {
    if (sum.frames.empty()) {
        const double open_seconds = sum.open_seconds + later.open_seconds;
        sum = later;
        sum.open_seconds = open_seconds;
        return;
    }
    const size_t before = sum.frames.size(), more = later.frames.size();
    add_rays(later.rays, sum.rays);
    sum.rays.noise = joint_mean(sum.rays.noise, before, later.rays.noise, more);
    sum.rays.volume_noise =
        joint_mean(sum.rays.volume_noise, before, later.rays.volume_noise, more);
    add(later.seconds, sum.seconds);
    sum.open_seconds += later.open_seconds;
    sum.write_seconds += later.write_seconds;
    sum.total_seconds += later.total_seconds;
    sum.files += later.files;
    sum.bands = std::max(sum.bands, later.bands);
    sum.voxels = std::max(sum.voxels, later.voxels);
    sum.triangles = std::max(sum.triangles, later.triangles);
    sum.culled_objects = std::max(sum.culled_objects, later.culled_objects);
    sum.world_bytes = std::max(sum.world_bytes, later.world_bytes);
    if (later.instances.instances >= sum.instances.instances) sum.instances = later.instances;
    if (!sum.one_by_one_from) sum.one_by_one_from = later.one_by_one_from;
    sum.frames.insert(sum.frames.end(), later.frames.begin(), later.frames.end());
    for (const Warning& warning : later.warnings)
        if (std::ranges::none_of(sum.warnings, [&](const Warning& known) {
                return known.where == warning.where && known.text == warning.text;
            }))
            sum.warnings.push_back(warning);
    sum.peak_device_bytes = later.peak_device_bytes;
    sum.launches = later.launches;
    sum.kernel_ms = later.kernel_ms;
    sum.allocated_bytes = later.allocated_bytes;
    sum.programs_made = later.programs_made;
    sum.programs_from_cache = later.programs_from_cache;
    sum.programs_ms = later.programs_ms;
}

v1::FrameStatistics api::statistics_of(const FrameReport& frame) {
    const RenderReport& report = frame.report;
    v1::FrameStatistics result;
    result.frame = frame.frame;
    result.device = frame.device;
    result.world = reuse_of(report.world.change);
    result.image = report.is_kept         ? v1::ImageReuse::kept
                   : report.hits_are_kept ? v1::ImageReuse::shaded
                                          : v1::ImageReuse::traced;
    result.meshes_read = report.world.meshes_read;
    result.voxelized = report.world.voxelized;
    result.models_from_cache = report.world.from_cache;
    result.painted_bricks = report.world.painted_bricks;
    result.world_from_cache = report.world.is_from_cache;
    result.instances_moved = report.world.instances.moved;
    result.instance_models_indexed = report.world.instances.indexed;
    result.keeps_nothing = report.world.lacks_room;
    result.moments = std::max(report.moments, 1u);
    result.seconds = seconds_of(report);
    return result;
}

v1::Statistics api::statistics_of(std::span<const FrameReport> frames,
                                  std::span<const Device> devices) {
    v1::Statistics sum;
    RenderReport counts;
    for (const FrameReport& frame : frames) {
        add_report(frame.report, sum);
        add_counts(frame.report, counts);
        sum.frames.push_back(statistics_of(frame));
    }
    sum.rays = rays_of(counts);
    for (const Device& device : devices) {
        const DeviceInfo& info = device.info();
        sum.devices.push_back({info.name, info.driver, info.compute_units, device.lanes()});
        add_counters(device.counters(), sum);
    }
    // The last frame of a device has no later frame that could use what it keeps.
    for (auto frame = sum.frames.begin(); frame != sum.frames.end(); ++frame)
        frame->keeps_nothing &= std::any_of(
            frame + 1, sum.frames.end(),
            [&](const v1::FrameStatistics& later) { return later.device == frame->device; });
    return sum;
}

}  // namespace voxelume
