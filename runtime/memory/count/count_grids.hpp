// SPDX-License-Identifier: Apache-2.0
// expected counts of a grid -> the grid on a counting device, made as voxelizing makes it.
#pragma once

#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The expected results of voxelizing a model.
struct GridCounts {
    GridFrame frame;
    Surface surface = Surface::cubes;
    VoxelSet set = VoxelSet::supercover;
    bool words = false;         ///< voxels have attributes
    MeshPaint paint = {};       ///< sources of the voxels' colours
    bool normals = false;       ///< the mesh's triangles have normals
    uint64_t texture_key = 0;   ///< differs between the textures of different meshes
    bool cube_normals = false;  ///< cubes have normals
    size_t bricks = 0;          ///< stored bricks
    size_t voxels = 0;          ///< voxels that the surface passes through
    size_t listed = 0;          ///< entries of the lists of primitives of an exact surface's voxels
    size_t vertices = 0, triangles = 0;  ///< counts of a mesh
    size_t shapes = 0;                   ///< shapes of an analytic solid
    size_t parts = 1;       ///< ... or of a cut mesh whose distances are stored separately
    size_t cut_bricks = 0;  ///< bricks of a cut mesh's other parts
};

/// The grid of a mesh, or of a solid, which has `shapes`. All other buffers are freed before the
/// function returns; the device's counters tell the maximum.
BrickGrid count_mesh_grid(const Device& device, const GridCounts& counts);
BrickGrid count_solid_grid(const Device& device, const GridCounts& counts);

/// The rest of a mesh's `whole` grid, of `counts`, after cuts. The cuts' own grids are freed,
/// except for smooth meshes.
BrickGrid count_cut_grid(const Device& device, const BrickGrid& whole, const GridCounts& counts);

}  // namespace voxelume
