// SPDX-License-Identifier: Apache-2.0
// The first pass of indexing: finds the voxels of a grid that rays must see.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// The results of `mark_voxels` for a grid's bricks.
struct VoxelMarks {
    Buffer<uint64_t> masks;           ///< 64 per slot, and spare room: the voxels of each leaf
    std::vector<uint64_t> leaf_mask;  ///< per slot
    std::vector<uint32_t> counts;     ///< 2 per slot: voxels, primitives
    std::vector<uint32_t> slots;      ///< BrickGrid::slots of the marked grid, for marks that are
                                      ///< retained
};

/// The sums of bricks' marks until they are read.
struct MarkArrays {
    Buffer<uint64_t> leaf_mask;
    Buffer<uint32_t> counts;
};
MarkArrays allocate_marks(const Device& device, size_t bricks);

/// The constants of index.cl for a grid.
Defines index_defines(const BrickGrid& grid);

/// The marks of all bricks, by the kernels of index.cl that `program` was built from.
VoxelMarks mark_voxels(const Device& device, const Program& program, const BrickGrid& grid);

/// The marks of all of a grid's bricks, by kernels built for it.
VoxelMarks mark_grid(const Device& device, const BrickGrid& grid);

/// The marks of all bricks, updated from the marks `before` a change of the bricks with indices
/// `changed`. A voxel's mark depends on its own brick and that brick's neighbours only.
VoxelMarks mark_changed_voxels(const Device& device, const Program& program, const BrickGrid& grid,
                               const std::vector<uint32_t>& changed, VoxelMarks before);

}  // namespace voxelume
