// SPDX-License-Identifier: Apache-2.0
// scene.json -> Scene.
#pragma once

#include <filesystem>
#include <string_view>

#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/assets.hpp"
#include "runtime/scene_file/document/scene_document.hpp"
#include "runtime/scene_file/fit_scene.hpp"

namespace voxelume {

/// Reads and checks a scene. scenes/README.md leads to the format. Parts that the scene leaves out
/// are fitted to its objects, for which `boxes` gives the boxes of files; scenes that leave out
/// nothing don't need it.
///
/// Throws Error::scene, "file:line:column: key path: sentence", for text or values that are wrong,
/// Error::input for a scene or asset that is missing, Error::limit for a file of more than 64 MiB.
Scene read_scene(const std::filesystem::path& file, const AssetFolders& assets,
                 const FileBoxes& boxes = {});

/// Reads and checks a scene whose text is in memory; `file` names it in messages and gives the
/// folder of its assets.
Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                  const AssetFolders& assets, const FileBoxes& boxes = {});

/// Reads a scene's text as a tree of values. Throws as `parse_json` does, Error::input for a file
/// that is missing, Error::limit for one of more than 64 MiB.
JsonValue read_document(const std::filesystem::path& file);

/// Reads and checks a tree of values from any source: all scenes are checked here. Nothing of the
/// tree is kept. Models whose "voxels" is a name in `given` show the voxels there.
Scene read_scene(const JsonValue& root, const std::filesystem::path& file,
                 const AssetFolders& assets, const FileBoxes& boxes = {},
                 const GivenVoxels& given = {});

}  // namespace voxelume
