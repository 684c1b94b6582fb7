// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/shared/tell.hpp"

namespace voxelume::cli {
namespace {

/// Formats devices as "a", or as "a" and 2 more.
std::string names_of(const Statistics& statistics) {
    const std::string first = fmt::format("\"{}\"", statistics.devices[0].name);
    const size_t more = statistics.devices.size() - 1;
    return more == 0 ? first : fmt::format("{} and {} more", first, more);
}

/// Formats a count as "845", "84.5 k" or "8.45 M".
std::string count_text(uint64_t count) {
    const double n = double(count);
    if (n < 1e4) return fmt::format("{}", count);
    return n < 1e6 ? fmt::format("{:.1f} k", n / 1e3) : fmt::format("{:.2f} M", n / 1e6);
}

/// Formats sizes as "640x480", "64x48x256 voxels", or both.
std::string size_text(const Statistics& statistics) {
    std::string image = fmt::format("{}", fmt::join(statistics.size, "x"));
    if (!statistics.volume_size) return image;
    const std::string volume = fmt::format("{} voxels", fmt::join(*statistics.volume_size, "x"));
    return statistics.images ? image + " and " + volume : volume;
}

/// Says how many frames reused what, if there are several frames.
std::string reuse_text(const std::vector<FrameStatistics>& frames) {
    if (frames.size() < 2) return "";
    const auto worlds = [&](WorldReuse reuse) {
        return std::ranges::count(frames, reuse, &FrameStatistics::world);
    };
    const auto images = [&](ImageReuse reuse) {
        return std::ranges::count(frames, reuse, &FrameStatistics::image);
    };
    return fmt::format(
        "{} frames ({} worlds built, {} with instances moved; {} traced, {} shaded, {} still); ",
        frames.size(), worlds(WorldReuse::built), worlds(WorldReuse::instances_moved),
        images(ImageReuse::traced), images(ImageReuse::shaded), images(ImageReuse::kept));
}

/// Says for what memory was too small.
void print_lacks(const Statistics& statistics) {
    if (statistics.bands > 1)
        tell("  {} bands of rows: memory doesn't suffice for a whole image\n", statistics.bands);
    if (statistics.one_by_one_from)
        tell("  one frame at a time from frame {} on: memory doesn't suffice for two\n",
             *statistics.one_by_one_from);
    const std::vector<FrameStatistics>& frames = statistics.frames;
    const auto count = std::ranges::count(frames, true, &FrameStatistics::keeps_nothing);
    if (count == 0) return;
    const auto first = std::ranges::find(frames, true, &FrameStatistics::keeps_nothing);
    tell(
        "  {} of {} frames keep nothing for the next, frame {} the first: memory "
        "doesn't suffice\n",
        count, frames.size(), first->frame);
}

}  // namespace

void print_summary(const Statistics& statistics) {
    const RayCounts& rays = statistics.rays;
    const StageSeconds& seconds = statistics.seconds;
    const std::string secondary =
        rays.secondary_rays > 0
            ? fmt::format(", {} secondary rays ({} paths ended early)",
                          count_text(rays.secondary_rays), count_text(rays.ended_paths))
            : "";
    std::string quality;
    if (rays.noise) quality = fmt::format(", noise {:.3f}", *rays.noise);
    if (rays.volume_noise) quality += fmt::format(", volume noise {:.3f}", *rays.volume_noise);
    if (rays.contrasting_pixels > 0)
        quality += fmt::format(", {} contrasting pixels", count_text(rays.contrasting_pixels));
    tell(
        "{} in {:.2f} s on {}: {}{} voxels, {} sight and {} shadow rays{}{}; "
        "open {:.0f} ms, load {:.0f}, voxelize {:.0f}, place {:.0f}, index {:.0f}, image {:.0f}, "
        "write {:.0f}\n",
        size_text(statistics), statistics.total_seconds, names_of(statistics),
        reuse_text(statistics.frames), count_text(statistics.voxels), count_text(rays.sight_rays),
        count_text(rays.shadow_rays), secondary, quality, statistics.open_seconds * 1e3,
        seconds.load * 1e3, seconds.voxelize * 1e3, seconds.place * 1e3, seconds.index * 1e3,
        seconds.image * 1e3, statistics.write_seconds * 1e3);
}

void print_details(const Statistics& statistics) {
    const DeviceStatistics& device = statistics.devices[0];
    tell("  {} lanes, driver {}; {} triangles; world {:.1f} MB, at most {:.1f} MB\n", device.lanes,
         device.driver, statistics.triangles, double(statistics.world_bytes) / 1e6,
         double(statistics.peak_device_bytes) / 1e6);
    tell("  {} programs in {:.0f} ms, {} of them compiled before\n", statistics.programs_made,
         statistics.programs_ms, statistics.programs_from_cache);
    if (statistics.culled_objects > 0)
        tell("  {} objects out of every ray's reach, not voxelized\n", statistics.culled_objects);
    print_lacks(statistics);
    if (statistics.frames.size() > 1)
        for (const FrameStatistics& frame : statistics.frames)
            tell(
                "  frame {:<5} world {}: {} voxelized, {} bricks painted, {} instances "
                "moved; image {}\n",
                frame.frame, frame.world == WorldReuse::built ? "built" : name_of(frame.world),
                frame.voxelized, frame.painted_bricks, frame.instances_moved, name_of(frame.image));
    for (const auto& [kernel, ms] : statistics.kernel_ms)
        tell("  {:<24}{:>10.2f} ms {:>6} launches\n", kernel, ms, statistics.launches.at(kernel));
}

}  // namespace voxelume::cli
