// SPDX-License-Identifier: Apache-2.0
// The voxels of P as kernels write them.
#ifndef VXL_VOXELS_H
#define VXL_VOXELS_H

/// The parameters that `bind` of VoxelArrays sets, in its order.
#define VXL_VOXEL_PARAMETERS                                             \
    global ulong *restrict indices, global float *restrict colors,       \
        global float *restrict opacities, global float *restrict depths, \
        global uint *restrict objects

/// The arrays are described in runtime/stages/display/display_rays.hpp.
typedef struct {
    global ulong* restrict indices;
    global float* restrict colors;
    global float* restrict opacities;
    global float* restrict depths;
    global uint* restrict objects;
} VoxelArrays;

/// The value of VoxelArrays in a kernel with these parameters.
#define VXL_VOXELS \
    { indices, colors, opacities, depths, objects }

/// What kernels compute for one packet's voxels, one value per lane.
typedef struct {
    float color[3 * VXL_LANES];
    float opacity[VXL_LANES];
    float depth[VXL_LANES];
    uint object[VXL_LANES];
} VoxelValues;

/// Writes one lane's values to a voxel.
static inline void store_voxel(const VoxelArrays* voxels, size_t voxel, const VoxelValues* values,
                               uint lane) {
    voxels->objects[voxel] = values->object[lane];
    voxels->opacities[voxel] = values->opacity[lane];
    voxels->depths[voxel] = values->depth[lane];
    for (uint channel = 0; channel < 3; ++channel)
        voxels->colors[3 * voxel + channel] = values->color[channel * VXL_LANES + lane];
}

#endif
