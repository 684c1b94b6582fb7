// SPDX-License-Identifier: Apache-2.0
// The search for files that a scene names, inside the allowed folders only.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/source_place.hpp"

namespace voxelume {

struct VoxelModel;

/// Voxels in memory, by the names that models use in place of files.
using GivenVoxels = std::map<std::string, std::shared_ptr<const VoxelModel>, std::less<>>;

/// Folders that are searched after the scene's own, in order.
using AssetFolders = std::vector<std::filesystem::path>;

/// The folders of `--assets`, followed by those of the environment variable VOXELUME_ASSETS
/// (separated by colons; empty ones are skipped).
AssetFolders asset_folders(const std::vector<std::filesystem::path>& from_command_line);

/// True if `find_asset` would find something by this name.
bool is_asset(std::string_view name, const std::filesystem::path& scene_folder,
              const AssetFolders& assets);

/// The canonical path of a regular file below the scene's folder or one of `assets`.
///
/// `where` opens the messages. Throws Error::scene for an absolute name, for `..` and for a link
/// that leads out of its folder, Error::input with the folders searched when there is no such file.
std::filesystem::path find_asset(std::string_view name, const std::filesystem::path& scene_folder,
                                 const AssetFolders& assets, const SourcePlace& where);

}  // namespace voxelume
