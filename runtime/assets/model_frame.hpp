// SPDX-License-Identifier: Apache-2.0
// The lattices that a scene requires: that of the world, and that of each model in its own space.
#pragma once

#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The lattice of a model in its own space, with kModelMargin. `mesh` is null for a solid.
///
/// Throws Error::input for a model without extent whose voxels `resolution` decides, and
/// Error::limit for more voxels than can be numbered. The sentence begins with the model's place in
/// the scene file.
GridFrame model_frame(const Model& model, const MeshSummary* mesh);

/// True if the object is visible and its model isn't empty within the world's bounds.
bool may_be_shown(const Scene& scene, const Object& object);

/// True if any part of the object can be seen inside the world. Models without such objects aren't
/// read.
bool is_potentially_visible(const Scene& scene, const Object& object);

}  // namespace voxelume
