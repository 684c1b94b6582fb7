// SPDX-License-Identifier: Apache-2.0
// Parts that a scene's text leaves out <- the boxes of its objects, in all frames.
#pragma once

#include <functional>

#include "runtime/scene/scene.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {

/// Returns the box around the surface in a model's file, in the file's own coordinates. If
/// `is_first` is true, the first frame shows the file, so its contents are worth keeping.
using FileBoxes = std::function<Bounds(const Model& model, bool is_first)>;

/// Sets the maps of models that are fitted. Throws Error::scene for a file that is a single point,
/// and as `boxes` does.
void fit_models(const FileBoxes& boxes, Scene& scene);

/// Fits the world's lattice and the observer, if they are left out, to the objects that are visible
/// in any frame of `motion`; infinite solids don't count. Models without a voxel size get the
/// world's.
///
/// A mesh or a voxel file counts by its box along the axes of its file, so a turned mesh may get
/// more room than it needs. Throws Error::scene for a world without bounds and without objects that
/// it can be fitted to, Error::limit for too many voxels, and as `boxes` does.
void fit_to_objects(const SceneMotion& motion, const FileBoxes& boxes, Scene& scene);

}  // namespace voxelume
