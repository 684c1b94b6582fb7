// SPDX-License-Identifier: Apache-2.0
// Which voxels a solid or its surface covers, over lanes.
#ifndef VXL_SOLID_COVER_H
#define VXL_SOLID_COVER_H

#include "lib/solid/solid.h"

#define VXL_SET_SUPERCOVER 0u  // the numbers of voxelume::VoxelSet
#define VXL_SET_THIN 1u
#define VXL_SET_SOLID 2u

/// The distance at a point of a voxel, given in quarters of the voxel, 0..4 along each axis; 2 is
/// the voxel's middle.
static inline SolidDistance distance_in_voxel(global const SolidShape* solids, lane_int x,
                                              lane_int y, lane_int z, float3 quarter) {
    LatticePoint at;
    at.x = x, at.y = y, at.z = z;
    at.offset_x = (lane_float)(quarter.x * 0.25f);
    at.offset_y = (lane_float)(quarter.y * 0.25f);
    at.offset_z = (lane_float)(quarter.z * 0.25f);
    return solid_distance(solids, 0, at);
}

/// Mask: the point is in the solid. Adds lanes to *is_open where rounding could have decided
/// otherwise.
static inline lane_int is_inside(SolidDistance d, lane_int* is_open) {
    *is_open |= LANE_MASK(fabs(d.distance) <= d.rounding);
    return LANE_MASK(d.distance <= 0.0f);
}

/// THIN: the voxel's middle and the middle of one of its faces are on different sides. A path of
/// voxels that share faces crosses such a voxel wherever it passes from outside to inside.
static inline lane_int thin_voxels(global const SolidShape* solids, lane_int x, lane_int y,
                                   lane_int z, lane_int* is_open) {
    const lane_int middle =
        is_inside(distance_in_voxel(solids, x, y, z, (float3)(2.0f, 2.0f, 2.0f)), is_open);
    lane_int differs = (lane_int)0;
    for (int face = 0; face < 6; ++face) {
        const float end = face & 1 ? 4.0f : 0.0f;
        const float3 quarter = (float3)(face >> 1 == 0 ? end : 2.0f, face >> 1 == 1 ? end : 2.0f,
                                        face >> 1 == 2 ? end : 2.0f);
        differs |= middle ^ is_inside(distance_in_voxel(solids, x, y, z, quarter), is_open);
    }
    return differs;
}

/// SUPERCOVER: corners lie on both sides, or the surface comes within half the diagonal of an
/// eighth of the voxel to that eighth's middle. No voxel that the surface touches is left out,
/// since between two points the solid's distance changes by at most the way from one to the other.
/// The surface comes within 0.44 voxel of every voxel in the set.
static inline lane_int surface_voxels(global const SolidShape* solids, float voxel_reach,
                                      lane_int x, lane_int y, lane_int z) {
    const SolidDistance middle = distance_in_voxel(solids, x, y, z, (float3)(2.0f, 2.0f, 2.0f));
    const lane_int near = LANE_MASK(fabs(middle.distance) <= voxel_reach + middle.rounding);
    lane_int inner = (lane_int)0, outer = (lane_int)0, touched = (lane_int)0;
    for (int corner = 0; corner < 8 && lanes_any(near & ~(inner & outer)); ++corner) {
        const float3 quarter =
            (float3)((float)(corner & 1), (float)(corner >> 1 & 1), (float)(corner >> 2)) * 4.0f;
        const SolidDistance d = distance_in_voxel(solids, x, y, z, quarter);
        inner |= LANE_MASK(d.distance <= d.rounding);
        outer |= LANE_MASK(d.distance >= -d.rounding);
    }
    touched = near & inner & outer;
    for (int part = 0; part < 8 && lanes_any(near & ~touched); ++part) {
        const float3 quarter =
            (float3)((float)(part & 1), (float)(part >> 1 & 1), (float)(part >> 2)) * 2.0f + 1.0f;
        const SolidDistance d = distance_in_voxel(solids, x, y, z, quarter);
        touched |= near & LANE_MASK(fabs(d.distance) <= 0.5f * voxel_reach + d.rounding);
    }
    return touched;
}

/// Mask of the voxels that belong to `set`. Adds those that floats cannot decide to *is_open.
static inline lane_int covered_voxels(global const SolidShape* solids, uint set, float voxel_reach,
                                      lane_int x, lane_int y, lane_int z, lane_int* is_open) {
    if (set == VXL_SET_SOLID)
        return is_inside(distance_in_voxel(solids, x, y, z, (float3)(2.0f, 2.0f, 2.0f)), is_open);
    if (set == VXL_SET_THIN) return thin_voxels(solids, x, y, z, is_open);
    return surface_voxels(solids, voxel_reach, x, y, z);
}

#endif
