// SPDX-License-Identifier: Apache-2.0
// The packed attributes of the surface that a ray met.
#ifndef VXL_HIT_ATTRIBUTES_H
#define VXL_HIT_ATTRIBUTES_H

#include "lib/lanes/lanes.h"
#include "lib/traverse/voxel_kinds.h"
#include "lib/traverse/world.h"
#include "shared/solid.h"
#include "shared/trace.h"
#include "shared/voxel.h"

/// The packed attributes of solids: the fourth word of each one's first record.
static inline lane_uint solid_attributes(global const SolidShape* restrict solids,
                                         lane_uint number) {
    return LANES_GATHER_UINT((global const uint*)solids, number * VXL_SOLID_WORDS + 3u);
}

/// The packed attributes of each lane's `voxel`, or of its primitive where it hit one.
static inline lane_uint attributes_of_hit(const SurfaceView* s, lane_uint voxel,
                                          lane_uint primitive, lane_int hit) {
    lane_uint packed = (lane_uint)s->constant_attribute;
    if (VXL_ATTRIBUTES) packed = attributes_of_cubes(LANES_GATHER_UINT(s->attributes, voxel));
    const lane_int exact = LANE_MASK(primitive != VXL_NO_PRIMITIVE) & hit;
    const lane_int solid = LANE_MASK((primitive & VXL_SOLID_PRIMITIVE) != 0u) & exact;
    const lane_int triangle = exact & ~solid;
    if (VXL_TRIANGLES)
        packed = LANES_SELECT(
            triangle,
            LANES_GATHER_UINT(s->triangle_attributes, primitive & LANES_AS_UINT(triangle)), packed);
    if (VXL_SOLIDS)
        packed = LANES_SELECT(
            solid,
            solid_attributes(s->solids, primitive & ~VXL_SOLID_PRIMITIVE & LANES_AS_UINT(solid)),
            packed);
    return packed;
}

/// Mask: hits on surfaces of smooth objects.
static inline lane_int is_smooth(lane_uint packed, lane_uint primitive) {
    return LANE_MASK((packed >> VXL_KIND_SHIFT) != VXL_KIND_CUBES) &
           LANE_MASK(primitive == VXL_NO_PRIMITIVE);
}

/// RayState::source for rays that begin on a surface: its primitive or, where voxels may hold
/// several fields or objects may have both fields and triangles, VXL_FIELD_SOURCE with the field's
/// number. `packed` are the surface's packed attributes.
static inline lane_uint source_of_hit(lane_uint primitive, lane_uint number, lane_uint packed) {
    if (!(VXL_FIELD_LISTS | VXL_MIXED)) return primitive;
    return LANES_SELECT(is_smooth(packed, primitive), number | VXL_FIELD_SOURCE, primitive);
}

/// source_of_hit for a batch's hits from `first` on.
static inline lane_uint source_of_hits(global const uint* hits, uint stride, uint first,
                                       lane_uint packed) {
    lane_uint primitive = (lane_uint)VXL_NO_PRIMITIVE;
    if (VXL_EXACT) primitive = LANES_LOAD(hits, VXL_HIT_PRIMITIVE * stride + first);
    if (!(VXL_FIELD_LISTS | VXL_MIXED)) return primitive;
    return source_of_hit(primitive, LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first), packed);
}

#endif
