// scene -> where in the world's lattice each object is at most.
#pragma once

#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/assets/model_frame.hpp"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// A box around each object as the world shows it, in the world's voxels, cut to the lattice; empty
/// for objects that aren't in it.
///
/// Surfaces may lie a voxel from where the object's own is, so the boxes are that much larger.
/// Throws Error::input as AssetStore does.
std::vector<VoxelBox> object_boxes(const Scene& scene, AssetStore& meshes);

}  // namespace voxelume
