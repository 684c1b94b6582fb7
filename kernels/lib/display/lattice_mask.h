// SPDX-License-Identifier: Apache-2.0
// The voxels of a lattice that a point lies in, and the numbers of those that are shown.
#ifndef VXL_LATTICE_MASK_H
#define VXL_LATTICE_MASK_H

#include "lib/lanes/lanes.h"
#include "lib/traverse/display_shape.h"
#include "shared/display.h"

#define VXL_GROUP_WORDS 8

static inline float3 middle_of(const DisplayLattice* l, int4 v) {
    return (float3)(fma((float)v.x + 0.5f, l->edge.x, l->corner.x),
                    fma((float)v.y + 0.5f, l->edge.y, l->corner.y),
                    fma((float)v.z + 0.5f, l->edge.z, l->corner.z));
}

/// True if the display has voxel v, that is, if the voxel's middle lies in the display's shape.
static inline bool is_in_display(const DisplayLattice* l, int4 v) {
    if (v.x < 0 || v.y < 0 || v.z < 0 || v.x >= l->size_x || v.y >= l->size_y || v.z >= l->size_z)
        return false;
    if (l->cylinder) {
        const float x = 2.0f * ((float)v.x + 0.5f) - (float)l->size_x;
        const float z = 2.0f * ((float)v.z + 0.5f) - (float)l->size_z;
        const float along_x = x * (float)l->size_z, along_z = z * (float)l->size_x;
        const float radius = (float)l->size_x * (float)l->size_z;
        if (fma(along_x, along_x, along_z * along_z) > radius * radius) return false;
    }
    return is_in_shape(l, middle_of(l, v));
}

/// Voxel number `which` (0 .. 7) of the voxels that a point lies in or on. Its x is -1 if the voxel
/// has a lower number as well, or if the display doesn't have it.
static inline int4 voxel_at(const DisplayLattice* l, float3 point, uint which) {
    const float3 below = floor(point);
    int4 v = (int4)((int)below.x, (int)below.y, (int)below.z, 0);
    const int4 step = (int4)(which & 1u, (which >> 1) & 1u, which >> 2, 0);
    const bool twice = (step.x && below.x != point.x) || (step.y && below.y != point.y) ||
                       (step.z && below.z != point.z);
    v -= step;
    if (twice || !is_in_display(l, v)) v.x = -1;
    return v;
}

static inline size_t index_of(const DisplayLattice* l, int4 v) {
    return (size_t)v.x + (size_t)l->size_x * ((size_t)v.y + (size_t)l->size_y * (size_t)v.z);
}

static inline float3 load_point(global const float* points, uint total, uint n) {
    return (float3)(points[n], points[total + n], points[2 * total + n]);
}

static inline uint number_of(global const uint* mask, global const uint* starts, size_t index) {
    const size_t word = index >> 5, first = word & ~(size_t)(VXL_GROUP_WORDS - 1);
    uint number = starts[word / VXL_GROUP_WORDS];
    for (size_t i = first; i < word; ++i) number += popcount(mask[i]);
    return number + popcount(mask[word] & ((1u << (index & 31u)) - 1u));
}

#endif
