#include "cli/render_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/analysis/medium_set.hpp"
#include "runtime/base/atomic_file.hpp"
#include "runtime/base/version.hpp"

namespace voxelume::cli {
namespace {

/// Times and rays of all frames together; of sizes the largest.
RenderReport sum_of(const std::vector<FrameReport>& frames) {
    RenderReport sum;
    for (const FrameReport& frame : frames) {
        const RenderReport& report = frame.report;
        sum.world.load_seconds += report.world.load_seconds;
        sum.world.voxelize_seconds += report.world.voxelize_seconds;
        sum.world.place_seconds += report.world.place_seconds;
        sum.world.index_seconds += report.world.index_seconds;
        sum.world.keep_seconds += report.world.keep_seconds;
        sum.world.triangles = std::max(sum.world.triangles, report.world.triangles);
        sum.world.culled = std::max(sum.world.culled, report.world.culled);
        if (report.world.instances.instances >= sum.world.instances.instances)
            sum.world.instances = report.world.instances;
        sum.image_seconds += report.image_seconds;
        sum.voxels = std::max(sum.voxels, report.voxels);
        sum.world_bytes = std::max(sum.world_bytes, report.world_bytes);
        add_counts(report, sum);
    }
    return sum;
}

/// All devices' counters together.
DeviceCounters counters_of(const Outcome& outcome) {
    DeviceCounters sum;
    for (const Device& device : outcome.devices) {
        const DeviceCounters& counters = device.counters();
        for (const auto& [name, count] : counters.launches) sum.launches[name] += count;
        for (const auto& [name, ms] : counters.kernel_ms) sum.kernel_ms[name] += ms;
        for (const auto& [name, bytes] : counters.allocated_bytes)
            sum.allocated_bytes[name] += bytes;
        sum.peak_bytes += counters.peak_bytes;
        sum.programs_built += counters.programs_built;
        sum.programs_from_cache += counters.programs_from_cache;
        sum.build_ms += counters.build_ms;
    }
    return sum;
}

/// "a" or "a" and 2 more devices
std::string names_of(const Outcome& outcome) {
    const std::string first = fmt::format("\"{}\"", outcome.devices[0].info().name);
    const size_t more = outcome.devices.size() - 1;
    return more == 0 ? first : fmt::format("{} and {} more", first, more);
}

nlohmann::ordered_json seconds_of(const RenderReport& report) {
    return {{"load", report.world.load_seconds},   {"voxelize", report.world.voxelize_seconds},
            {"place", report.world.place_seconds}, {"index", report.world.index_seconds},
            {"cache", report.world.keep_seconds},  {"image", report.image_seconds}};
}

const char* world_text(const FrameReport& frame) {
    switch (frame.report.world.change) {
        case WorldChange::none:
            return "kept";
        case WorldChange::instances:
            return "instances moved";
        case WorldChange::built:
            return "formed";
    }
    return "";
}

const char* image_text(const FrameReport& frame) {
    if (frame.report.is_kept) return "kept";
    return frame.report.hits_are_kept ? "shaded" : "traced";
}

/// What a frame did anew, and what it took over from the frame before.
nlohmann::ordered_json frame_statistics(const FrameReport& frame) {
    const RenderReport& report = frame.report;
    return {{"frame", frame.frame},
            {"device", frame.device},
            {"world", world_text(frame)},
            {"image", image_text(frame)},
            {"meshes_read", report.world.meshes_read},
            {"voxelized", report.world.voxelized},
            {"models_from_cache", report.world.from_cache},
            {"painted_bricks", report.world.painted_bricks},
            {"world_from_cache", report.world.is_from_cache},
            {"instances_moved", report.world.instances.moved},
            {"instance_models_indexed", report.world.instances.indexed},
            {"seconds", seconds_of(report)}};
}

/// The frames that had no room for what their device's next one may use of them.
std::vector<int> frames_that_keep_nothing(const std::vector<FrameReport>& frames) {
    std::vector<int> numbers;
    for (auto frame = frames.begin(); frame != frames.end(); ++frame) {
        const bool has_next = std::any_of(frame + 1, frames.end(), [&](const FrameReport& later) {
            return later.device == frame->device;
        });
        if (has_next && frame->report.world.lacks_room) numbers.push_back(frame->frame);
    }
    return numbers;
}

nlohmann::ordered_json statistics(const Outcome& outcome) {
    const DeviceCounters counters = counters_of(outcome);
    const RenderReport report = sum_of(outcome.frames);
    nlohmann::ordered_json json;
    json["version"] = version();
    const Device& first = outcome.devices[0];
    json["device"] = first.info().name;
    json["driver"] = first.info().driver;
    json["lanes"] = first.lanes();
    json["devices"] = nlohmann::ordered_json::array();
    for (const Device& device : outcome.devices)
        json["devices"].push_back({{"name", device.info().name},
                                   {"compute_units", device.info().compute_units},
                                   {"lanes", device.lanes()}});
    json["size"] = {outcome.size.x, outcome.size.y};
    json["files"] = outcome.files;
    json["voxels"] = report.voxels;
    json["triangles"] = report.world.triangles;
    json["culled_objects"] = report.world.culled;
    json["sight_rays"] = report.sight_rays;
    json["beams"] = report.beams;
    json["clear_beams"] = report.clear_beams;
    json["display_lines"] = report.display_lines;
    json["clear_display_lines"] = report.clear_display_lines;
    json["shadow_rays"] = report.shadow_rays;
    json["light_beams"] = report.light_beams;
    json["secondary_rays"] = report.secondary_rays;
    json["ended_paths"] = report.ended_paths;
    json["medium_overflows"] = report.medium_overflows;
    json["not_finite"] = report.not_finite;
    json["world_bytes"] = report.world_bytes;
    if (const InstanceReport& i = report.world.instances; i.instances > 0)
        json["instances"] = {{"number", i.instances},
                             {"models", i.models},
                             {"model_voxels", i.voxels},
                             {"model_bytes", i.bytes},
                             {"seconds", i.seconds}};
    json["peak_device_bytes"] = counters.peak_bytes;
    json["seconds"] = seconds_of(report);
    json["seconds"]["open"] = outcome.open_seconds;
    json["seconds"]["write"] = outcome.write_seconds;
    json["seconds"]["total"] = outcome.seconds;
    if (outcome.one_by_one_from) json["one_by_one_from"] = *outcome.one_by_one_from;
    if (const std::vector<int> frames = frames_that_keep_nothing(outcome.frames); !frames.empty())
        json["nothing_kept_from"] = frames.front();
    json["frames"] = nlohmann::ordered_json::array();
    for (const FrameReport& frame : outcome.frames)
        json["frames"].push_back(frame_statistics(frame));
    json["kernel_ms"] = counters.kernel_ms;
    json["launches"] = counters.launches;
    json["allocated_bytes"] = counters.allocated_bytes;
    json["programs"] = {{"made", counters.programs_built},
                        {"from_cache", counters.programs_from_cache},
                        {"ms", counters.build_ms}};
    return json;
}

/// "845", "84.5 k", "8.45 M"
std::string count_text(uint64_t count) {
    const double n = double(count);
    if (n < 1e4) return fmt::format("{}", count);
    return n < 1e6 ? fmt::format("{:.1f} k", n / 1e3) : fmt::format("{:.2f} M", n / 1e6);
}

/// How many frames took over what, where there are several.
std::string reuse_text(const std::vector<FrameReport>& frames) {
    if (frames.size() < 2) return "";
    const auto count = [&](auto&& is_so) { return std::ranges::count_if(frames, is_so); };
    const auto worlds = [&](WorldChange change) {
        return count([=](const FrameReport& frame) { return frame.report.world.change == change; });
    };
    const auto still = count([](const FrameReport& frame) { return frame.report.is_kept; });
    const auto hits = count([](const FrameReport& frame) { return frame.report.hits_are_kept; });
    return fmt::format(
        "{} frames ({} worlds formed, {} with instances moved; {} traced, {} shaded, {} still); ",
        frames.size(), worlds(WorldChange::built), worlds(WorldChange::instances),
        int64_t(frames.size()) - hits, hits - still, still);
}

}  // namespace

void write_statistics(const std::string& path, const Outcome& outcome) {
    AtomicFile file(path);
    // The device's name may be in any encoding.
    const std::string text =
        statistics(outcome).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
        "\n";
    file.write(text.data(), text.size());
    file.commit();
}

void print_summary(const Outcome& outcome) {
    const RenderReport report = sum_of(outcome.frames);
    const std::string secondary =
        report.secondary_rays > 0
            ? fmt::format(", {} secondary rays ({} paths ended early)",
                          count_text(report.secondary_rays), count_text(report.ended_paths))
            : "";
    fmt::print(
        stderr,
        "{}x{} in {:.2f} s on {}: {}{} voxels, {} sight and {} shadow rays{}; "
        "open {:.0f} ms, load {:.0f}, voxelize {:.0f}, place {:.0f}, index {:.0f}, image {:.0f}, "
        "write {:.0f}\n",
        outcome.size.x, outcome.size.y, outcome.seconds, names_of(outcome),
        reuse_text(outcome.frames), count_text(report.voxels), count_text(report.sight_rays),
        count_text(report.shadow_rays), secondary, outcome.open_seconds * 1e3,
        report.world.load_seconds * 1e3, report.world.voxelize_seconds * 1e3,
        report.world.place_seconds * 1e3, report.world.index_seconds * 1e3,
        report.image_seconds * 1e3, outcome.write_seconds * 1e3);
}

void print_details(const Outcome& outcome) {
    const DeviceCounters counters = counters_of(outcome);
    const RenderReport report = sum_of(outcome.frames);
    fmt::print(stderr, "  {} lanes, driver {}; {} triangles; world {:.1f} MB, at most {:.1f} MB\n",
               outcome.devices[0].lanes(), outcome.devices[0].info().driver, report.world.triangles,
               double(report.world_bytes) / 1e6, double(counters.peak_bytes) / 1e6);
    fmt::print(stderr, "  {} programs in {:.0f} ms, {} of them compiled before\n",
               counters.programs_built, counters.build_ms, counters.programs_from_cache);
    if (report.world.culled > 0)
        fmt::print(stderr, "  {} objects out of every ray's reach, not voxelized\n",
                   report.world.culled);
    if (outcome.one_by_one_from)
        fmt::print(stderr,
                   "  one frame at a time from frame {} on: memory doesn't suffice for two\n",
                   *outcome.one_by_one_from);
    if (const std::vector<int> frames = frames_that_keep_nothing(outcome.frames); !frames.empty())
        fmt::print(stderr,
                   "  {} of {} frames keep nothing for the next, frame {} the first: memory "
                   "doesn't suffice\n",
                   frames.size(), outcome.frames.size(), frames.front());
    if (outcome.frames.size() > 1)
        for (const FrameReport& frame : outcome.frames)
            fmt::print(stderr,
                       "  frame {:<5} world {}: {} voxelized, {} bricks painted, {} instances "
                       "moved; image {}\n",
                       frame.frame, world_text(frame), frame.report.world.voxelized,
                       frame.report.world.painted_bricks, frame.report.world.instances.moved,
                       image_text(frame));
    for (const auto& [kernel, ms] : counters.kernel_ms)
        fmt::print(stderr, "  {:<24}{:>10.2f} ms {:>6} launches\n", kernel, ms,
                   counters.launches.at(kernel));
}

}  // namespace voxelume::cli
