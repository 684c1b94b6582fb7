// SPDX-License-Identifier: Apache-2.0
// What is in the file of a volumetric image.
#include "runtime/api/describe/describe.hpp"

#include <algorithm>
#include <array>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/files/stamp.hpp"
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

/// The first bytes of a file, or all of a shorter one.
std::string read_start(const InputFile& file, uint64_t max_bytes) {
    std::string text(std::min(file.size(), max_bytes), '\0');
    file.read(0, text.data(), text.size());
    return text;
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

Report describe_json(const fs::path& path) {
    constexpr uint64_t kLongestHeader = uint64_t{1} << 24;
    const InputFile file(path);
    const auto header = parse_json_text<Report>(read_start(file, kLongestHeader));
    if (header.is_object() && header.contains("kernel_ms")) return describe_statistics(header);
    if (!header.is_object() || !header.contains("voxelume_volume"))
        file.refuse(
            "is neither a scene, which has \"objects\", nor the header of a display's volume, nor "
            "statistics");
    if (header.value("format", Report()) == "raw") return describe_volume(path, "raw volume");
    Report report = {{"kind", "header of a display's volume"}};
    for (const char* key : {"format", "data", "shape", "axes", "bits", "dither", "bytes"})
        if (header.contains(key))
            report[key == std::string("bytes") ? "data bytes" : key] = header[key];
    if (header.contains(kFrameKey))
        add_volume_frame(report, read_frame_text(header[kFrameKey].dump(), path.string()));
    return report;
}

Report describe_page(const fs::path& path) {
    constexpr uint64_t kLongestHead = 1 << 16;
    constexpr std::string_view kBegin = "<title>", kEnd = "</title>";
    const InputFile file(path);
    const std::string head = read_start(file, kLongestHead);
    const size_t begin = head.find(kBegin), end = head.find(kEnd);
    if (!stamp_check_offset(head) || begin == head.npos || end == head.npos || end < begin)
        file.refuse("is no page of a volumetric image");
    const size_t title = begin + kBegin.size();
    return {{"kind", "page of a volumetric image"}, {"title", head.substr(title, end - title)}};
}

Report describe_kv6(const fs::path& path) {
    const Kv6Summary kv6 = read_kv6_summary(path);
    Report report = {{"kind", "KV6 voxel model"}, {"size", kv6.size}, {"voxels", kv6.voxels}};
    if (kv6.has_palette) report["palette"] = true;
    return report;
}

}  // namespace voxelume::api
