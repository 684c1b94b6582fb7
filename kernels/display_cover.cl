// SPDX-License-Identifier: Apache-2.0
// points on lines along a lattice's axes -> how often the lines in each shown voxel cross surfaces.
#include "lib/display/lattice_mask.h"
#include "lib/lanes/work_item.h"
#include "shared/display.h"

// Points of a line that are closer together, in voxels, and cross in the same sense are one: a line
// through the edge of two triangles, or through the side between two voxels of the world, meets the
// same surface twice.
#define VXL_SAME_POINT 0.0009765625f

/// True if a point before this one on its line is the same.
static inline bool is_again(global const float* points, uint total, uint n, uint axis) {
    const uint a = (axis + 1u) % 3u, b = (axis + 2u) % 3u;
    const float here = points[axis * total + n];
    if ((as_uint(here) & VXL_CROSSES_SENSES) == VXL_CROSSES_CUBE)
        return false;  // one for each cube
    for (uint i = n; i-- > 0u;) {
        if (points[a * total + i] != points[a * total + n] ||
            points[b * total + i] != points[b * total + n])
            return false;
        const float there = points[axis * total + i];
        if (((as_uint(there) ^ as_uint(here)) & VXL_CROSSES_SENSES) == 0u &&
            fabs(there - here) < VXL_SAME_POINT)
            return true;
    }
    return false;
}

static inline bool is_shown(global const uint* mask, size_t place) {
    return (mask[place >> 5] & (1u << (place & 31u))) != 0u;
}

/// Adds the points, which lie on lines along `axis`, to their voxels: VXL_CROSSES_SENSES counts for
/// each axis and each voxel. No line lies on a side of a voxel. Cubes within a row of cubes, whose
/// voxels show nothing, count for the voxel before them that does.
kernel void count_covers(DisplayLattice lattice, uint point_count, uint total,
                         global const float* restrict points, uint axis,
                         global const uint* restrict mask, global const uint* restrict starts,
                         global uint* restrict counts) {
    const uint n = work_item();
    if (n >= point_count || is_again(points, total, n, axis)) return;
    const float3 cell =
        floor((float3)(points[n], points[total + n], points[2u * (size_t)total + n]));
    int4 v = (int4)((int)cell.x, (int)cell.y, (int)cell.z, 0);
    const int4 back = (int4)(axis == 0u, axis == 1u, axis == 2u, 0);
    const uint sense = as_uint(points[axis * (size_t)total + n]) & VXL_CROSSES_SENSES;
    while (is_in_display(&lattice, v) && !is_shown(mask, index_of(&lattice, v)) &&
           sense == VXL_CROSSES_CUBE)
        v -= back;
    if (!is_in_display(&lattice, v) || !is_shown(mask, index_of(&lattice, v))) return;
    const size_t voxel = number_of(mask, starts, index_of(&lattice, v));
    atomic_inc(counts + (voxel * 3u + axis) * VXL_CROSSES_SENSES + sense);
}
