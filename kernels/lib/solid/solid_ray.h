// SPDX-License-Identifier: Apache-2.0
// The interval in which a ray is inside a convex analytic shape, from the intervals of its
// surfaces.
//
// A finite cylinder is a tube and a slab, a box is three slabs: the ray is in the shape where it is
// in all of them, so a ray through the edge between side and cap cannot pass between two separate
// tests. Before anything is squared, the ray's origin is moved to its point closest to the shape,
// so that a far origin costs no digits: s counts from there, and the caller adds the distance
// moved.
#ifndef VXL_SOLID_RAY_H
#define VXL_SOLID_RAY_H

#include "lib/solid/solid_distance.h"

/// A ray p + s v in a shape's space.
typedef struct {
    SolidPoint p, v;
} ShapeRay;

/// The ray is inside for s in [enter, leave], and nowhere unless enter < leave.
typedef struct {
    lane_float enter, leave;
} ShapeSpan;

static inline ShapeSpan span(lane_float enter, lane_float leave) {
    const ShapeSpan s = {enter, leave};
    return s;
}

/// A span that is everywhere in the lanes of `mask`, and nowhere in the others.
static inline ShapeSpan span_where(lane_int mask) {
    return span(LANES_SELECT(mask, (lane_float)-INFINITY, (lane_float)INFINITY),
                LANES_SELECT(mask, (lane_float)INFINITY, (lane_float)-INFINITY));
}

static inline ShapeSpan select_span(lane_int mask, ShapeSpan yes, ShapeSpan no) {
    return span(LANES_SELECT(mask, yes.enter, no.enter), LANES_SELECT(mask, yes.leave, no.leave));
}

/// The span inside both.
static inline ShapeSpan common_span(ShapeSpan a, ShapeSpan b) {
    return span(fmax(a.enter, b.enter), fmin(a.leave, b.leave));
}

/// The span from where the ray enters the first of two spans to where it leaves the last. Both lie
/// in one convex shape.
static inline ShapeSpan hull_span(ShapeSpan a, ShapeSpan b) {
    const ShapeSpan both = span(fmin(a.enter, b.enter), fmax(a.leave, b.leave));
    const ShapeSpan some = select_span(LANE_MASK(a.enter < a.leave), a, b);
    return select_span(LANE_MASK(a.enter < a.leave) & LANE_MASK(b.enter < b.leave), both, some);
}

static inline ShapeSpan later_span(ShapeSpan s, lane_float by) {
    return span(s.enter + by, s.leave + by);
}

/// The span between the planes at ±extent along one axis.
static inline ShapeSpan slab_span(lane_float p, lane_float v, float extent) {
    const lane_int moves = LANE_MASK(v != 0.0f);
    const lane_float divisor = LANES_SELECT(moves, v, (lane_float)1.0f);
    const lane_float lower = exact_divide(-extent - p, divisor);
    const lane_float upper = exact_divide(extent - p, divisor);
    return select_span(moves, span(fmin(lower, upper), fmax(lower, upper)),
                       span_where(LANE_MASK(fabs(p) <= extent)));
}

/// Where p + s v is within `radius` of the origin. Except for rounding, p must be the ray's point
/// closest to the origin: p·v is then small, and neither root loses digits.
static inline ShapeSpan ball_span_from_closest(lane_float aa, lane_float pv, lane_float pp,
                                               lane_float radius) {
    const lane_float c = fma(-radius, radius, pp);
    const lane_float discriminant = fma(pv, pv, -aa * c);
    const lane_float root = exact_sqrt(fmax(discriminant, 0.0f));
    return select_span(LANE_MASK(discriminant > 0.0f),
                       span(exact_divide(-pv - root, aa), exact_divide(-pv + root, aa)),
                       span_where((lane_int)0));
}

static inline ShapeSpan ball_span(ShapeRay r, float radius) {
    const lane_float aa = fma(r.v.x, r.v.x, fma(r.v.y, r.v.y, r.v.z * r.v.z));
    const lane_float closest =
        -exact_divide(fma(r.p.x, r.v.x, fma(r.p.y, r.v.y, r.p.z * r.v.z)), aa);
    const lane_float x = fma(closest, r.v.x, r.p.x), y = fma(closest, r.v.y, r.p.y),
                     z = fma(closest, r.v.z, r.p.z);
    return later_span(ball_span_from_closest(aa, fma(x, r.v.x, fma(y, r.v.y, z * r.v.z)),
                                             fma(x, x, fma(y, y, z * z)), (lane_float)radius),
                      closest);
}

/// The part of a ray in the infinite cylinder around the Y axis.
static inline ShapeSpan tube_span(ShapeRay r, float radius) {
    const lane_float aa = fma(r.v.x, r.v.x, r.v.z * r.v.z);
    const lane_int moves = LANE_MASK(aa > 0.0f);
    const lane_float divisor = LANES_SELECT(moves, aa, (lane_float)1.0f);
    const lane_float closest = -exact_divide(fma(r.p.x, r.v.x, r.p.z * r.v.z), divisor);
    const lane_float x = fma(closest, r.v.x, r.p.x), z = fma(closest, r.v.z, r.p.z);
    const ShapeSpan across =
        later_span(ball_span_from_closest(divisor, fma(x, r.v.x, z * r.v.z), fma(x, x, z * z),
                                          (lane_float)radius),
                   closest);
    const lane_float outside = fma(-radius, (lane_float)radius, fma(r.p.x, r.p.x, r.p.z * r.p.z));
    return select_span(moves, across, span_where(LANE_MASK(outside <= 0.0f)));
}

