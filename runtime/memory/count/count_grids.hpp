// SPDX-License-Identifier: Apache-2.0
// how much a grid is expected to hold -> the grid on a counting device, made as voxelizing makes
// it.
#pragma once

#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// What voxelizing a model is expected to find.
struct GridCounts {
    GridFrame frame;
    Surface surface = Surface::cubes;
    VoxelSet set = VoxelSet::supercover;
    bool words = false;                  ///< voxels have some
    MeshPaint paint = {};                ///< what gives voxels colours
    bool normals = false;                ///< the mesh's triangles have them
    uint64_t texture_key = 0;            ///< tells the textures of one mesh from another's
    bool cube_normals = false;           ///< cubes have them
    size_t bricks = 0;                   ///< stored
    size_t voxels = 0;                   ///< that the surface passes through
    size_t listed = 0;                   ///< primitives that those of an exact surface list
    size_t vertices = 0, triangles = 0;  ///< of a mesh
    size_t shapes = 0;                   ///< of an analytic solid
    size_t parts = 1;                    ///< ... or of a cut mesh, whose distances are kept apart
    size_t cut_bricks = 0;               ///< of a cut mesh's other parts
};

/// The grid of a mesh, or of a solid, which has `shapes`. Whatever else is made is freed before it
/// returns; the device's counters tell the maximum.
BrickGrid count_mesh_grid(const Device& device, const GridCounts& counts);
BrickGrid count_solid_grid(const Device& device, const GridCounts& counts);

/// The part of a mesh's `whole` grid, of `counts`, that cuts leave. The cuts' own grids are freed,
/// but for smooth meshes.
BrickGrid count_cut_grid(const Device& device, const BrickGrid& whole, const GridCounts& counts);

}  // namespace voxelume
