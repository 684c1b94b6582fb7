// SPDX-License-Identifier: Apache-2.0
// scene -> the cubes of its world, for files of voxels.
#pragma once

#include "runtime/assets/asset_store.hpp"
#include "runtime/geometry/voxel_model.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The voxels of a world's cubes.
struct CubeSize {
    double edge = 0;     ///< metres; 0: `resolution` decides
    int resolution = 0;  ///< along the longest side of all that is shown; 0: they are the scene's
};

/// The voxels of the scene's world with every object as cubes in it, in the colours of voxels times
/// those of materials. A voxel's opacity is its material's times its own; one below 1/512 is no
/// voxel. Checkers, and what shines, reflects or refracts, aren't told.
///
/// Throws as WorldBuilder::build does, and Error::input for a world without voxels.
VoxelModel world_cubes(const Device& device, Scene scene, AssetStore meshes, CubeSize size = {});

}  // namespace voxelume
