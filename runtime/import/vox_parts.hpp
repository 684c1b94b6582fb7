// SPDX-License-Identifier: Apache-2.0
// The models of a MagicaVoxel file and the materials of its palette, as members of a scene.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "runtime/import/contents.hpp"
#include "runtime/io/voxels/vox_file.hpp"

namespace voxelume {

class VoxParts {
  public:
    VoxParts(const ImportedFile& file, const VoxFile& vox) : file_(file), vox_(vox) {}

    /// False for models without a voxel, which scenes can't have.
    bool has_voxels(int model);
    /// The model's name in the scene. Adds the model to the scene.
    std::string name_of(int model);
    /// `, "materials": {...}` for the model's voxels that have a material of their own.
    std::string group_members(int model);
    /// True if some of the model's voxels emit light.
    bool is_emissive(int model);
    /// The box around the model's voxels.
    Bounds box_of(int model);

    /// True if light goes through a material that is needed.
    bool has_glass() const;

    std::vector<std::string> models() const;  ///< the models that were named, as keys of a scene
    /// The materials of these models as keys of a scene, for voxels with edges of `voxel` metres.
    std::vector<std::string> materials(double voxel) const;

  private:
    const ImportedFile& file_;
    const VoxFile& vox_;
    std::map<int, std::string> names_;
    std::set<int> entries_;  ///< palette entries whose materials are needed
};

/// The model of a scene for a model of the file: its voxels are those of a part.
Model vox_model(const ImportedFile& file, int part);

/// A material of a scene that looks like a palette entry's: its values without braces.
/// Its voxels have edges of `voxel` metres.
std::string material_values(const VoxMaterial& material, uint32_t color, double voxel = 1);

}  // namespace voxelume
