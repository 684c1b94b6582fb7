// SPDX-License-Identifier: Apache-2.0
// A part of a scene's text with the tracks that change it, as read.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/scene_motion.hpp"
#include "runtime/scene_file/scene_parts.hpp"
#include "runtime/scene_file/scene_track.hpp"

namespace voxelume {

struct DocumentPart {
    ScenePart part = ScenePart::world;
    size_t number = 0;                 ///< number in the document
    size_t index = 0;                  ///< index in the scene's list
    std::string name;                  ///< name of a material or model
    std::string path;                  ///< path for messages
    const JsonValue* value = nullptr;  ///< value in the document
    std::vector<DocumentTrack> tracks;
    bool only_placed = false;  ///< an object that changes by its placement alone
};

/// Reads the part as it is at each key of its tracks, with the same readers as all scenes: between
/// keys only relations of values can go wrong. Throws as the readers do, with the frame.
void check_keys(const DocumentPart& part, const Scene& scene, const AssetSearch& search);

/// The part's tracks and numbered files as values. Throws as `find_asset` does.
MovingPart moving_part(const DocumentPart& part, const Scene& scene, const AssetSearch& search);

}  // namespace voxelume
