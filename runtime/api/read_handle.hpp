// SPDX-License-Identifier: Apache-2.0
// A scene's text, structs or model file -> a handle, with what had to be read on the way.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/scene_file/assets.hpp"
#include "runtime/scene_file/document/scene_change.hpp"
#include "runtime/scene_file/fit_scene.hpp"
#include "runtime/voxelume/scene.hpp"

namespace voxelume::api {

/// The sources of the files that a reader of scenes needs.
struct SceneFiles {
    AssetFolders assets;
    const FileBoxes& boxes;
    const std::function<AssetStore&()> store;  ///< made when it is first asked for
    std::vector<SceneChange> changes;
    double orbit = 0;   ///< degrees
    std::string& hash;  ///< set by the reader to the hash of the scene's document
    GivenVoxels given;
};

using ReadScene = std::function<Scene(const SceneFiles& files)>;

/// A handle of the scene that `read` makes. Files are read only where the scene is fitted to them;
/// what was read is kept until the scene is rendered.
v1::Scene read_handle(const v1::SceneOptions& options, const ReadScene& read);

/// The scene of a document, which `file` names, with the changes that were asked for.
Scene read_with_changes(const JsonValue& document, const std::filesystem::path& file,
                        const SceneFiles& files);

}  // namespace voxelume::api
