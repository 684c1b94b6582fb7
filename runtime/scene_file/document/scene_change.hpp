// SPDX-License-Identifier: Apache-2.0
// Values that replace a scene's, or are added to it, before it is read.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/document/scene_document.hpp"

namespace voxelume {

/// A value for a path of the scene's document.
struct SceneChange {
    std::string path;    ///< "objects.ball.position", "lights[0].intensity"
    std::string value;   ///< text for `parse_value`; "null" removes what the path names
    std::string origin;  ///< the change in messages: "--set objects.ball.position=0,1"
};

/// A value as people write it: JSON, numbers separated by commas, or a text without quotes. Throws
/// Error::usage for a list, an object or a quoted text that is not JSON; `origin` opens the
/// message.
JsonValue parse_value(std::string_view text, const std::string& origin);

/// Reads a document with changes, applied one after another. Keys that are missing on the way are
/// added; keys that don't belong there are refused by the readers of all scenes.
///
/// Items of a list are named by their names or indices. Throws Error::usage, opened by the change's
/// origin, for a path that can't be read or names no part, and for a value that `read` refuses;
/// otherwise throws as `read` does.
Scene read_changed(const JsonValue& document, std::span<const SceneChange> changes,
                   const std::function<Scene(const JsonValue&)>& read);

}  // namespace voxelume
