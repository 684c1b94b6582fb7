// SPDX-License-Identifier: Apache-2.0
#include "runtime/assets/asset_store.hpp"

#include <chrono>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/base/error.hpp"
#include "runtime/geometry/mesh_morph.hpp"
#include "runtime/geometry/winding_number.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"

namespace voxelume {
namespace {

/// Adds the time from its construction to its destruction to a sum of seconds.
class LoadTimer {
  public:
    explicit LoadTimer(double& sum) : sum_(sum) {}
    ~LoadTimer() { sum_ += seconds(); }
    LoadTimer(const LoadTimer&) = delete;
    LoadTimer& operator=(const LoadTimer&) = delete;

    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    double& sum_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

template <class... Values>
uint64_t bytes_in(const std::vector<Values>&... arrays) {
    return (... + (arrays.size() * sizeof(Values)));
}

uint64_t mesh_bytes(const Mesh& mesh) {
    return bytes_in(mesh.positions, mesh.triangles, mesh.vertex_colors, mesh.triangle_group);
}

uint64_t voxel_bytes(const VoxelModel& voxels) {
    return mesh_bytes(voxels.mesh) + bytes_in(voxels.slots, voxels.coordinates, voxels.occupancy,
                                              voxels.distance, voxels.attributes, voxels.colors);
}

}  // namespace

AssetStore::MeshFile& AssetStore::file(const std::filesystem::path& name) {
    used_.insert(name);
    const auto found = files_.find(name);
    if (found != files_.end()) return found->second;
    MeshFile file;
    if (cache_.is_open()) {
        const LoadTimer timer(load_seconds_);
        file.source = mesh_source(read_mesh_bytes(name), name);
    }
    return files_.emplace(name, std::move(file)).first->second;
}

const Mesh& AssetStore::mesh(const std::filesystem::path& name) {
    MeshFile& file = this->file(name);
    if (file.mesh) return *file.mesh;
    const LoadTimer timer(load_seconds_);
    const std::string bytes = read_mesh_bytes(name);
    if (cache_.is_open() && mesh_source(bytes, name) != file.source)
        throw Error(ErrorKind::input, "{}: the file changed while it was being read: try again",
                    name.string());
    file.mesh = parse_mesh(bytes, name);
    ++meshes_read_;
    return *file.mesh;
}

const MeshSummary& AssetStore::summary_of_file(const std::filesystem::path& name) {
    MeshFile& file = this->file(name);
    if (file.summary) return *file.summary;
    file.summary = cache_.summary(file.source);
    if (file.summary) return *file.summary;
    double seconds = 0;
    {
        const LoadTimer timer(seconds);
        file.summary = voxelume::summary_of(mesh(name));
    }
    cache_.keep(file.source, *file.summary, seconds);
    return *file.summary;
}

const AssetStore::VoxelFile& AssetStore::voxel_file(const Model& model) {
    used_.insert(model.voxels);
    const std::pair key(model.voxels, model.surface);
    const auto found = voxels_.find(key);
    if (found != voxels_.end()) return found->second;
    const LoadTimer timer(load_seconds_);
    VoxelFile read{read_voxel_model(model.voxels, model.surface), {}};
    if (lists_primitives(model.surface)) read.summary = voxelume::summary_of(read.voxels.mesh);
    ++meshes_read_;
    return voxels_.emplace(key, std::move(read)).first->second;
}

const VoxelModel& AssetStore::voxels(const Model& model) {
    return voxel_file(model).voxels;
}

AssetStore::Morphed& AssetStore::morphed(const Model& model) {
    used_.insert({model.mesh, model.morph->mesh});
    used_morphs_.insert(model.name);
    const auto found = morphed_.find(model.name);
    if (found != morphed_.end() && found->second.file == model.mesh &&
        found->second.morph == *model.morph)
        return found->second;
    Morphed fresh{model.mesh, *model.morph, {}, {}};
    return morphed_.insert_or_assign(model.name, std::move(fresh)).first->second;
}

const Mesh& AssetStore::morphed_mesh(const Model& model) {
    Morphed& entry = morphed(model);
    if (entry.mesh) return *entry.mesh;
    const Morph& morph = *model.morph;
    const Mesh& from = mesh(model.mesh);
    entry.mesh = morph.mesh.empty()
                     ? morphed_to_sphere(from, morph.center, morph.radius, morph.amount)
                     : ::voxelume::morphed(from, mesh(morph.mesh), morph.amount, model.where);
    return *entry.mesh;
}

const MeshSummary& AssetStore::morphed_summary(const Model& model) {
    Morphed& entry = morphed(model);
    if (entry.summary) return *entry.summary;
    const std::string source = source_of(model);
    entry.summary = cache_.summary(source);
    if (entry.summary) return *entry.summary;
    double seconds = 0;
    {
        const LoadTimer timer(seconds);
        entry.summary = voxelume::summary_of(morphed_mesh(model));
    }
    cache_.keep(source, *entry.summary, seconds);
    return *entry.summary;
}

const Mesh* AssetStore::mesh_of(const Model& model) {
    if (model.solid) return nullptr;
    if (model.voxels.empty()) return model.morph ? &morphed_mesh(model) : &mesh(model.mesh);
    return lists_primitives(model.surface) ? &voxels(model).mesh : nullptr;
}

const MeshSummary* AssetStore::summary_of(const Model& model) {
    if (model.solid) return nullptr;
    if (model.voxels.empty())
        return model.morph ? &morphed_summary(model) : &summary_of_file(model.mesh);
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
    std::string from = file(model.mesh).source;
    if (!model.morph) return from;
    const Morph& morph = *model.morph;
    return morph_source(from, morph.mesh.empty() ? std::string() : file(morph.mesh).source, morph);
}

/// The bytes of memory that the loaded contents of a file take.
uint64_t AssetStore::bytes_of(const std::filesystem::path& name) const {
    uint64_t bytes = 0;
    if (const auto found = files_.find(name); found != files_.end() && found->second.mesh)
        bytes += mesh_bytes(*found->second.mesh);
    for (const auto& [key, file] : voxels_)
        if (key.first == name) bytes += voxel_bytes(file.voxels);
    return bytes;
}

void AssetStore::retain(const Model& model, uint64_t& room) {
    std::set<std::filesystem::path> files = {model.mesh, model.voxels};
    if (model.morph) files.insert(model.morph->mesh);
    uint64_t bytes = 0;
    for (const auto& name : files)
        if (!used_.contains(name)) bytes += bytes_of(name);
    if (bytes <= room) {
        room -= bytes;
    } else {
        for (const auto& name : files) {
            if (used_.contains(name)) continue;
            if (const auto found = files_.find(name); found != files_.end())
                found->second.mesh.reset();
            std::erase_if(voxels_, [&](const auto& entry) { return entry.first.first == name; });
        }
    }
    used_.merge(files);
}

AssetStore AssetStore::recounted() const {
    AssetStore store = *this;
    store.load_seconds_ = 0;
    store.meshes_read_ = 0;
    return store;
}

void AssetStore::forget_unused() {
    std::erase_if(files_, [&](const auto& entry) { return !used_.contains(entry.first); });
    std::erase_if(voxels_, [&](const auto& entry) { return !used_.contains(entry.first.first); });
    for (auto& [model, morphed] : morphed_)
        if (!used_morphs_.contains(model)) morphed.mesh.reset();
    used_.clear();
    used_morphs_.clear();
}

/// The number of a file's triangles. Where only a morphed mesh's summary is known, it is that of
/// the morphed mesh; 0 where nothing is known.
uint64_t AssetStore::triangles_of(const std::filesystem::path& name, const MeshFile& file) const {
    if (file.summary) return file.summary->triangles;
    if (file.mesh) return file.mesh->triangles.size();
    for (const auto& [model, morphed] : morphed_)
        if (morphed.summary && (morphed.file == name || morphed.morph.mesh == name))
            return morphed.summary->triangles;
    return 0;
}

uint64_t AssetStore::triangles() const {
    uint64_t sum = 0;
    for (const auto& [name, file] : files_) sum += triangles_of(name, file);
    for (const auto& [key, file] : voxels_) sum += file.summary.triangles;
    return sum;
}

}  // namespace voxelume
