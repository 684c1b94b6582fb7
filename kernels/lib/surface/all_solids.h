// SPDX-License-Identifier: Apache-2.0
// Worlds of few solids and nothing else: a ray tests all of them at once, and need not walk to the
// one that it meets.
//
// A test of a solid covers the whole ray, wherever it is made. So the first hit among all solids is
// that which a walk finds in the voxels that list them, with few exceptions. Rays may differ that
// leave the world within rounding of the hit, which walks count only where a voxel has listed the
// solid before, and rays that meet three coincident surfaces, whose order of tests counts.
#ifndef VXL_ALL_SOLIDS_H
#define VXL_ALL_SOLIDS_H

#include "lib/surface/surfaces.h"
#include "lib/traverse/approach.h"

/// Mask: the rays come, ahead of their origins, so near to the solid that they may meet it.
static inline lane_int may_meet(global const SolidShape* s, const Walk* w) {
    const lane_float x = ((float)s->cell[0] - w->ox) + s->fraction[0];
    const lane_float y = ((float)s->cell[1] - w->oy) + s->fraction[1];
    const lane_float z = ((float)s->cell[2] - w->oz) + s->fraction[2];
    const lane_float cx = fma(y, w->dz, -z * w->dy), cy = fma(z, w->dx, -x * w->dz),
                     cz = fma(x, w->dy, -y * w->dx);
    const float reach = s->reach * s->reach;
    const lane_float dd = fma(w->dx, w->dx, fma(w->dy, w->dy, w->dz * w->dz));
    const lane_float ahead = fma(x, w->dx, fma(y, w->dy, z * w->dz));
    return LANE_MASK(fma(cx, cx, fma(cy, cy, cz * cz)) <= reach * dd) &
           (LANE_MASK(ahead > 0.0f) | LANE_MASK(fma(x, x, fma(y, y, z * z)) <= reach));
}

/// The first hits of the `active` lanes up to t_end, without voxels; the walks stay where they
/// begin.
static INLINED SurfaceHit find_solid(const PyramidView* p, const SurfaceView* s, const Walk* w,
                                     lane_float t_end, lane_int active, const RayState* ray_state) {
    SurfaceHit found = no_hit_yet();
    active &= in_grid(p, w);
    const lane_int entering = LANE_MASK(w->t == 0.0f) & LANE_MASK(w->axis != 3);
    const RayBeginning from = beginning_of(p, s, w, ray_state);
    for (uint solid = 0; solid < s->solid_records; solid += s->solids[solid].shape_count) {
        const lane_int tested = active & may_meet(s->solids + solid, w);
        if (lanes_any(tested))
            hit_solid(p, s, w, (lane_uint)(solid | VXL_SOLID_PRIMITIVE), ray_state, &from, entering,
                      tested, &found);
    }
    found.hit = active & LANE_MASK(found.t < INFINITY) & LANE_MASK(found.t <= t_end);
    return found;
}

#endif
