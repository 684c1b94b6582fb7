// SPDX-License-Identifier: Apache-2.0
// A value of a scene's text over time: the keys of the scene's "tracks".
#pragma once

#include "runtime/scene/keyframes.hpp"
#include "runtime/scene_file/scene_target.hpp"

namespace voxelume {

/// The keys of one target. All values have one form: a number, a list of equally many numbers, a
/// bool, or text.
struct DocumentTrack {
    TrackTarget target;
    SourcePlace where;
    Keyframes keys;                 ///< values are empty for true, false and text
    std::vector<JsonValue> values;  ///< values in the document
};

/// Reads a track. Frame 1 is at time 0, so a key's time in seconds is frame 1 + time * `fps`.
///
/// Throws Error::scene; whether the values suit the target is left to the target's own reader.
DocumentTrack read_track(const SceneValue& value, const JsonValue& document, double fps);

/// The target's value at a frame, at the position in the document of the key before it.
JsonValue value_at(const DocumentTrack& track, double frame);

}  // namespace voxelume
