// SPDX-License-Identifier: Apache-2.0
// Surfaces of two objects that coincide, such as a glass and the table that it stands on, or boxes
// with equal tops.
//
// Rounding puts the points where a ray meets such surfaces slightly before or behind each other,
// differently from ray to ray. So among hits that rounding may have exchanged, the object decides
// which one counts: opaque ones come first, then those that the ray enters, then those that it
// leaves, each by their priorities. Also, a ray that begins on one of the surfaces has already
// passed the back of the other.
#ifndef VXL_COINCIDENT_H
#define VXL_COINCIDENT_H

#include "lib/surface/surface_hit.h"
#include "lib/surface/triangle.h"
#include "lib/traverse/hit_attributes.h"
#include "lib/traverse/world.h"

// Added to the order of objects that a ray leaves: they come after all that it enters.
#define VXL_ORDER_LEAVING 0x40000000u

/// True if a world's exact surfaces may coincide, which takes several objects.
static inline bool may_coincide(const SurfaceView* s) {
    return VXL_ATTRIBUTES && s->order != 0;
}

/// The distance in t up to which surfaces count as coincident. Points of a ray are right within
/// plane_bound, and 1 / sin(7 degrees) is 8: where a ray grazes surfaces at less than 7 degrees,
/// rounding may separate coincident ones farther.
static inline lane_float coincidence(const PyramidView* p, const Walk* w) {
    return fmin(fabs(w->ix), fmin(fabs(w->iy), fabs(w->iz))) * (8.0f * p->plane_bound);
}

/// Mask: sources or hits that are a triangle or solid.
static inline lane_int is_primitive(lane_uint number) {
    return LANE_MASK(number != VXL_NO_PRIMITIVE) & LANE_MASK((number >> 30) != 1u);
}

/// The rank of a primitive's object in the order of coincident surfaces.
static inline lane_uint rank_in_order(const SurfaceView* s, const RayState* ray_state,
                                      lane_uint primitive, lane_int some) {
    const lane_uint packed = attributes_of_hit(s, (lane_uint)0, primitive, some);
    const lane_uint object = packed & VXL_OBJECT_MASK & LANES_AS_UINT(some);
    lane_uint rank = LANES_GATHER_UINT(s->order, object);
    if (VXL_TRANSMISSION)
        rank |= LANES_AS_UINT(medium_set_holds(&ray_state->media, packed)) & VXL_ORDER_LEAVING;
    return rank;
}

/// Mask: among the lanes that `met` a primitive at `at`, those that take it instead of what they
/// have already found.
static inline lane_int comes_first(const SurfaceView* s, const RayState* ray_state,
                                   lane_uint primitive, lane_float at, lane_float slack,
                                   lane_int met, const SurfaceHit* found) {
    const lane_int closer = met & LANE_MASK(at < found->t);
    if (!may_coincide(s)) return closer;
    const lane_int both =
        met & is_primitive(found->primitive) & LANE_MASK(fabs(at - found->t) <= slack);
    if (!lanes_any(both)) return closer;
    const lane_uint own = rank_in_order(s, ray_state, primitive, both);
    const lane_uint other = rank_in_order(s, ray_state, found->primitive, both);
    return LANES_SELECT(both & LANE_MASK(own != other), LANE_MASK(own < other), closer);
}

/// Mask: among the lanes that met a triangle close to where they begin, those for which it lies
/// ahead. For a triangle of the source's own object, t decides. For others, a ray meets the
/// `front`; it meets the back only if it is `within` the object, or if it `goes_on` and the object
/// comes after the source's: that is the back of a sheet, which has no inside.
static inline lane_int is_ahead(const SurfaceView* s, const RayState* ray_state,
                                lane_uint primitive, lane_float at, lane_int counts_at_first,
                                lane_int front, lane_int within, lane_int goes_on, lane_int near) {
    const lane_uint some = LANES_AS_UINT(near) & VXL_OBJECT_MASK;
    const lane_uint own = attributes_of_hit(s, (lane_uint)0, primitive, near) & some;
    const lane_uint source = attributes_of_hit(s, (lane_uint)0, ray_state->source, near) & some;
    const lane_int later = LANE_MASK(at > ray_state->t_first) |
                           (counts_at_first & LANE_MASK(at == ray_state->t_first));
    lane_int ahead = front | within;
    if (VXL_TRANSMISSION)
        ahead |= goes_on &
                 LANE_MASK(LANES_GATHER_UINT(s->order, own) > LANES_GATHER_UINT(s->order, source));
    return near & LANES_SELECT(LANE_MASK(own == source), later, ahead);
}

/// How rays that begin on surfaces meet others: surfaces that coincide with theirs may seem to lie
/// `slack` before or behind them.
typedef struct {
    lane_int begins;   // mask: backs of other objects near the ray's origin were already passed
    lane_int goes_on;  // mask: faces of other objects there are ahead, even if they seem not to be
    lane_float slack;
} RayBeginning;

/// What a packet's rays begin on among the world's exact surfaces.
static inline RayBeginning beginning_of(const PyramidView* p, const SurfaceView* s, const Walk* w,
                                        const RayState* ray_state) {
    RayBeginning from = {(lane_int)0, (lane_int)0, (lane_float)0.0f};
    if (!may_coincide(s)) return from;
    from.slack = coincidence(p, w);
    from.begins = (ray_state->on_surface | ray_state->goes_on) & is_primitive(ray_state->source);
    if (VXL_TRANSMISSION) from.goes_on = from.begins & (ray_state->goes_on | ray_state->refracted);
    return from;
}

/// hit_triangle, for surfaces that may coincide with the one on which the ray begins.
static inline lane_int hit_triangle_ahead(const PyramidView* p, const SurfaceView* s, const Walk* w,
                                          lane_uint number, const RayShear* shear,
                                          const RayState* ray_state, const RayBeginning* from,
                                          lane_float t_min, lane_int counts_at_first,
                                          lane_int within, lane_int outside, lane_int tested,
                                          lane_float* t) {
    lane_int front = (lane_int)0;
    lane_float at = *t;
    const lane_float back = LANES_SELECT(from->goes_on, from->slack, (lane_float)0.0f);
    lane_int met = hit_triangle(p, t_min - back, counts_at_first, s->triangles, number, w, shear,
                                within, outside, tested, &at, &front);
    if (may_coincide(s)) {
        const lane_int near =
            met & from->begins & LANE_MASK(at <= ray_state->t_first + from->slack);
        if (lanes_any(near))
            met &= ~near | is_ahead(s, ray_state, number, at, counts_at_first, front, within,
                                    from->goes_on, near);
    }
    *t = LANES_SELECT(met, at, *t);
    return met;
}

#endif
