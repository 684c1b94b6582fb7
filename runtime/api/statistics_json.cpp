// SPDX-License-Identifier: Apache-2.0
// Statistics -> JSON, in the order in which people read them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/base/files/stamp.hpp"
#include "runtime/base/version.hpp"
#include "runtime/voxelume/statistics.hpp"

namespace voxelume::v1 {
namespace {

using Json = nlohmann::ordered_json;

Json seconds_of(const StageSeconds& seconds) {
    return {{"load", seconds.load},   {"voxelize", seconds.voxelize}, {"place", seconds.place},
            {"index", seconds.index}, {"cache", seconds.cache},       {"image", seconds.image}};
}

/// The work of a frame, and the parts that it reused from the frame before.
Json json_of(const FrameStatistics& frame) {
    return {{"frame", frame.frame},
            {"device", frame.device},
            {"world", name_of(frame.world)},
            {"image", name_of(frame.image)},
            {"meshes_read", frame.meshes_read},
            {"voxelized", frame.voxelized},
            {"models_from_cache", frame.models_from_cache},
            {"painted_bricks", frame.painted_bricks},
            {"world_from_cache", frame.world_from_cache},
            {"instances_moved", frame.instances_moved},
            {"moments", frame.moments},
            {"instance_models_indexed", frame.instance_models_indexed},
            {"seconds", seconds_of(frame.seconds)}};
}

void add_devices(const Statistics& statistics, Json& json) {
    if (statistics.devices.empty()) return;
    const DeviceStatistics& first = statistics.devices.front();
    json["device"] = first.name;
    json["driver"] = first.driver;
    json["lanes"] = first.lanes;
    json["devices"] = Json::array();
    for (const DeviceStatistics& device : statistics.devices)
        json["devices"].push_back({{"name", device.name},
                                   {"compute_units", device.compute_units},
                                   {"lanes", device.lanes}});
}

void add_rays(const RayCounts& rays, Json& json) {
    json["sight_rays"] = rays.sight_rays;
    json["beams"] = rays.beams;
    json["clear_beams"] = rays.clear_beams;
    json["display_lines"] = rays.display_lines;
    json["clear_display_lines"] = rays.clear_display_lines;
    json["contrasting_pixels"] = rays.contrasting_pixels;
    json["shadow_rays"] = rays.shadow_rays;
    json["light_beams"] = rays.light_beams;
    json["secondary_rays"] = rays.secondary_rays;
    json["ended_paths"] = rays.ended_paths;
    json["medium_overflows"] = rays.medium_overflows;
    json["not_finite"] = rays.not_finite;
    if (rays.noise) json["noise"] = *rays.noise;
    if (rays.volume_noise) json["volume_noise"] = *rays.volume_noise;
}

Json json_of(const std::vector<Warning>& warnings) {
    Json list = Json::array();
    for (const Warning& warning : warnings)
        list.push_back(
            {{"kind", name_of(warning.kind)}, {"where", warning.where}, {"text", warning.text}});
    return list;
}

void add_frames(const Statistics& statistics, Json& json) {
    if (statistics.one_by_one_from) json["one_by_one_from"] = *statistics.one_by_one_from;
    const auto& frames = statistics.frames;
    const auto first = std::ranges::find(frames, true, &FrameStatistics::keeps_nothing);
    if (first != frames.end()) json["nothing_kept_from"] = first->frame;
    json["frames"] = Json::array();
    for (const FrameStatistics& frame : frames) json["frames"].push_back(json_of(frame));
}

}  // namespace

std::string to_json(const Statistics& statistics) {
    Json json;
    json["version"] = voxelume::version();
    json["checksum"] = stamp_of(kNoFrame);
    add_devices(statistics, json);
    json["size"] = {statistics.size[0], statistics.size[1]};
    json["bands"] = statistics.bands;
    if (statistics.volume_size) json["volume_size"] = *statistics.volume_size;
    json["files"] = statistics.files;
    json["warnings"] = json_of(statistics.warnings);
    json["voxels"] = statistics.voxels;
    json["triangles"] = statistics.triangles;
    json["culled_objects"] = statistics.culled_objects;
    add_rays(statistics.rays, json);
    json["world_bytes"] = statistics.world_bytes;
    if (const InstanceCounts& i = statistics.instances; i.instances > 0)
        json["instances"] = {{"number", i.instances},
                             {"models", i.models},
                             {"model_voxels", i.voxels},
                             {"model_bytes", i.bytes},
                             {"seconds", i.seconds}};
    json["peak_device_bytes"] = statistics.peak_device_bytes;
    json["seconds"] = seconds_of(statistics.seconds);
    json["seconds"]["open"] = statistics.open_seconds;
    json["seconds"]["write"] = statistics.write_seconds;
    json["seconds"]["total"] = statistics.total_seconds;
    add_frames(statistics, json);
    json["kernel_ms"] = statistics.kernel_ms;
    json["launches"] = statistics.launches;
    json["allocated_bytes"] = statistics.allocated_bytes;
    json["programs"] = {{"made", statistics.programs_made},
                        {"from_cache", statistics.programs_from_cache},
                        {"ms", statistics.programs_ms}};
    // A device's name may be in any encoding.
    std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    seal(text);
    return text;
}

}  // namespace voxelume::v1
