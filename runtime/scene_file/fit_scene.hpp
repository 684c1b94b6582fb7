// SPDX-License-Identifier: Apache-2.0
// What a scene's text leaves out <- the boxes of its objects, in all frames.
#pragma once

#include <functional>

#include "runtime/scene/scene.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {

/// Gives the box around the surface in a model's file, in the file's own coordinates. The file's
/// contents are shown in the first frame, so that they are worth keeping, or only later.
using FileBoxes = std::function<Bounds(const Model& model, bool is_first)>;

/// Sets the maps of models that are fitted. Throws Error::scene for a file that is a single point,
/// and as `boxes` does.
void fit_models(const FileBoxes& boxes, Scene& scene);

/// Fits the world's lattice and the observer, where they are left out, to the objects that are
/// visible in any frame of `motion`; infinite solids don't count. Models without voxels of their
/// own size get those of the world.
///
/// A mesh or a voxel file counts by its box along the axes of its file, so that a turned mesh may
/// be given more room than it needs. Throws Error::scene for a world without bounds and without
/// objects that it can be fitted to, Error::limit for too many voxels, and as `boxes` does.
void fit_to_objects(const SceneMotion& motion, const FileBoxes& boxes, Scene& scene);

}  // namespace voxelume
