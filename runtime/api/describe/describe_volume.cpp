// SPDX-License-Identifier: Apache-2.0
// What is in the file of a volumetric image.
#include "runtime/api/describe/describe.hpp"

#include <algorithm>
#include <array>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/json_text.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"
#include "runtime/io/volume/volume_kv6_read.hpp"
#include "runtime/io/volume_file.hpp"

namespace voxelume::api {

namespace {

namespace fs = std::filesystem;

/// Adds the display's keys as the frame's text has them, and the observer's position instead of its
/// matrix.
void add_volume_frame(Report& report, const VolumeFrame& frame) {
    const auto text = parse_json_text<Report>(write_frame_text(frame));
    report["layout"] = text["layout"];
    report["display"] = text["shape"];
    report["size"] = text["size"];
    if (frame.layout == VolumeLayout::lattice) {
        report["voxel edges"] = text["edge"];
        report["origin"] = text["origin"];
    } else {
        report["near"] = text["near"];
        report["step"] = text["step"];
    }
    const glm::dvec4 observer = frame.world_from_observer[3];
    report["observer"] = {observer.x, observer.y, observer.z};
}

/// The volume's JSON header, or nothing for another JSON file.
Report read_header(const InputFile& file) {
    constexpr uint64_t kLongestHeader = uint64_t{1} << 24;
    std::string text(std::min(file.size(), kLongestHeader), '\0');
    file.read(0, text.data(), text.size());
    const auto header = parse_json_text<Report>(text);
    return header.is_object() && header.contains("voxelume_volume") ? header : Report();
}

}  // namespace

Report describe_volume(const fs::path& path, const char* kind) {
    const Volume volume = read_volume(path);
    Report report = {{"kind", kind}};
    add_volume_frame(report, volume.frame);
    report["voxels"] = volume.indices.size();
    constexpr std::array kKinds = {"space", "object", "unseen"};
    for (size_t k = 0; k < kKinds.size(); ++k)
        report[fmt::format("{} voxels", kKinds[k])] =
            std::ranges::count(volume.kinds, static_cast<VoxelKind>(k));
    for (const auto& [name, text] : volume.attributes) report["attributes"][name] = text;
    return report;
}

Report describe_volume_header(const fs::path& path) {
    const InputFile file(path);
    const Report header = read_header(file);
    if (header.is_null())
        file.refuse(
            "is neither a scene, which has \"objects\", nor the header of a display's volume");
    if (header.value("format", Report()) == "raw") return describe_volume(path, "raw volume");
    Report report = {{"kind", "header of a display's volume"}};
    for (const char* key : {"format", "data", "shape", "axes", "bits", "dither", "bytes"})
        if (header.contains(key))
            report[key == std::string("bytes") ? "data bytes" : key] = header[key];
    if (header.contains(kFrameKey))
        add_volume_frame(report, read_frame_text(header[kFrameKey].dump(), path.string()));
    return report;
}

Report describe_kv6(const fs::path& path) {
    const Kv6Summary kv6 = read_kv6_summary(path);
    Report report = {{"kind", "KV6 voxel model"}, {"size", kv6.size}, {"voxels", kv6.voxels}};
    if (kv6.has_palette) report["palette"] = true;
    return report;
}

}  // namespace voxelume::api
