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

/// Reads and checks a scene. The format is described in scenes/README.md. What the scene leaves out
/// is fitted to its objects, for which `boxes` tells how large the contents of files are; scenes
/// that leave out nothing need none.
///
/// Throws Error::scene, "file:line:column: key path: sentence", for text or values that are wrong,
/// Error::input for a scene or asset that is missing, Error::limit for a file of more than 64 MiB.
Scene read_scene(const std::filesystem::path& file, const AssetFolders& assets,
                 const FileBoxes& boxes = {});

/// The same for text that is at hand; `file` names it in messages and gives the folder of its
/// assets.
Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                  const AssetFolders& assets, const FileBoxes& boxes = {});

/// Reads a scene's text as a tree of values. Throws as `parse_json` does, Error::input for a file
/// that is missing, Error::limit for one of more than 64 MiB.
JsonValue read_document(const std::filesystem::path& file);

/// The same for a tree of values, whichever way it was made: all scenes are checked here. Nothing
/// of the tree is kept. Models whose "voxels" has a name of `given` show those.
Scene read_scene(const JsonValue& root, const std::filesystem::path& file,
                 const AssetFolders& assets, const FileBoxes& boxes = {},
                 const GivenVoxels& given = {});

}  // namespace voxelume
