// SPDX-License-Identifier: Apache-2.0
// The kinds of surface that voxels hold.
#ifndef VXL_VOXEL_KINDS_H
#define VXL_VOXEL_KINDS_H

#include "lib/lanes/lanes.h"
#include "shared/voxel.h"

// 1 if voxels may be exact and cubes at once.
#define VXL_SHARED_CUBES (VXL_CUBES && (VXL_EXACT || VXL_FIELD_LISTS))

/// A mask for each kind. Smooth voxels hold fields: one field, or as many as their list says.
typedef struct {
    lane_int cubes, smooth, exact;
    lane_int lists;   // voxels whose record is the list of their fields
    lane_int behind;  // exact voxels that are also cubes; they aren't among `cubes`
} VoxelKinds;

/// The packed attributes of voxels as their cubes have them, for voxels with a cube.
static inline lane_uint attributes_of_cubes(lane_uint packed) {
    if (!VXL_SHARED_CUBES) return packed;
    const uint kind = VXL_KIND_EXACT_IN_CUBE << VXL_KIND_SHIFT;
    return LANES_SELECT(LANE_MASK(packed >= kind), packed & ~kind, packed);
}

/// The kinds of the `tested` lanes' voxels; they are read only if the world has several.
static inline VoxelKinds kinds_of(global const uint* restrict attributes, lane_uint voxel,
                                  lane_int tested) {
    const lane_int none = (lane_int)0;
    VoxelKinds k = {VXL_CUBES ? tested : none, VXL_SMOOTH ? tested : none,
                    VXL_EXACT ? tested : none, none, none};
    if (VXL_CUBES + VXL_SMOOTH + VXL_EXACT + VXL_FIELD_LISTS > 1) {
        const lane_uint kind = LANES_GATHER_UINT(attributes, voxel) >> VXL_KIND_SHIFT;
        k.cubes &= LANE_MASK(kind == VXL_KIND_CUBES);
        if (VXL_SHARED_CUBES) k.behind = tested & LANE_MASK(kind == VXL_KIND_EXACT_IN_CUBE);
        const lane_int exact = LANE_MASK(kind == VXL_KIND_EXACT) | k.behind;
        if (VXL_FIELD_LISTS) k.lists = tested & exact;
        k.smooth &= LANE_MASK(kind == VXL_KIND_SMOOTH) | k.lists;
        k.exact &= exact;
    }
    return k;
}

#endif
