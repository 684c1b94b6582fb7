// SPDX-License-Identifier: Apache-2.0
// Faces at which cubes of glass touch glass cubes of another object or material.
//
// There is no gap between the two, so such a face is one surface. A ray meets it twice: it leaves
// one body and enters the other. Where the ray enters, the face is hidden. Where it leaves, the
// face bends light from one index of refraction to the other, and is hidden if they are equal.
#ifndef VXL_GLASS_FACES_H
#define VXL_GLASS_FACES_H

#include "lib/surface/cube_body.h"
#include "lib/traverse/voxel_kinds.h"
#include "lib/traverse/world.h"

/// A cell next to a face.
typedef struct {
    lane_int x, y, z;
} FaceCell;

/// The cell's neighbour along `axis`, towards larger coordinates where `up`.
static inline FaceCell neighbor_of(FaceCell cell, lane_uint axis, lane_int up) {
    const lane_int step = -1 - 2 * up;
    FaceCell next = cell;
    next.x += step & LANE_MASK(axis == 0u);
    next.y += step & LANE_MASK(axis == 1u);
    next.z += step & LANE_MASK(axis == 2u);
    return next;
}

/// The packed attributes of the glass cubes in the `asked` lanes' cells; VXL_NO_MEDIUM where there
/// are none.
static inline lane_uint glass_in(const PyramidView* p, const SurfaceView* s, FaceCell c,
                                 global const float* restrict materials, lane_int asked) {
    const lane_uint none = (lane_uint)VXL_NO_MEDIUM;
    asked &= LANE_MASK(c.x >= 0) & LANE_MASK(c.y >= 0) & LANE_MASK(c.z >= 0) &
             LANE_MASK(c.x < p->size_x) & LANE_MASK(c.y < p->size_y) & LANE_MASK(c.z < p->size_z);
    if (!VXL_ATTRIBUTES || !lanes_any(asked))
        return none;  // a single object has no other glass next to it
    const lane_int x = c.x & asked, y = c.y & asked, z = c.z & asked;
    LastSector last = no_sector();
    const CellState cell = look_up(p, x, y, z, asked, &last);
    const lane_int some = cell.occupied & asked;
    const lane_uint voxel =
        voxel_number(p, cell.leaf & LANES_AS_UINT(some), x, y, z) & LANES_AS_UINT(some);
    const lane_uint packed = LANES_SELECT(some, LANES_GATHER_UINT(s->attributes, voxel), none);
    const lane_int glass =
        LANE_MASK((packed >> VXL_KIND_SHIFT) == VXL_KIND_CUBES) & is_joined(packed, materials);
    return LANES_SELECT(glass, packed, none);
}

/// Mask: rays with the sets `in` that cross faces between the glass `packed` and the glass
/// `beyond`, while no other object that they are inside of counts on either side. Rays in `exit`
/// leave the glass `packed`; the others enter it.
static inline lane_int are_between_glass(const MediumSet* in, lane_uint packed, lane_uint beyond,
                                         lane_int exit, global const uint* restrict ranks) {
    const MediumSet others = cross_medium(*in, packed, (lane_int)-1, exit);
    const lane_uint last = max(rank_of(ranks, packed), rank_of(ranks, beyond));
    return LANE_MASK(beyond != VXL_NO_MEDIUM) &
           LANE_MASK(last < rank_of(ranks, effective_medium(&others, ranks)));
}

/// Mask: pairs of glass with equal indices of refraction.
static inline lane_int bend_alike(lane_uint packed, lane_uint other,
                                  global const float* restrict materials) {
    const lane_int some = LANE_MASK(packed != VXL_NO_MEDIUM) & LANE_MASK(other != VXL_NO_MEDIUM);
    const lane_uint a = material_offset(packed) & LANES_AS_UINT(some);
    const lane_uint b = material_offset(other) & LANES_AS_UINT(some);
    return some & LANE_MASK(LANES_GATHER_FLOAT(materials, a + VXL_MATERIAL_IOR) ==
                            LANES_GATHER_FLOAT(materials, b + VXL_MATERIAL_IOR));
}

#endif
