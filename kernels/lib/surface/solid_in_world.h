// SPDX-License-Identifier: Apache-2.0
// The tests of a packet's rays against analytic solids of the world, and how hits on triangles and
// solids replace one another.
#ifndef VXL_SOLID_IN_WORLD_H
#define VXL_SOLID_IN_WORLD_H

#include "lib/solid/solid_surface.h"
#include "lib/surface/coincident.h"

/// The largest float below t.
static inline lane_float float_before(lane_float t) {
    const lane_int bits = LANES_AS_INT(t);
    const lane_float next = LANES_AS_FLOAT(bits - 1 - (LANE_MASK(t < 0.0f) & -2));
    return LANES_SELECT(LANE_MASK(t == 0.0f), (lane_float)-FLT_MIN, next);
}

/// Tests solid `number` of each lane in `tested`; hits in the world that are closer than *t replace
/// it. Hits at t_first itself count only in the lanes of `counts_at_first`.
///
/// The `entering` lanes have entered the world, or left a body of cubes, across a face in which a
/// surface may lie. Rounding may put that surface before their origins, so their rays begin one
/// unit of t earlier; hits behind the origin count as far as rounding across the face explains.
static INLINED lane_int hit_solids_in_world(const PyramidView* p, const SurfaceView* s,
                                            const Walk* w, lane_uint number,
                                            const RayState* ray_state, const RayBeginning* from,
                                            lane_int tested, lane_int from_solid,
                                            lane_int counts_at_first, lane_int entering,
                                            lane_float* t) {
    lane_int closer = (lane_int)0;
    const lane_int nothing = (lane_int)0;
    const lane_int early = tested & entering;
    if (lanes_any(early)) {
        const SolidRay ray = {w->ox - w->dx, w->oy - w->dy, w->oz - w->dz, w->dx, w->dy, w->dz};
        lane_float from_before = (lane_float)INFINITY;
        const lane_int met = hit_solids(s->solids, number, &ray, (lane_float)0.0f, (lane_float)0.0f,
                                        nothing, nothing, early, &from_before);
        const lane_float at = LANES_SELECT(met, from_before - 1.0f, (lane_float)0.0f);
        const lane_float across = LANES_SELECT(LANE_MASK(w->axis == 0), w->ix,
                                               LANES_SELECT(LANE_MASK(w->axis == 1), w->iy, w->iz));
        // Floats have a face within 2^-25 of the way to its solid's centre. So 8 plane_bound are
        // enough for centres as far away as 64 lengths of the world.
        // A surface behind the voxel where a ray enters the world isn't listed there.
        const lane_int near = LANE_MASK(at >= -8.0f * p->plane_bound * fabs(across)) &
                              (ray_state->on_surface | is_in_cell(p, w, at));
        // Hits farther ahead are more exact from the origin itself.
        closer = met & is_in_world(p, w, at) & near & LANE_MASK(at <= coincidence(p, w)) &
                 LANE_MASK(at < *t);
        *t = LANES_SELECT(closer, at, *t);
    }
    const SolidRay ray = {w->ox, w->oy, w->oz, w->dx, w->dy, w->dz};
    const lane_int left = tested & ~closer;
    lane_float at = *t;
    lane_int met = (lane_int)0;
    if (lanes_any(left)) {
        lane_int inside = from_solid & ray_state->within_source;
        lane_int known = from_solid;
        lane_float t_first = ray_state->t_first;
        if (VXL_TRANSMISSION) {
            t_first = LANES_SELECT(counts_at_first, float_before(t_first), t_first);
            const lane_int holds =
                medium_set_holds(&ray_state->media, solid_attributes(s->solids, number));
            known |= holds;
            inside |= holds & ~from_solid;
        }
        lane_float t_clear = t_first;
        if (may_coincide(s)) {
            const lane_float none = (lane_float)0.0f;
            t_clear += LANES_SELECT(from->begins & ~from_solid, from->slack, none);
            t_first -= LANES_SELECT(from->goes_on & ~from_solid, from->slack, none);
        }
        met = hit_solids(s->solids, number, &ray, t_first, t_clear, known, inside, left, &at);
    }
    met &= is_in_world(p, w, LANES_SELECT(met, at, (lane_float)0.0f));
    *t = LANES_SELECT(met, at, *t);
    return closer | met;
}

/// Mask: among surfaces that a ray meets at the same t, the primitive comes after the ray's source.
/// Fields come first, then triangles and solids by their numbers.
static inline lane_int comes_after(lane_uint primitive, lane_uint source) {
    lane_int after = LANE_MASK(primitive > source);
    if (VXL_FIELD_LISTS) after |= LANE_MASK((source >> 30) == 1u);
    return after;
}

/// Mask: rays that continue for which a hit at the t of their last one counts.
static inline lane_int counts_again(const RayState* ray_state, lane_uint primitive) {
    if (!VXL_TRANSMISSION) return (lane_int)0;
    return ray_state->goes_on & comes_after(primitive, ray_state->source);
}

/// Takes the hits of the lanes that `met` a primitive at `at`, if they come first.
static inline void take_primitive(const SurfaceView* s, const RayState* ray_state,
                                  lane_uint primitive, lane_float at, lane_float slack,
                                  lane_int met, SurfaceHit* found) {
    const lane_int taken = comes_first(s, ray_state, primitive, at, slack, met, found);
    found->t = LANES_SELECT(taken, at, found->t);
    found->primitive = LANES_SELECT(taken, primitive, found->primitive);
}

/// Tests the solid `primitive` of each lane in `tested`.
static inline void hit_solid(const PyramidView* p, const SurfaceView* s, const Walk* w,
                             lane_uint primitive, const RayState* ray_state,
                             const RayBeginning* from, lane_int entering, lane_int tested,
                             SurfaceHit* found) {
    lane_float at = found->t + from->slack;
    const lane_int met =
        hit_solids_in_world(p, s, w, primitive & ~VXL_SOLID_PRIMITIVE & LANES_AS_UINT(tested),
                            ray_state, from, tested, LANE_MASK(primitive == ray_state->source),
                            counts_again(ray_state, primitive), entering, &at);
    take_primitive(s, ray_state, primitive, at, from->slack, met, found);
}

#endif
