// SPDX-License-Identifier: Apache-2.0
// The tracks and numbered files of a scene's text -> its motion.
#pragma once

#include <vector>

#include "runtime/scene/scene_motion.hpp"
#include "runtime/scene_file/document_part.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {

/// The parts of a scene that tracks or numbered files change, in the order of ScenePart. Marks
/// objects that move; the scene's plain values but the world's lattice and the observer must be
/// read. Throws Error::scene for tracks that are wrong.
std::vector<DocumentPart> moving_parts(const SceneValue& root, Scene& scene);

/// Adds the part to the motion. Parts on which it depends must be read first: the display of a
/// moving observer depends on the world's lattice. Nothing of the text is kept. Throws Error::scene
/// for values that are wrong at some key.
void add_part(const DocumentPart& part, const AssetSearch& search, const Scene& scene,
              SceneMotion& motion);

}  // namespace voxelume
