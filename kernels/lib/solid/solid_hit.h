// SPDX-License-Identifier: Apache-2.0
// Where a ray meets the surface of an analytic solid, over lanes; rays are as in shared/trace.h.
//
// Every shape gives the intervals of t in which the ray is inside it. The operations are evaluated
// just before and just after each end of an interval, in order of t: an end belongs to the surface
// if the result changes there. Coordinates never decide on which side of its own surface a point
// is, and ends at equal t change at once, so solids that share a face have no seam.
//
// A ray is known to travel inside or outside the solid, and meets the surface only where that
// changes. Thus the end that a ray starts from is never met again, wherever rounding puts it: the
// origin needs no offset.
#ifndef VXL_SOLID_HIT_H
#define VXL_SOLID_HIT_H

#include "lib/solid/solid.h"
#include "lib/solid/solid_torus.h"

/// o + t d, in voxels of the grid.
typedef struct {
    lane_float ox, oy, oz, dx, dy, dz;
} SolidRay;

/// A ray in a shape's space; t = from + s.
typedef struct {
    ShapeRay ray;
    lane_float from;
} ShapePath;

/// The ray in the shape's space, starting at its point closest to the shape's centre.
static inline ShapePath shape_path(global const SolidShape* s, const SolidRay* ray) {
    const lane_float x = (ray->ox - (float)s->cell[0]) - s->fraction[0];
    const lane_float y = (ray->oy - (float)s->cell[1]) - s->fraction[1];
    const lane_float z = (ray->oz - (float)s->cell[2]) - s->fraction[2];
    ShapePath path;
    path.from = -exact_divide(fma(x, ray->dx, fma(y, ray->dy, z * ray->dz)),
                              fma(ray->dx, ray->dx, fma(ray->dy, ray->dy, ray->dz * ray->dz)));
    path.ray.p = to_shape(s->shape_from_grid, fma(path.from, ray->dx, x),
                          fma(path.from, ray->dy, y), fma(path.from, ray->dz, z));
    path.ray.v = to_shape(s->shape_from_grid, ray->dx, ray->dy, ray->dz);
    return path;
}

/// The intervals of t in which the ray is inside the shape; complements are ignored.
static inline TorusSpans shape_spans(global const SolidShape* s, const ShapePath* path) {
    const ShapeRay r = path->ray;
    TorusSpans spans;
    spans.second = span_where((lane_int)0);
    const uint kind = solid_kind(s);
    if (VXL_IS_SOLID(kind, VXL_SOLID_ELLIPSOID))
        spans.first = ellipsoid_span(r, s);
    else if (VXL_IS_SOLID(kind, VXL_SOLID_BOX))
        spans.first = box_span(r, s);
    else if (VXL_IS_SOLID(kind, VXL_SOLID_CYLINDER))
        spans.first = cylinder_span(r, s->size[0], s->size[1]);
    else if (VXL_IS_SOLID(kind, VXL_SOLID_CONE))
        spans.first = cone_span(r, s);
    else if (VXL_IS_SOLID(kind, VXL_SOLID_TORUS))
        spans = torus_spans(r, s->size[0], s->size[1]);
    else if (VXL_IS_SOLID(kind, VXL_SOLID_CAPSULE))
        spans.first = capsule_span(r, s->size[0], s->size[1]);
    else if (VXL_IS_SOLID(kind, VXL_SOLID_SLAB))
        spans.first = slab_span(r.p.y, r.v.y, s->size[0]);
    else
        spans.first = ball_span(r, s->size[0]);
    spans.first = later_span(spans.first, path->from);
    spans.second = later_span(spans.second, path->from);
    return spans;
}

/// What happens as the ray passes t.
typedef struct {
    lane_int before, after;  // masks: inside the solid just before t, just after it
    lane_float next;         // the first end behind t; infinity if there is none
} SolidEvent;

static inline void add_end(SolidEvent* e, lane_float t, lane_float end) {
    e->next = LANES_SELECT(LANE_MASK(end > t) & LANE_MASK(end < e->next), end, e->next);
}

static inline void add_span(SolidEvent* e, lane_float t, ShapeSpan s) {
    const lane_int is_some = LANE_MASK(s.enter < s.leave);
    e->before |= is_some & LANE_MASK(s.enter < t) & LANE_MASK(t <= s.leave);
    e->after |= is_some & LANE_MASK(s.enter <= t) & LANE_MASK(t < s.leave);
    add_end(e, t, LANES_SELECT(is_some, s.enter, (lane_float)INFINITY));
    add_end(e, t, LANES_SELECT(is_some, s.leave, (lane_float)INFINITY));
}