static inline ShapeSpan ellipsoid_span(ShapeRay r, global const SolidShape* s) {
    ShapeRay unit;  // the space in which the ellipsoid is the unit ball
    unit.p.x = exact_divide(r.p.x, (lane_float)s->size[0]);
    unit.p.y = exact_divide(r.p.y, (lane_float)s->size[1]);
    unit.p.z = exact_divide(r.p.z, (lane_float)s->size[2]);
    unit.v.x = exact_divide(r.v.x, (lane_float)s->size[0]);
    unit.v.y = exact_divide(r.v.y, (lane_float)s->size[1]);
    unit.v.z = exact_divide(r.v.z, (lane_float)s->size[2]);
    return ball_span(unit, 1.0f);
}

static inline ShapeSpan box_span(ShapeRay r, global const SolidShape* s) {
    const ShapeSpan x = slab_span(r.p.x, r.v.x, s->size[0]);
    const ShapeSpan xy = common_span(x, slab_span(r.p.y, r.v.y, s->size[1]));
    return common_span(xy, slab_span(r.p.z, r.v.z, s->size[2]));
}

static inline ShapeSpan cylinder_span(ShapeRay r, float radius, float half_height) {
    return common_span(tube_span(r, radius), slab_span(r.p.y, r.v.y, half_height));
}

static inline ShapeSpan capsule_span(ShapeRay r, float radius, float half_height) {
    ShapeRay lower = r, upper = r;
    lower.p.y += half_height;
    upper.p.y -= half_height;
    const ShapeSpan middle = cylinder_span(r, radius, half_height);
    return hull_span(hull_span(middle, ball_span(lower, radius)), ball_span(upper, radius));
}

/// The double cone x² + z² <= radius(y)², radius(y) = mean + growth * y, along the ray from a point
/// of it: a s² + 2 b s + c <= 0. If the ray is steeper than the side (a < 0), it is in one half of
/// the double cone before the lower root and in the other half after the upper root; the half that
/// belongs to the shape is the one that widens along the ray.
static inline ShapeSpan double_cone_span(ShapeRay r, float mean, float growth) {
    const lane_float radius = fma((lane_float)growth, r.p.y, (lane_float)mean);
    const lane_float widening = growth * r.v.y;
    const lane_float across = solid_length2(r.p.x, r.p.z);
    const lane_float a = fma(r.v.x, r.v.x, fma(r.v.z, r.v.z, -widening * widening));
    const lane_float b = fma(r.p.x, r.v.x, fma(r.p.z, r.v.z, -radius * widening));
    const lane_float c = (across - radius) * (across + radius);
    const lane_float ac = a * c;
    const lane_float discriminant = fma(b, b, -ac) - fma(a, c, -ac);
    const lane_float root = exact_sqrt(fmax(discriminant, 0.0f));
    const lane_float q = -(b + copysign(root, b));
    const lane_int has_a = LANE_MASK(a != 0.0f), has_q = LANE_MASK(q != 0.0f);
    const lane_float first = exact_divide(q, LANES_SELECT(has_a, a, (lane_float)1.0f));
    const lane_float second = LANES_SELECT(
        has_q, exact_divide(c, LANES_SELECT(has_q, q, (lane_float)1.0f)), (lane_float)0.0f);
    const lane_float low = fmin(first, second), high = fmax(first, second);
    const lane_float far = (lane_float)INFINITY;
    const lane_int opens = LANE_MASK(widening > 0.0f);
    const ShapeSpan closed =
        select_span(LANE_MASK(discriminant > 0.0f), span(low, high), span_where((lane_int)0));
    const ShapeSpan open = select_span(opens, span(high, far), span(-far, low));
    const ShapeSpan linear =
        select_span(LANE_MASK(b < 0.0f), span(second, far), span(-far, second));
    const ShapeSpan parallel =
        select_span(LANE_MASK(b != 0.0f), linear, span_where(LANE_MASK(c <= 0.0f)));
    return select_span(LANE_MASK(a > 0.0f), closed, select_span(has_a, open, parallel));
}

/// The span in a frustum: in its double cone and its slab. The cone's equation is set up at the
/// point of the ray in the slab that is closest to the axis, where squares are no larger than the
/// solid.
static inline ShapeSpan cone_span(ShapeRay r, global const SolidShape* s) {
    const float half_height = s->size[1];
    const ShapeSpan caps = slab_span(r.p.y, r.v.y, half_height);
    const lane_float aa = fma(r.v.x, r.v.x, r.v.z * r.v.z);
    const lane_int moves = LANE_MASK(aa > 0.0f) & LANE_MASK(caps.enter < caps.leave);
    lane_float from =
        -exact_divide(fma(r.p.x, r.v.x, r.p.z * r.v.z), LANES_SELECT(moves, aa, (lane_float)1.0f));
    from = fmin(fmax(from, caps.enter), caps.leave);
    from = LANES_SELECT(moves, from, (lane_float)0.0f);
    ShapeRay moved = r;
    moved.p.x = fma(from, r.v.x, r.p.x);
    moved.p.y = fma(from, r.v.y, r.p.y);
    moved.p.z = fma(from, r.v.z, r.p.z);
    const float mean = 0.5f * (s->size[0] + s->size[2]);
    const ShapeSpan side = double_cone_span(moved, mean, s->derived[4]);
    return common_span(later_span(side, from), caps);
}

#endif
