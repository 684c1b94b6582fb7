// SPDX-License-Identifier: Apache-2.0
// scene -> how high the steps are of cubes with normals that are resampled into the world's.
//
// Cubes of a model that is turned, or whose voxels aren't the world's, stand for two lattices: the
// world's voxels, and those of the model that they were taken from.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// True if the model's cubes may have normals of the surface that they stand for. A file that isn't
/// read (`reads` is false) may have them.
bool gives_cubes_normals(const Model& model, AssetStore& meshes, bool reads = true);

/// The frame of an object's voxels in object space, if they are cubes with normals in the world and
/// lie on another lattice than its voxels. Throws as ObjectLattices does.
std::optional<GridFrame> frame_of_resampled_cubes(const Scene& scene, const Object& object,
                                                  AssetStore& meshes);

/// Returns nine numbers of each object, row by row: the matrix that turns gradients in the world's
/// voxels into those in the object's. It is 0 for objects whose cubes aren't resampled or have no
/// normals; nothing is returned if that is true of all. `boxes` are those of object_boxes().
std::vector<float> cube_steps(const Scene& scene, AssetStore& meshes,
                              std::span<const VoxelBox> boxes);

}  // namespace voxelume
