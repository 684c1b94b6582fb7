// SPDX-License-Identifier: Apache-2.0
// What a store's meshes and voxels take of memory, and which of them are forgotten.
#include "runtime/assets/asset_bytes.hpp"
#include "runtime/assets/asset_store.hpp"

namespace voxelume {
void AssetStore::MeshFile::forget_meshes() {
    mesh.reset();
    targets.reset();
    skins.clear();
    for (auto& [map, mapped_mesh] : mapped) mapped_mesh.mesh.reset();
    for (auto& [key, thin_part] : thin) thin_part.part.reset();
}

/// The bytes of memory that the loaded contents of a file take.
uint64_t AssetStore::bytes_of(const std::filesystem::path& name) const {
    uint64_t bytes = 0;
    for (const auto& [of, file] : files_) {
        if (of.first != name) continue;
        if (file.mesh) bytes += mesh_bytes(*file.mesh);
        if (file.targets)
            for (const MorphTarget& target : *file.targets)
                bytes += (target.positions.size() + target.normals.size()) * sizeof(glm::vec3);
        for (const auto& [key, skin] : file.skins) bytes += skin->bytes();
        for (const auto& [map, mapped] : file.mapped)
            if (mapped.mesh) bytes += mesh_bytes(*mapped.mesh);
        for (const auto& [key, thin] : file.thin)
            if (thin.part)
                bytes += mesh_bytes(thin.part->mesh) + thin.part->points.size() * sizeof(glm::vec3);
    }
    for (const auto& [key, file] : voxels_)
        if (std::get<0>(key) == name) bytes += voxel_bytes(file.voxels);
    return bytes;
}

/// Forgets what is loaded of a file.
void AssetStore::forget(const std::filesystem::path& name) {
    for (auto& [of, file] : files_)
        if (of.first == name) file.forget_meshes();
    gltf_files_.erase(name);
    std::erase_if(voxels_, [&](const auto& entry) { return std::get<0>(entry.first) == name; });
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
            forget(name);
        }
    }
    used_.merge(files);
}

void AssetStore::forget_unused() {
    std::erase_if(files_, [&](const auto& entry) { return !used_.contains(entry.first.first); });
    std::erase_if(sources_, [&](const auto& entry) { return !used_.contains(entry.first); });
    std::erase_if(gltf_files_, [&](const auto& entry) { return !used_.contains(entry.first); });
    std::erase_if(vox_files_, [&](const auto& entry) { return !used_.contains(entry.first); });
    std::erase_if(voxels_,
                  [&](const auto& entry) { return !used_.contains(std::get<0>(entry.first)); });
    std::erase_if(voxel_sources_,
                  [&](const auto& entry) { return !used_.contains(std::get<0>(entry.first)); });
    for (auto& [model, morphed] : morphed_)
        if (!used_morphs_.contains(model)) morphed.mesh.reset();
    used_.clear();
    used_morphs_.clear();
}

}  // namespace voxelume
