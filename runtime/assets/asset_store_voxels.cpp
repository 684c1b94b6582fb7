// SPDX-License-Identifier: Apache-2.0
// The part of AssetStore that reads voxels.
#include "runtime/assets/asset_store.hpp"
#include "runtime/assets/load_timer.hpp"
#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/base/error.hpp"
#include "runtime/geometry/file_map.hpp"
#include "runtime/io/voxel_file_table.hpp"

namespace voxelume {

SurfaceChoice AssetStore::surface_of_voxels(Model model) {
    if (model.given) return {Surface::cubes, "its voxels are in memory"};
    if (const auto surface = surface_of_voxel_model(model.voxels))
        return {*surface, "its file says so"};
    if (voxel_file_format(model.voxels) != nullptr)
        return model.values.iso ? SurfaceChoice{Surface::smooth, "it has a value for its surface"}
                                : SurfaceChoice{Surface::cubes, "its file has cells"};
    model.surface = Surface::cubes;
    try {
        voxels(model);
        return {Surface::cubes, "its file has densities"};
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input) throw;
        try {
            model.surface = Surface::smooth;
            voxels(model);
            return {Surface::smooth, "its file has a level set"};
        } catch (const Error&) {
            throw error;
        }
    }
}

VoxelModel AssetStore::read_voxels(const Model& model) {
    if (model.given) {
        if (model.surface == model.given->surface) return *model.given;
        throw Error(ErrorKind::scene, "{}: voxels in memory are cubes: leave its surface out",
                    model.where);
    }
    ++meshes_read_;
    return model.part > 0 && is_vox_file(model.voxels)
               ? read_vox_model(vox_file(model.voxels), model.surface, model.part)
               : read_coded_model(model.voxels, model.surface, model.part, model.values);
}

AssetStore::VoxelKey AssetStore::voxel_key(const Model& model) {
    return {model.voxels, model.surface, key_of(model.object_from_file), model.part, model.values};
}

const AssetStore::VoxelFile& AssetStore::voxel_file(const Model& model) {
    used_.insert(model.voxels);
    const FileMap& map = model.object_from_file;
    const VoxelKey key = voxel_key(model);
    const auto found = voxels_.find(key);
    if (found != voxels_.end()) return found->second;
    const LoadTimer timer(load_seconds_);
    VoxelFile file;
    if (auto plain =
            voxels_.extract({model.voxels, model.surface, key_of({}), model.part, model.values})) {
        file = std::move(plain.mapped());
    } else {
        file.voxels = read_voxels(model);
    }
    if (!map.is_identity()) apply(map, model.voxels, file.voxels);
    const auto known = voxel_sources_.find(key);
    if (known != voxel_sources_.end() && !known->second.empty() &&
        known->second != voxels_source(file.voxels))
        throw Error(ErrorKind::input, "{}: the file changed while it was being read: try again",
                    model.voxels.string());
    if (lists_primitives(model.surface)) file.summary = voxelume::summary_of(file.voxels.mesh);
    return voxels_.emplace(key, std::move(file)).first->second;
}

const VoxFile& AssetStore::vox_file(const std::filesystem::path& file) {
    const auto found = vox_files_.find(file);
    if (found != vox_files_.end()) return found->second;
    return vox_files_.emplace(file, read_vox_file(file)).first->second;
}

const VoxelModel& AssetStore::voxels(const Model& model) {
    return voxel_file(model).voxels;
}

const std::string& AssetStore::source_of_voxels(const Model& model) {
    used_.insert(model.voxels);
    const VoxelKey key = voxel_key(model);
    if (const auto known = voxel_sources_.find(key); known != voxel_sources_.end())
        return known->second;
    const VoxelModel& all = voxels(model);
    const bool is_named = cache_.is_open() && all.mesh.triangles.empty();
    return voxel_sources_[key] = is_named ? voxels_source(all) : std::string();
}

}  // namespace voxelume
