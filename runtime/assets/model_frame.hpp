// The lattices that a scene asks for: of the world, and of each model in its own space.
#pragma once

#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Margin of empty voxels around a model, so that the differences of a smooth surface lie inside.
inline constexpr int kModelMargin = 4;

/// The world's lattice: its first voxel starts at the bounds' minimum corner.
GridFrame world_frame(const World& world);

/// The lattice of a model in its own space, with kModelMargin. `mesh` is null for a solid.
///
/// Throws Error::input for a model without extent whose voxels `resolution` decides, Error::limit
/// for more voxels than can be numbered; the sentence begins with the model's place.
GridFrame model_frame(const Model& model, const MeshSummary* mesh);

/// Whether rays see the voxels inside of the object, too: solid cubes that let light through.
bool shows_inside(const Scene& scene, const Object& object);

/// Whether the object is visible, and its model not empty within the world's bounds.
bool may_be_shown(const Scene& scene, const Object& object);

/// Whether any part of the object can be seen inside the world; models that aren't are not read.
bool is_potentially_visible(const Scene& scene, const Object& object);

}  // namespace voxelume
