// SPDX-License-Identifier: Apache-2.0
#include "runtime/assets/asset_store.hpp"

#include "runtime/assets/asset_bytes.hpp"
#include "runtime/assets/load_timer.hpp"
#include "runtime/base/error.hpp"
#include "runtime/geometry/file_map.hpp"
#include "runtime/geometry/winding_number.hpp"
#include "runtime/io/gltf/gltf_mesh.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"

namespace voxelume {

AssetStore::MeshFile& AssetStore::file(const MeshName& name) {
    used_.insert(name.first);
    const auto found = files_.find(name);
    if (found != files_.end()) return found->second;
    MeshFile file;
    if (cache_.is_open()) {
        const LoadTimer timer(load_seconds_);
        file.source = part_source(source_of_file(name.first), name.second);
    }
    return files_.emplace(name, std::move(file)).first->second;
}

const std::string& AssetStore::source_of_file(const std::filesystem::path& path) {
    std::string& source = sources_[path];
    if (source.empty()) source = mesh_source(read_mesh_bytes(path), path);
    return source;
}

/// The bytes of a file. Throws if they aren't those that the file's source was made from.
std::string AssetStore::bytes_of_file(const std::filesystem::path& path) {
    std::string bytes = read_mesh_bytes(path);
    if (!cache_.is_open()) return bytes;
    std::string source = mesh_source(bytes, path);
    std::string& known = sources_[path];
    if (known.empty())
        known = std::move(source);
    else if (known != source)
        throw Error(ErrorKind::input, "{}: the file changed while it was being read: try again",
                    path.string());
    return bytes;
}

const GltfFile& AssetStore::gltf_file(const std::filesystem::path& name) {
    std::shared_ptr<const GltfFile>& file = gltf_files_[name];
    if (!file) file = std::make_shared<const GltfFile>(bytes_of_file(name), name);
    return *file;
}

AssetStore::MapKey AssetStore::key_of(const FileMap& map) {
    return {map.scale, map.shift.x, map.shift.y, map.shift.z};
}

Mesh AssetStore::read(const MeshName& name) {
    const auto& [path, part] = name;
    Mesh mesh = is_gltf_file(path) ? gltf_mesh(gltf_file(path), part)
                                   : parse_mesh(bytes_of_file(path), path);
    ++meshes_read_;
    return mesh;
}

const Mesh& AssetStore::mesh(const std::filesystem::path& path, const FileMap& map, int part) {
    const MeshName name(path, part);
    MeshFile& file = this->file(name);
    std::optional<Mesh>& mesh = map.is_identity() ? file.mesh : file.mapped[key_of(map)].mesh;
    if (mesh) return *mesh;
    const LoadTimer timer(load_seconds_);
    if (!map.is_identity() && file.mesh) {
        // A mesh that was read to measure the file is moved instead of read again or copied.
        mesh = std::move(file.mesh);
        file.mesh.reset();
    } else {
        mesh = read(name);
    }
    if (!map.is_identity()) apply(map, path, *mesh);
    return *mesh;
}

/// A value known of a mesh: from memory, else from the cache, else from `make`, which reads the
/// mesh.
template <typename Value, typename Make>
const Value& AssetStore::known(std::optional<Value>& value, const std::string& source,
                               CacheGetter<Value> cached, const Make& make) {
    if (value) return *value;
    value = (cache_.*cached)(source);
    if (value) return *value;
    double seconds = 0;
    {
        const LoadTimer timer(seconds);
        value = make();
    }
    cache_.keep(source, *value, seconds);
    return *value;
}

const MeshSummary& AssetStore::summary_of_file(const MeshName& name, const FileMap& map) {
    MeshFile& file = this->file(name);
    if (!map.is_identity()) {
        std::optional<MeshSummary>& summary = file.mapped[key_of(map)].summary;
        if (!summary) summary = mapped(map, summary_of_file(name));
        return *summary;
    }
    return known(file.summary, file.source, &ModelCache::summary,
                 [&] { return voxelume::summary_of(mesh(name.first, {}, name.second)); });
}

/// Measures no more of a file's shape than is asked for, unless it is known.
const MeshShape& AssetStore::shape_of_file(const MeshName& name, bool is_whole) {
    MeshFile& file = this->file(name);
    const auto measure = [&] {
        const Mesh& of_file = mesh(name.first, {}, name.second);
        return is_whole ? voxelume::shape_of(of_file)
                        : MeshShape{{.length = -1}, voxelume::thickness_of(of_file)};
    };
    if (is_whole && file.shape && file.shape->creases.length < 0) file.shape.reset();
    const MeshShape& shape = known(file.shape, file.source, &ModelCache::shape, measure);
    if (!is_whole || shape.creases.length >= 0) return shape;
    double seconds = 0;
    {
        const LoadTimer timer(seconds);
        file.shape = measure();
    }
    cache_.keep(file.source, *file.shape, seconds);
    return *file.shape;
}

MeshShape AssetStore::shape_of(const Model& model) {
    return scaled(shape_of_file({model.mesh, model.part}, true), model.object_from_file.scale);
}

MeshThickness AssetStore::thickness_of(const Model& model) {
    const MeshThickness& thickness = shape_of_file({model.mesh, model.part}, false).thickness;
    const double scale = model.object_from_file.scale;
    return scaled(thickness, scale);
}

const MeshSummary& AssetStore::morphed_summary(const Model& model) {
    Morphed& entry = morphed(model);
    if (entry.summary) return *entry.summary;
    return known(entry.summary, source_of(model), &ModelCache::summary,
                 [&] { return voxelume::summary_of(morphed_mesh(model)); });
}

const MeshSummary& AssetStore::thin_summary(const Model& model) {
    return known(thin_part(model).summary, source_of(model), &ModelCache::summary,
                 [&] { return voxelume::summary_of(thin_part_of(model).mesh); });
}

const Mesh* AssetStore::mesh_of(const Model& model) {
    if (model.solid) return nullptr;
    if (model.is_thin_part) return &thin_part_of(model).mesh;
    if (model.voxels.empty())
        return model.morph ? &morphed_mesh(model)
                           : &mesh(model.mesh, model.object_from_file, model.part);
    return lists_primitives(model.surface) ? &voxels(model).mesh : nullptr;
}

const MeshSummary* AssetStore::summary_of(const Model& model) {
    if (model.solid) return nullptr;
    if (model.is_thin_part) return &thin_summary(model);
    if (model.voxels.empty())
        return model.morph ? &morphed_summary(model)
                           : &summary_of_file({model.mesh, model.part}, model.object_from_file);
    return lists_primitives(model.surface) ? &voxel_file(model).summary : nullptr;
}

double AssetStore::winding_of(const Model& model, const glm::dvec3& point) {
    const std::string source = source_of(model);
    if (!source.empty())
        if (const auto known = cache_.winding(source, point)) return *known;
    const Mesh* mesh = mesh_of(model);
    if (!mesh) return 0;
    double seconds = 0, winding = 0;
    {
        const LoadTimer timer(seconds);
        winding = winding_number(*mesh, point);
    }
    if (!source.empty()) cache_.keep(source, point, winding, seconds);
    return winding;
}

const std::vector<std::string>& AssetStore::groups_of(const Model& model) {
    static const std::vector<std::string> none;
    if (model.solid) return none;
    return model.voxels.empty() ? summary_of(model)->group_names : voxels(model).groups;
}

std::string AssetStore::source_of(const Model& model) {
    if (model.mesh.empty() || !cache_.is_open()) return {};
    const FileMap& map = model.object_from_file;
    const auto source = [&](const MeshName& name) {
        return map.is_identity() ? file(name).source : mapped_source(file(name).source, map);
    };
    std::string from = source({model.mesh, model.part});
    if (model.thin_edge > 0) from = thin_source(from, model.thin_edge, model.is_thin_part);
    if (!model.morph) return from;
    const Morph& morph = *model.morph;
    return morph_source(from, morph.mesh.empty() ? std::string() : source({morph.mesh, 0}), morph);
}

Bounds AssetStore::box_of_file(const Model& model, bool keeps) {
    Model plain = model;
    plain.morph.reset();
    plain.object_from_file = {};
    const std::filesystem::path& name = plain.voxels.empty() ? plain.mesh : plain.voxels;
    const bool was_loaded = bytes_of(name) > 0;
    if (plain.is_surface_open && !plain.voxels.empty())
        plain.surface = surface_of_voxels(plain).surface;
    const Bounds box = plain.voxels.empty() ? summary_of_file({name, plain.part}).surface
                                            : occupied_bounds(voxels(plain));
    const bool is_moved = model.morph && model.morph->is_of_file();
    const Bounds reached = is_moved ? box_moved_by_file(model, box) : box;
    if (!keeps && !was_loaded) forget(name);
    return reached;
}

AssetStore AssetStore::recounted() const {
    AssetStore store = *this;
    store.load_seconds_ = 0;
    store.meshes_read_ = 0;
    return store;
}

/// The number of a file's triangles. Where only a morphed mesh's summary is known, it is that of
/// the morphed mesh; 0 where nothing is known.
uint64_t AssetStore::triangles_of(const std::filesystem::path& name, const MeshFile& file) const {
    if (file.summary) return file.summary->triangles;
    if (file.mesh) return file.mesh->triangles.size();
    for (const auto& [map, mapped] : file.mapped)
        if (mapped.mesh) return mapped.mesh->triangles.size();
    for (const auto& [model, morphed] : morphed_)
        if (morphed.summary && (morphed.file == name || morphed.morph.mesh == name))
            return morphed.summary->triangles;
    return 0;
}

uint64_t AssetStore::triangles() const {
    uint64_t sum = 0;
    for (const auto& [name, file] : files_) sum += triangles_of(name.first, file);
    for (const auto& [key, file] : voxels_) sum += file.summary.triangles;
    return sum;
}

}  // namespace voxelume
