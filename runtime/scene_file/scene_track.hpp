// SPDX-License-Identifier: Apache-2.0
// A value of a scene's text over time: its keys, as the scene's "tracks" have them.
#pragma once

#include "runtime/scene/keyframes.hpp"
#include "runtime/scene_file/scene_target.hpp"

namespace voxelume {

/// Keys of one target. All values have one form: a number, a list of as many numbers, true or
/// false, or text.
struct DocumentTrack {
    TrackTarget target;
    SourcePlace where;
    Keyframes keys;                 ///< values are empty for true, false and text
    std::vector<JsonValue> values;  ///< as the document has them
};

/// Reads a track. Frame 1 is at time 0, so a key's time in seconds is frame 1 + time * `fps`.
///
/// Throws Error::scene; whether the values suit the target is left to the target's own reader.
DocumentTrack read_track(const SceneValue& value, const JsonValue& document, double fps);

/// The target's value at a frame, which stands in the document where the key before it does.
JsonValue value_at(const DocumentTrack& track, double frame);

}  // namespace voxelume
