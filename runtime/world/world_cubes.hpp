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
    int resolution = 0;  ///< along the longest side of everything shown; 0: the scene's voxels
};

/// The voxels of the scene's world with every object as cubes, in the product of the voxels' and
/// the materials' colours. A voxel's opacity is its material's times its own; voxels below 1/512
/// are left out. Checkers, emission, reflection and refraction are ignored.
///
/// Throws as WorldBuilder::build does, and Error::input for a world without voxels.
VoxelModel world_cubes(const Device& device, Scene scene, AssetStore meshes, CubeSize size = {});

}  // namespace voxelume
