// SPDX-License-Identifier: Apache-2.0
// scene -> a bound of where each object is in the world's lattice
#pragma once

#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/assets/model_frame.hpp"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// A box around each object as the world shows it, in the world's voxels, cut to the lattice. It is
/// empty for objects outside the lattice.
///
/// Surfaces may lie up to a voxel away from the object's own, so the boxes are larger by a voxel.
/// Throws Error::input as AssetStore does.
std::vector<VoxelBox> object_boxes(const Scene& scene, AssetStore& meshes);

}  // namespace voxelume
