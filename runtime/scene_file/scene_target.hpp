// SPDX-License-Identifier: Apache-2.0
// The value of a scene that a track changes: "objects.ball.position", "models.block.parts[1].turn".
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/scene_motion.hpp"
#include "runtime/scene_file/document/scene_fields.hpp"
#include "runtime/scene_file/document/scene_path.hpp"

namespace voxelume {

/// A value that a track may change.
struct TrackTarget {
    ScenePart part = ScenePart::world;
    size_t number = 0;  ///< index of the part among its kind, in the order of the document
    std::string name;   ///< name of a material or model
    std::string path;   ///< path of the part, for messages
    const JsonValue* value = nullptr;  ///< the part in the document
    std::vector<PathStep> steps;       ///< from the part to the value; a last key may be missing
};

/// Finds the target of a path in a document.
///
/// Throws Error::scene with the nearest name if there is no such part or value, or none that can
/// change.
TrackTarget find_target(const SceneValue& path, const JsonValue& document);

}  // namespace voxelume
