// A scene that changes -> the scene of one frame.
#pragma once

#include "runtime/scene.hpp"

namespace voxelume {

/// Whether any frame may differ from another.
bool moves(const Scene& scene);

/// The scene as it is at a frame, 1 being the first; frames may be fractions and lie outside of the
/// animation. What no track changes is kept as it is in `scene`, also where it was changed after
/// reading: lattices of the world and its models, the image's size, the display's voxels.
///
/// Throws Error::scene, with the frame, for values that are wrong there although they are right at
/// all keys, and Error::input for a numbered file that is missing.
Scene scene_at(const Scene& scene, double frame);

}  // namespace voxelume