/// Combines the two values on top of a stack of bits. The lowest bit of each lane is the top.
static inline lane_int combine_top(lane_int stack, uint operation) {
    const lane_int top = stack & 1, below = stack >> 1;
    return operation == VXL_SOLID_UNION ? below | top : below & (top | ~1);
}

static INLINED SolidEvent event_at(global const SolidShape* solids, uint number,
                                   const SolidRay* ray, lane_float t) {
    const uint count = solids[number].shape_count;
    lane_int before = (lane_int)0, after = (lane_int)0;
    SolidEvent event;
    event.next = (lane_float)INFINITY;
    for (uint i = number; i < number + count; ++i) {
        global const SolidShape* s = solids + i;
        const ShapePath path = shape_path(s, ray);
        const TorusSpans spans = shape_spans(s, &path);
        event.before = event.after = (lane_int)0;
        add_span(&event, t, spans.first);
        if ((s->kind & VXL_SOLID_KIND_MASK) == VXL_SOLID_TORUS) add_span(&event, t, spans.second);
        const int flip = (s->kind & VXL_SOLID_COMPLEMENT) ? 1 : 0;
        before = before << 1 | ((event.before & 1) ^ flip);
        after = after << 1 | ((event.after & 1) ^ flip);
        for (uint left = s->operations; left != 0u; left >>= VXL_SOLID_OPERATION_BITS) {
            before = combine_top(before, left & VXL_SOLID_OPERATION_MASK);
            after = combine_top(after, left & VXL_SOLID_OPERATION_MASK);
        }
    }
    event.before = -(before & 1);
    event.after = -(after & 1);
    return event;
}

/// For a solid of one shape: examines its ends in order, without events.
static INLINED lane_float first_end_of_shape(global const SolidShape* s, const SolidRay* ray,
                                             lane_float t_first, lane_float t_clear, lane_int known,
                                             lane_int inside) {
    const ShapePath path = shape_path(s, ray);
    const TorusSpans spans = shape_spans(s, &path);
    const lane_float a0 = spans.first.enter, a1 = spans.first.leave;
    const lane_float b0 = spans.second.enter, b1 = spans.second.leave;
    const lane_int in_a = LANE_MASK(a0 <= t_first) & LANE_MASK(a1 > t_clear);
    const lane_int in_b = LANE_MASK(b0 <= t_first) & LANE_MASK(b1 > t_clear);
    const lane_int flip = (lane_int)((s->kind & VXL_SOLID_COMPLEMENT) ? -1 : 0);
    const lane_int in_shape = LANES_SELECT(known, inside ^ flip, in_a | in_b);
    const lane_float a = LANES_SELECT(in_shape, a1, a0), b = LANES_SELECT(in_shape, b1, b0);
    const lane_float far = (lane_float)INFINITY;
    return fmin(LANES_SELECT(LANE_MASK(a0 < a1) & LANE_MASK(a > t_first), a, far),
                LANES_SELECT(LANE_MASK(b0 < b1) & LANE_MASK(b > t_first), b, far));
}

/// The smallest t > t_first at which the ray crosses the solid's surface; infinity if there is
/// none, and in lanes that are not `tested`.
///
/// In the lanes of `known`, the ray is known to travel `inside` (mask) the solid or outside it from
/// t_first on, see goes_inside; in the others, the point at t_first itself decides. However, a ray
/// that would leave the solid by t_clear, which is t_first or later, began on the surface there and
/// not inside.
static INLINED lane_float solid_crossing(global const SolidShape* solids, uint number,
                                         const SolidRay* ray, lane_float t_first,
                                         lane_float t_clear, lane_int known, lane_int inside,
                                         lane_int tested) {
    const lane_float far = (lane_float)INFINITY;
    if (solids[number].shape_count == 1u)
        return LANES_SELECT(
            tested, first_end_of_shape(solids + number, ray, t_first, t_clear, known, inside), far);
    SolidEvent event = event_at(solids, number, ray, t_first);
    inside = LANES_SELECT(known, inside, event.after);
    lane_float t = LANES_SELECT(tested, event.next, far);
    lane_int searched = tested & LANE_MASK(t < far);
    while (lanes_any(searched)) {
        event = event_at(solids, number, ray, t);
        lane_int found = ~(event.before ^ inside) & (event.after ^ inside);
        const lane_int passed = found & inside & ~known & LANE_MASK(t <= t_clear);
        inside &= ~passed;
        found &= ~passed;
        t = LANES_SELECT(searched & ~found, event.next, t);
        searched &= ~found & LANE_MASK(t < far);
    }
    return t;
}

#endif
