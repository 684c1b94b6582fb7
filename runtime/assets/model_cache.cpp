// SPDX-License-Identifier: Apache-2.0
#include "runtime/assets/model_cache.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>

#include "runtime/base/cache_key.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/producer_hash.hpp"
#include "runtime/base/text.hpp"
#include "runtime/grid/grid_bytes.hpp"
#include "runtime/grid/pyramid_bytes.hpp"
#include "runtime/io/gltf/gltf_file.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/io/mesh/mesh_textures.hpp"
#include "runtime/opencl/kernel_source.hpp"

namespace voxelume {
namespace {

constexpr const char* kFormat = "voxelume models 6";
constexpr uint64_t kDefaultMegabytes = 4096;

/// The minimum rate at which the bytes of a grid are read, unpacked and sent to a device.
constexpr double kReadBytesPerSecond = 0.5e9;

std::string key_of(std::initializer_list<std::string_view> parts) {
    return cache_key(std::span(parts.begin(), parts.size()));
}

/// A hash of the code that makes grids and worlds, on the host and on devices.
const std::string& producers() {
    static const std::string key = [] {
        std::string text = producer_hash();
        for (const auto& [file, content] : embedded_kernels())
            for (const char* stage : {"voxelize", "cut", "place", "index"})
                if (file.starts_with(stage) && file.ends_with(".cl"))
                    text += kernel_source(file).text();
        return key_of({kFormat, text});
    }();
    return key;
}

nlohmann::json json_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

glm::dvec3 vector_of(const nlohmann::json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

nlohmann::json json_of(const SurfaceArea& area) {
    return {json_of(area.shadows), area.total};
}

SurfaceArea area_of(const nlohmann::json& json) {
    return {vector_of(json.at(0)), json.at(1).get<double>()};
}

/// A name consists of the file's bytes, in whatever encoding.
nlohmann::json json_of(const std::string& name) {
    return nlohmann::json::binary({name.begin(), name.end()});
}

std::string text_of(const nlohmann::json& json) {
    const auto& bytes = json.get_binary();
    return {bytes.begin(), bytes.end()};
}

nlohmann::json json_of(const MeshPaint& paint) {
    return {paint.colors, paint.has_corner_colors, paint.texels, paint.textures,
            paint.uvs,    paint.has_corner_uvs};
}

MeshPaint read_paint(const nlohmann::json& json) {
    return {json.at(0).get<uint64_t>(), json.at(1).get<bool>(),     json.at(2).get<uint64_t>(),
            json.at(3).get<uint64_t>(), json.at(4).get<uint64_t>(), json.at(5).get<bool>()};
}

/// The summary as CBOR, in which numbers keep all their bits.
std::string bytes_of(const MeshSummary& summary) {
    const nlohmann::json json = {
        summary.triangles,
        {json_of(summary.surface.min), json_of(summary.surface.max)},
        {json_of(summary.vertices.min), json_of(summary.vertices.max)},
        {json_of(summary.area), json_of(summary.min_area)},
        json_of(summary.paint),
        nlohmann::json::array(),
        summary.corners,
        {summary.topology.open_edges, summary.topology.hole_area, summary.topology.volume},
        {json_of(summary.material_library), json_of(summary.texture)},
        summary.has_normals,
        summary.longest_edge,
        nlohmann::json::array()};
    nlohmann::json whole = json;
    for (const std::string& note : summary.notes) whole[11].push_back(json_of(note));
    for (const std::string& name : summary.group_names) whole[5].push_back(json_of(name));
    const std::vector<uint8_t> bytes = nlohmann::json::to_cbor(whole);
    return {bytes.begin(), bytes.end()};
}

MeshSummary summary_of_bytes(const std::string& bytes) {
    const nlohmann::json json = nlohmann::json::from_cbor(bytes);
    MeshSummary summary;
    summary.triangles = json.at(0).get<uint64_t>();
    summary.surface = {vector_of(json.at(1).at(0)), vector_of(json.at(1).at(1))};
    summary.vertices = {vector_of(json.at(2).at(0)), vector_of(json.at(2).at(1))};
    summary.area = area_of(json.at(3).at(0));
    summary.min_area = area_of(json.at(3).at(1));
    summary.paint = read_paint(json.at(4));
    summary.corners = json.at(6).get<uint64_t>();
    for (const nlohmann::json& name : json.at(5)) summary.group_names.push_back(text_of(name));
    const nlohmann::json& topology = json.at(7);
    summary.topology = {topology.at(0).get<uint64_t>(), topology.at(1).get<double>(),
                        topology.at(2).get<double>()};
    summary.material_library = text_of(json.at(8).at(0));
    summary.texture = text_of(json.at(8).at(1));
    summary.has_normals = json.at(9).get<bool>();
    summary.longest_edge = json.at(10).get<double>();
    for (const nlohmann::json& note : json.at(11)) summary.notes.push_back(text_of(note));
    return summary;
}

std::string bytes_of(const MeshShape& shape) {
    const std::vector<uint8_t> bytes =
        nlohmann::json::to_cbor({shape.sharp_length, shape.thickness});
    return {bytes.begin(), bytes.end()};
}

MeshShape shape_of_bytes(const std::string& bytes) {
    const nlohmann::json json = nlohmann::json::from_cbor(bytes);
    return {json.at(0).get<double>(), json.at(1).get<double>()};
}

std::string shape_key(const std::string& source) {
    return key_of({producers(), "shape", source});
}

std::string summary_key(const std::string& source) {
    return key_of({producers(), "summary", source});
}

std::string winding_key(const std::string& source, const glm::dvec3& point) {
    CacheKey words;
    words.add_all(point);
    return key_of({producers(), "winding", source, words.bytes()});
}

uint64_t megabytes_of_user() {
    const char* text = std::getenv("VOXELUME_CACHE_MB");
    if (!text || !*text) return kDefaultMegabytes;
    uint64_t megabytes = 0;
    const char* end = text + std::strlen(text);
    const auto [stop, error] = std::from_chars(text, end, megabytes);
    if (stop != end || error != std::errc() || megabytes > 1u << 30)
        throw Error(ErrorKind::usage,
                    "VOXELUME_CACHE_MB is \"{}\": it must be the megabytes that models may take "
                    "on disk, 0 for none",
                    text);
    return megabytes;
}

}  // namespace

std::string mesh_source(const std::string& bytes, const std::filesystem::path& name, int part) {
    std::string of_companions;
    const std::vector<std::filesystem::path> companions =
        is_gltf_file(name) ? gltf_companions(bytes, name) : companion_files(bytes, name);
    for (const std::filesystem::path& file : companions)
        of_companions += key_of({file.filename().string(), read_mesh_bytes(file)});
    if (part > 0) of_companions += std::to_string(part);
    if (of_companions.empty()) return key_of({ending_of(name), bytes});
    return key_of({ending_of(name), bytes, of_companions});
}

std::string mapped_source(const std::string& source, const FileMap& map) {
    CacheKey words;
    words.add(map.scale).add_all(map.shift);
    return key_of({"mapped", source, words.bytes()});
}

std::string morph_source(const std::string& from, const std::string& to, const Morph& morph) {
    CacheKey words;
    words.add_all(morph.center).add(morph.radius).add(morph.amount);
    return key_of({from, to, words.bytes()});
}

std::string grid_key(const std::string& source, const VoxelizeOptions& options,
                     const glm::dmat4& frame_from_mesh, const GridFrame& frame) {
    CacheKey words;
    words.add(int(options.surface)).add(int(options.set)).add(double(options.band));
    words.add(int(options.shading.kind)).add(options.shading.crease_angle);
    words.add_columns(frame_from_mesh);
    words.add_all(frame.origin).add_all(frame.voxel_edge).add_all(frame.size);
    return key_of({producers(), "grid", source, words.bytes()});
}

std::string world_key(std::string_view parts) {
    return key_of({producers(), "world", parts});
}

ModelCache ModelCache::of_user() {
    return of_user({}, {});
}

ModelCache ModelCache::of_user(const std::filesystem::path& folder,
                               std::optional<uint64_t> megabytes) {
    const std::filesystem::path of_user = cache_folder();
    const uint64_t maximum = megabytes ? *megabytes : megabytes_of_user();
    if (folder.empty() && of_user.empty()) return {};
    return ModelCache(folder.empty() ? of_user / "models" : folder, maximum << 20).with_worlds();
}

std::optional<MeshSummary> ModelCache::summary(const std::string& source) const {
    if (!is_open_) return std::nullopt;
    const auto bytes = store_.read(summary_key(source));
    if (!bytes) return std::nullopt;
    try {
        return summary_of_bytes(*bytes);
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

void ModelCache::keep(const std::string& source, const MeshSummary& summary, double seconds) const {
    if (is_open_ && seconds >= min_seconds_) store_.write(summary_key(source), bytes_of(summary));
}

std::optional<MeshShape> ModelCache::shape(const std::string& source) const {
    if (!is_open_) return std::nullopt;
    const auto bytes = store_.read(shape_key(source));
    if (!bytes) return std::nullopt;
    try {
        return shape_of_bytes(*bytes);
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

void ModelCache::keep(const std::string& source, const MeshShape& shape, double seconds) const {
    if (is_open_ && seconds >= min_seconds_) store_.write(shape_key(source), bytes_of(shape));
}

std::optional<BrickGrid> ModelCache::grid(const Device& device, const std::string& key) const {
    if (!is_open_) return std::nullopt;
    const auto bytes = store_.read(key);
    return bytes ? grid_of_bytes(device, *bytes) : std::nullopt;
}

bool ModelCache::is_quick(double seconds, uint64_t bytes) const {
    const double reading = double(bytes) / kReadBytesPerSecond;
    return seconds < min_seconds_ || (min_seconds_ > 0 && seconds < reading);
}

void ModelCache::keep(const std::string& key, const BrickGrid& grid, double seconds) const {
    if (!is_open_ || is_quick(seconds, device_bytes(grid))) return;
    try {
        if (const auto bytes = bytes_of_grid(grid, max_entry_bytes())) store_.write(key, *bytes);
    } catch (const std::bad_alloc&) {
        return;  // too little memory for a second copy is no reason to stop
    }
}

std::optional<Pyramid> ModelCache::world(const Device& device, const std::string& key) const {
    if (!keeps_worlds()) return std::nullopt;
    const auto bytes = store_.read(key);
    return bytes ? pyramid_of_bytes(device, *bytes) : std::nullopt;
}

void ModelCache::keep(const std::string& key, const Pyramid& world, double seconds) const {
    const uint64_t bytes = bytes_of(world);
    if (!keeps_worlds() || is_quick(seconds, bytes) || bytes > max_entry_bytes()) return;
    try {
        store_.write(key, bytes_of_pyramid(world));
    } catch (const std::bad_alloc&) {
        return;
    }
}

bool ModelCache::is_too_large(uint64_t bytes, double seconds) const {
    return keeps_worlds() && !is_quick(seconds, bytes) && bytes > max_entry_bytes();
}

std::optional<double> ModelCache::winding(const std::string& source,
                                          const glm::dvec3& point) const {
    if (!is_open_) return std::nullopt;
    const auto bytes = store_.read(winding_key(source, point));
    if (!bytes || bytes->size() != sizeof(double)) return std::nullopt;
    double winding = 0;
    std::memcpy(&winding, bytes->data(), sizeof winding);
    return winding;
}

void ModelCache::keep(const std::string& source, const glm::dvec3& point, double winding,
                      double seconds) const {
    if (!is_open_ || seconds < min_seconds_) return;
    store_.write(winding_key(source, point),
                 {reinterpret_cast<const char*>(&winding), sizeof winding});
}

}  // namespace voxelume
