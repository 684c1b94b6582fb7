// SPDX-License-Identifier: Apache-2.0
// The leaves and voxels of a pyramid, as the kernels of index.cl and index_fields.cl fill them.
#ifndef VXL_WRITTEN_VOXELS_H
#define VXL_WRITTEN_VOXELS_H

#include "lib/lanes/work_item.h"

/// The parameters that runtime/stages/index/index.hpp binds to WrittenVoxels, in its order.
#define VXL_WRITTEN_PARAMETERS                                                      \
    global uint *restrict leaves, global uint *restrict leaf_voxels,                \
        global uint *restrict voxel_attributes, global uint *restrict voxel_colors, \
        global uint *restrict voxel_normals, global uint *restrict voxel_fields,    \
        global uint *restrict voxel_primitive_first, global uint *restrict voxel_primitives

/// runtime/grid/grid.hpp has the layout of each.
typedef struct {
    global uint* leaves;
    global uint* leaf_voxels;
    global uint* attributes;
    global uint* colors;
    global uint* normals;
    global uint* fields;
    global uint* primitive_first;
    global uint* primitives;
} WrittenVoxels;

/// The value of WrittenVoxels in a kernel with these parameters.
#define VXL_WRITTEN                                                                       \
    {                                                                                     \
        leaves, leaf_voxels, voxel_attributes, voxel_colors, voxel_normals, voxel_fields, \
            voxel_primitive_first, voxel_primitives                                       \
    }

/// Writes the next leaf, with the mask of its voxels and the number of its first voxel.
static inline void write_leaf(const WrittenVoxels* to, uint leaf, ulong mask, uint first_voxel) {
    vstore2(as_uint2(mask), leaf, to->leaves);
    to->leaf_voxels[leaf] = first_voxel;
}

#endif
