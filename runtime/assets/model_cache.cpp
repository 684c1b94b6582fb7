// SPDX-License-Identifier: Apache-2.0
#include "runtime/assets/model_cache.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <new>

#include "runtime/assets/summary_bytes.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/files/cache_key.hpp"
#include "runtime/base/files/producer_hash.hpp"
#include "runtime/base/text.hpp"
#include "runtime/geometry/voxel_model.hpp"
#include "runtime/grid/grid_bytes.hpp"
#include "runtime/grid/pyramid_bytes.hpp"
#include "runtime/io/gltf/gltf_file.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/io/mesh/mesh_textures.hpp"
#include "runtime/opencl/source/kernel_source.hpp"

namespace voxelume {
namespace {

constexpr const char* kFormat = "voxelume models 7";
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

std::string mesh_source(const std::string& bytes, const std::filesystem::path& name) {
    std::string of_companions;
    const std::vector<std::filesystem::path> companions =
        is_gltf_file(name) ? gltf_companions(bytes, name) : companion_files(bytes, name);
    for (const std::filesystem::path& file : companions)
        of_companions += key_of({file.filename().string(), read_mesh_bytes(file)});
    if (of_companions.empty()) return key_of({ending_of(name), bytes});
    return key_of({ending_of(name), bytes, of_companions});
}

std::string part_source(const std::string& source, int part) {
    return part > 0 ? key_of({"part", source, std::to_string(part)}) : source;
}

std::string mapped_source(const std::string& source, const FileMap& map) {
    CacheKey words;
    words.add(map.scale).add_all(map.shift);
    return key_of({"mapped", source, words.bytes()});
}

std::string thin_source(const std::string& source, double voxel_edge, bool is_thin_part) {
    CacheKey words;
    words.add(voxel_edge).add(is_thin_part);
    return key_of({"thin", source, words.bytes()});
}

std::string morph_source(const std::string& from, const std::string& to, const Morph& morph) {
    CacheKey words;
    words.add_all(morph.center).add(morph.radius).add(morph.amount);
    for (const double weight : morph.weights) words.add(weight);
    if (morph.skin > 0) words.add(morph.skin).add_text(morph.clip).add(morph.time);
    return key_of({from, to, words.bytes()});
}

std::string grid_key(const std::string& source, const VoxelizeOptions& options,
                     const glm::dmat4& frame_from_mesh, const GridFrame& frame) {
    CacheKey words;
    words.add(int(options.surface)).add(int(options.set)).add(double(options.band));
    words.add(int(options.shading.kind)).add(options.shading.crease_angle);
    words.add(int(options.normals));
    words.add_columns(frame_from_mesh);
    words.add_all(frame.origin).add_all(frame.voxel_edge).add_all(frame.size);
    return key_of({producers(), "grid", source, words.bytes()});
}

std::string voxels_source(const VoxelModel& voxels) {
    CacheKey key;
    const GridFrame& frame = voxels.frame;
    key.add_all(frame.origin).add_all(frame.voxel_edge).add_all(frame.size);
    key.add(int(voxels.surface)).add(int(voxels.set)).add(voxels.transparent);
    for (const std::string& group : voxels.groups) key.add_text(group);
    const auto bytes_of = [](const auto& values) {
        return std::string_view(reinterpret_cast<const char*>(values.data()),
                                values.size() * sizeof values[0]);
    };
    const std::array<std::string_view, 12> parts = {"voxels",
                                                    key.bytes(),
                                                    bytes_of(voxels.slots),
                                                    bytes_of(voxels.coordinates),
                                                    bytes_of(voxels.occupancy),
                                                    bytes_of(voxels.distance),
                                                    bytes_of(voxels.attributes),
                                                    bytes_of(voxels.colors),
                                                    bytes_of(voxels.normals),
                                                    bytes_of(voxels.color_codes),
                                                    bytes_of(voxels.palette),
                                                    bytes_of(voxels.full_colors)};
    return cache_key(parts);
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
    if (!folder.empty()) return ModelCache(folder, maximum << 20).with_worlds();
    return ModelCache(of_user.empty() ? of_user : of_user / "models", maximum << 20, 0.001,
                      cache_bases("models"))
        .with_worlds();
}

std::optional<MeshSummary> ModelCache::summary(const std::string& source) const {
    if (!is_open_) return std::nullopt;
    const auto bytes = store_.read(summary_key(source));
    return bytes ? summary_of_bytes(*bytes) : std::nullopt;
}

void ModelCache::keep(const std::string& source, const MeshSummary& summary, double seconds) const {
    if (is_open_ && seconds >= min_seconds_) store_.write(summary_key(source), bytes_of(summary));
}

std::optional<MeshShape> ModelCache::shape(const std::string& source) const {
    if (!is_open_) return std::nullopt;
    const auto bytes = store_.read(shape_key(source));
    return bytes ? shape_of_bytes(*bytes) : std::nullopt;
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

/// True from the second call for a key on, in this run or another.
bool ModelCache::was_made_before(const std::string& key) const {
    const std::array<std::string_view, 2> parts = {"made before", key};
    const std::string note = cache_key(parts);
    if (store_.read(note)) return true;
    store_.write(note, {});
    return false;
}

void ModelCache::keep(const std::string& key, const BrickGrid& grid, double seconds) const {
    if (!is_open_ || is_quick(seconds, device_bytes(grid))) return;
    try {
        auto bytes = bytes_of_grid(grid, max_new_entry_bytes());
        if (!bytes && was_made_before(key)) bytes = bytes_of_grid(grid, max_entry_bytes());
        if (bytes) store_.write(key, *bytes);
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
    if (bytes > max_new_entry_bytes() && !was_made_before(key)) return;
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
