// SPDX-License-Identifier: Apache-2.0
// The tracks and numbered files of a scene's text -> its motion.
#pragma once

#include <memory>

#include "runtime/scene/scene_motion.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {

/// The motion of a scene whose plain values are read, or null when it stands still. Marks objects
/// that move. Nothing of the text is kept.
///
/// Throws Error::scene for tracks that are wrong, and for values that are at some key.
std::shared_ptr<const SceneMotion> read_motion(const SceneValue& root, const AssetSearch& search,
                                               Scene& scene);

}  // namespace voxelume
