// SPDX-License-Identifier: Apache-2.0
// A scene that changes -> the scene of one frame.
#pragma once

#include "runtime/base/error.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// True if any frame may differ from another.
bool moves(const Scene& scene);

/// The scene as it is at a frame, 1 being the first; frames may be fractions and lie outside of the
/// animation. Values without a track stay as they are in `scene`, even if they were changed after
/// reading: lattices of the world and its models, the image's size, the display's voxels.
///
/// No file is read: files were found when the scene was read. Throws Error::scene, with the frame,
/// for values that contradict each other although they don't at any key.
Scene scene_at(const Scene& scene, double frame);

/// The error as one of a frame: its sentence ends with "(at frame 7)".
Error at_frame(const Error& error, double frame);

/// Calls an action that concerns a frame of `scene`. Errors are rethrown with the frame, if the
/// scene moves.
template <class Action>
auto in_frame(const Scene& scene, double frame, const Action& action) {
    try {
        return action();
    } catch (const Error& error) {
        if (!moves(scene)) throw;
        throw at_frame(error, frame);
    }
}

}  // namespace voxelume
