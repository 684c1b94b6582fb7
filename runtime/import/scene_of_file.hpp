// SPDX-License-Identifier: Apache-2.0
// model file -> text of a scene that shows it
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/import/import_options.hpp"

namespace voxelume {

/// The endings of the names of files that `scene_of_file` reads, `0001.png` of slices among them.
std::vector<std::string> model_file_endings();

/// The endings of those that are meshes.
std::vector<std::string> mesh_file_endings();

/// True if a file's ending says that `scene_of_file` reads it.
bool is_model_file(const std::filesystem::path& file);

/// The text of a scene that shows what a model's file holds: on a ground, in soft light, by an
/// observer who sees all of it. The scene calls the file `name`. What is read of the file stays in
/// `assets`. Throws Error::input for a file that can't be read or shows nothing.
std::string scene_of_file(const std::filesystem::path& file, const std::string& name,
                          const ImportOptions& options, AssetStore& assets);

/// The text of a scene like scene_of_file()'s for voxels in memory, which it calls `name`.
std::string scene_of_voxels(const std::shared_ptr<const VoxelModel>& voxels,
                            const std::string& name, const ImportOptions& options,
                            AssetStore& assets);

}  // namespace voxelume
