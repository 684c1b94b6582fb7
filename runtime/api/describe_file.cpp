// SPDX-License-Identifier: Apache-2.0
// What is in a file, for callers: by what it begins with.
#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/api/border/process.hpp"
#include "runtime/api/describe/describe.hpp"

#include "runtime/base/error.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/json_text.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"
#include "runtime/io/volume/volume_json.hpp"
#include "runtime/io/voxels/model_file.hpp"
#include "runtime/voxelume/files.hpp"

namespace voxelume::api {

namespace {

namespace fs = std::filesystem;

template <class Vector>
Report numbers(const Vector& v) {
    return {v.x, v.y, v.z};
}

template <class Values>
Report describe_plane(const std::string& name, const std::string& type, const Values& plane) {
    double smallest = 0.0, largest = 0.0, sum = 0.0;
    size_t finite = 0;
    for (const auto value : plane) {
        const double v = value;
        if (!std::isfinite(v)) continue;
        smallest = finite == 0 ? v : std::min(smallest, v);
        largest = finite == 0 ? v : std::max(largest, v);
        sum += v;
        ++finite;
    }
    Report row = {{"channel", name}, {"type", type}, {"min", nullptr}, {"max", nullptr}};
    row["mean"] = nullptr;
    row["not finite"] = plane.size() - finite;
    if (finite == 0) return row;
    row["min"] = smallest;
    row["max"] = largest;
    row["mean"] = sum / static_cast<double>(finite);
    return row;
}

Report describe_exr(const fs::path& path) {
    const ExrHeader header = read_exr_header(path);
    if (header.attributes.contains(kFrameKey)) return describe_volume(path, "deep OpenEXR volume");
    Report report = {{"kind", "OpenEXR image"},
                     {"size", {header.width, header.height}},
                     {"layout", header.layout},
                     {"compression", header.compression}};
    for (const auto& [name, text] : header.attributes) report["attributes"][name] = text;
    const bool reads_all = std::ranges::all_of(header.parts, &ExrPartHeader::is_read);
    for (const ExrPartHeader& part : header.parts) {
        Report row = {{"part", part.name},
                      {"channels", fmt::format("{}", fmt::join(part.channels, " "))}};
        if (!reads_all) row["read"] = part.is_read;
        report["parts"].push_back(row);
    }
    report["channels"] = Report::array();
    if (header.layout.starts_with("deep") || !fits_memory(header)) {
        for (const auto& [name, type] : header.channels)
            report["channels"].push_back({{"channel", name}, {"type", type}});
        return report;
    }
    const Image image = read_exr(path);
    for (const auto& [name, plane] : image.planes)
        report["channels"].push_back(describe_plane(name, header.channels.at(name), plane));
    for (const auto& [name, plane] : image.id_planes)
        report["channels"].push_back(describe_plane(name, header.channels.at(name), plane));
    return report;
}

Report describe_png(const fs::path& path) {
    const Picture picture = read_png(path);
    constexpr std::array kNames = {"R", "G", "B", "A"};
    Report report = {{"kind", "PNG picture"}, {"size", {picture.width, picture.height}}};
    for (size_t channel = 0; channel < kNames.size(); ++channel) {
        std::vector<uint8_t> plane;
        plane.reserve(picture.pixels.size());
        for (const auto& pixel : picture.pixels) plane.push_back(pixel[channel]);
        report["channels"].push_back(describe_plane(kNames[channel], "8 bit", plane));
    }
    return report;
}

Report describe_vdb(const fs::path& path) {
    Report report = {{"kind", "OpenVDB volume"}};
    const VdbFileSummary summary = read_vdb_summary(path);
    if (summary.metadata.contains(kFrameKey)) report = describe_volume(path, "OpenVDB volume");
    report["grids"] = Report::array();
    for (const VdbSummary& grid : summary.grids)
        report["grids"].push_back({{"grid", grid.name},
                                   {"type", grid.value_type},
                                   {"class", grid.grid_class},
                                   {"voxels", grid.active_voxels},
                                   {"min", numbers(grid.min)},
                                   {"max", numbers(grid.max)},
                                   {"voxel edges", numbers(grid.voxel_edges)}});
    return report;
}

Report describe_model(const fs::path& path) {
    const ModelSummary model = read_model_summary(path);
    Report report = {{"kind", "voxelized model"}, {"arrays", Report::array()}};
    for (const auto& [key, value] : model.header) report["header"][key] = value;
    for (const auto& [name, array] : model.arrays)
        report["arrays"].push_back({{"array", name},
                                    {"type", element_name(array.type)},
                                    {"count", array.count},
                                    {"bytes", array.count * element_bytes(array.type)},
                                    {"compressed", array.compressed_bytes}});
    return report;
}

/// Raw data, or those of a display's own format, which the header beside them describes.
Report describe_volume_data(const fs::path& path) {
    return describe_json(header_path_of(path));
}

bool is_volume_data(const fs::path& path) {
    constexpr std::array kEndings = {".raw", ".planes", ".cplanes", ".rgb332", ".rgb565"};
    std::error_code error;
    return std::ranges::find(kEndings, ending_of(path)) != kEndings.end() &&
           fs::is_regular_file(header_path_of(path), error);
}

/// A volumetric image of ours, or what is in a file of an array.
Report describe_voxel_file(const fs::path& path) {
    if (is_volume_nrrd(path)) return describe_volume(path, "NRRD volume");
    const VoxelFileFormat& format = *voxel_file_format(path);
    return format.array ? describe_array(path, format) : describe_art(path, format);
}

using Describe = Report (*)(const fs::path&);

/// A kind of file, with its first bytes and the ending of its name.
struct FileKind {
    std::string_view mark;
    const char* ending;
    Describe describe;
};

/// Finds the reader by the file's first bytes. Where these are unknown, the reader that its name
/// stands for refuses it. Meshes have no mark of their own, so they come last.
Describe find_description(const fs::path& path) {
    constexpr std::array<FileKind, 7> kKinds = {{{{"\x76\x2f\x31\x01", 4}, ".exr", describe_exr},
                                                 {{"\x89PNG\r\n\x1a\n", 8}, ".png", describe_png},
                                                 {{" BDV\0\0\0\0", 8}, ".vdb", describe_vdb},
                                                 {{"\x89VXM\r\n\x1a\n", 8}, ".vxm", describe_model},
                                                 {{"Kvxl", 4}, ".kv6", describe_kv6},
                                                 {{"VOX ", 4}, ".vox", describe_vox},
                                                 {{"<!doctyp", 8}, ".html", describe_page}}};
    const InputFile file(path);
    std::string start(std::min<uint64_t>(8, file.size()), '\0');
    file.read(0, start.data(), start.size());
    for (const FileKind& kind : kKinds)
        if (start.starts_with(kind.mark)) return kind.describe;
    const std::string ending = ending_of(path);
    for (const FileKind& kind : kKinds)
        if (ending == kind.ending) return kind.describe;
    if (voxel_file_format(path) != nullptr) return describe_voxel_file;
    if (is_volume_data(path)) return describe_volume_data;
    return ending == ".json" ? describe_json : describe_mesh;
}

}  // namespace

namespace {

v1::Facts facts_of(const Report& report, const std::string& name) {
    v1::Facts facts{v1::Facts::Kind::value, name, {}};
    std::vector<v1::Facts> inner;
    if (report.is_object()) {
        facts.kind = v1::Facts::Kind::object;
        for (const auto& item : report.items()) inner.push_back(facts_of(item.value(), item.key()));
        facts.value = std::move(inner);
    } else if (report.is_array()) {
        facts.kind = v1::Facts::Kind::list;
        for (const Report& item : report) inner.push_back(facts_of(item, {}));
        facts.value = std::move(inner);
    } else if (report.is_boolean()) {
        facts.value = report.get<bool>();
    } else if (report.is_number_unsigned()) {
        facts.value = json_integer<uint64_t>(report);
    } else if (report.is_number_integer()) {
        facts.value = json_integer<int64_t>(report);
    } else if (report.is_number()) {
        facts.value = report.get<double>();
    } else if (report.is_string()) {
        facts.value = report.get<std::string>();
    }
    return facts;
}

}  // namespace
}  // namespace voxelume::api

namespace voxelume::v1 {

Facts describe_file(const std::filesystem::path& file, const SceneOptions& options) {
    return api::guarded([&] {
        api::apply_process_options();
        api::Report report = {{"file", file.string()}, {"bytes", 0}};
        if (ending_of(file) == ".json" && api::is_scene(file))
            report.update(api::describe_scene(api::inside(Scene::load(file, options))));
        else
            report.update(api::find_description(file)(file));
        report["bytes"] = std::filesystem::file_size(file);
        return api::facts_of(report, {});
    });
}

Facts describe_slices(const std::filesystem::path& first) {
    return api::guarded([&] {
        api::apply_process_options();
        const VoxelFileFormat* const format = voxel_format_named(first);
        if (!format || !format->is_numbered)
            throw voxelume::Error(voxelume::ErrorKind::usage,
                                  "{}: the name of a slice is that of a PNG file and has a number",
                                  SourcePlace(first.string()));
        api::Report report = {{"file", first.string()}};
        report.update(api::describe_array(first, *format));
        return api::facts_of(report, {});
    });
}

}  // namespace voxelume::v1
