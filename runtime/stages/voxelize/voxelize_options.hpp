// SPDX-License-Identifier: Apache-2.0
// The options of voxelization: shared by the stages that voxelize meshes and analytic solids.
#pragma once

#include "runtime/scene/parts/object.hpp"

namespace voxelume {

struct VoxelizeOptions {
    Surface surface = Surface::smooth;
    VoxelSet set = VoxelSet::supercover;  ///< for `cubes`; the other surfaces choose their own
    double band = 2.8;  ///< for `smooth`: the distance up to which meshes' distances are exact, in
                        ///< shortest voxel edges, at most 4; rays and gradients at a surface read
                        ///< 2.8
    Shading shading{};  ///< for `exact` meshes, and cubes with normals of their mesh
    CubeNormals normals = CubeNormals::faces;  ///< for `cubes`
};

/// True if the options give each cube a normal.
inline bool has_cube_normals(const VoxelizeOptions& options) {
    return shows_voxels(options.surface) && options.normals == CubeNormals::surface;
}

/// The options of a model.
inline VoxelizeOptions options_of(const Model& model) {
    return {.surface = model.surface,
            .set = model.set,
            .shading = model.shading,
            .normals = model.normals};
}

}  // namespace voxelume
