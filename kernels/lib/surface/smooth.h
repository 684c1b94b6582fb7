// SPDX-License-Identifier: Apache-2.0
// The point where a ray meets the surface inside a smooth voxel.
#ifndef VXL_SMOOTH_H
#define VXL_SMOOTH_H

#include "lib/surface/field.h"
#include "lib/traverse/walk.h"

// The number of secant steps after the bracket is found. F is nearly linear over half a cell: each
// step squares the error, and three steps from a bracket of half a voxel reach the rounding of t.
#define VXL_SECANT_STEPS 3

// A bound on the rounding of field_value, in distance units: |F| < 2^15, and about sixteen
// roundings of half a unit in the last place each, 2^-10 (1.2e-7 voxel).
#define VXL_FIELD_ROUNDING 0.015625f

/// A ray inside one voxel: local position s(u) = s0 + d u, where u counts from where the ray
/// entered.
typedef struct {
    lane_float sx, sy, sz, dx, dy, dz;
} LocalRay;

static inline LocalRay local_ray(const Walk* w) {
    LocalRay r;
    r.dx = w->dx, r.dy = w->dy, r.dz = w->dz;
    r.sx = clamp(fma(w->dx, w->t, w->ox - LANES_FLOAT(w->x)), 0.0f, 1.0f);
    r.sy = clamp(fma(w->dy, w->t, w->oy - LANES_FLOAT(w->y)), 0.0f, 1.0f);
    r.sz = clamp(fma(w->dz, w->t, w->oz - LANES_FLOAT(w->z)), 0.0f, 1.0f);
    return r;
}

/// The field along the ray, with the sign that it has on the ray's side: `side` is -1 for rays
/// inside.
static inline lane_float field_along(const Field* f, const LocalRay* r, lane_float side,
                                     lane_float u) {
    return side * field_value(f, clamp(fma(r->dx, u, r->sx), 0.0f, 1.0f),
                              clamp(fma(r->dy, u, r->sy), 0.0f, 1.0f),
                              clamp(fma(r->dz, u, r->sz), 0.0f, 1.0f));
}

/// How a ray comes to a field, as masks.
typedef struct {
    lane_int within;     // it is known to be inside the surface
    lane_int unsure;     // it may be inside without knowing
    lane_int beginning;  // it begins on the surface, in this very voxel
    lane_int here;       // it begins on another surface in this voxel
} FieldApproach;

/// A field as seen by a ray that enters its voxel.
typedef struct {
    lane_float side;     // the factor of the field for this ray
    lane_float value;    // the field's value at the entry, times `side`
    lane_int beginning;  // mask: the ray begins on a surface, and sees the `level` of its origin
} FieldEntry;

/// A bound on the effect of a point's rounding on a field there, in distance units: the point is
/// off by at most `plane_bound` along each axis, and F grows by less than two voxels per voxel.
static inline float rounding_of_origins(float plane_bound) {
    return 6.0f * VXL_DISTANCE_UNITS * plane_bound + VXL_FIELD_ROUNDING;
}

/// Finds how a ray sees fields whose value at the entry is `outside`, as seen from outside.
///
/// For a ray that is unsure of its side, this value decides: outside it isn't negative, except for
/// the rounding of the point. A ray that began on the surface in this very voxel sees the level of
/// its own origin instead: `level` is set so that F + level is not negative there, and stays with
/// the ray.
static inline FieldEntry enter_field(lane_float outside, float plane_bound, lane_int tested,
                                     FieldApproach* from, lane_float* level) {
    from->within |= from->unsure & LANE_MASK(outside < -rounding_of_origins(plane_bound));
    FieldEntry e;
    e.side = LANES_SELECT(from->within, (lane_float)-1.0f, (lane_float)1.0f);
    e.value = e.side * outside;
    // Where surfaces cross at the ray's origin, rounding must not decide on which side the ray is.
    // Otherwise the ray could alternate between them without end.
    e.beginning = from->beginning | (from->here & LANE_MASK(e.value < 0.0f));
    // A ray that has come as far above the field as it began below it has left the field.
    if (VXL_MIXED) {
        const lane_int left = LANE_MASK(e.value >= *level) & tested;
        *level = LANES_SELECT(left, fmin(*level, rounding_of_origins(plane_bound)), *level);
    }
    *level = LANES_SELECT(e.beginning & tested, fmax(-e.value, 0.0f) + VXL_FIELD_ROUNDING, *level);
    return e;
}

/// The first point in u = a .. b at which F + level turns negative, where F is a field times
/// `side`, and F + level is fa >= 0 at a. Sets `at`, and returns the mask of lanes that have such a
/// point.
static inline lane_int first_zero(const Field* f, const LocalRay* ray, lane_float side,
                                  lane_float level, lane_float a, lane_float b, lane_float fa,
                                  lane_int tested, lane_float* at) {
    lane_float fb = field_along(f, ray, side, b) + level;
    const lane_float middle = 0.5f * (a + b);
    const lane_float fm = field_along(f, ray, side, middle) + level;

    // Both ends are outside, but the ray may still dip below the surface. The parabola's lowest
    // point is tested.
    const lane_float bend = fa - 2.0f * fm + fb, slope = fb - fa;
    const lane_int dips = LANE_MASK(fm >= 0.0f) & LANE_MASK(fb >= 0.0f) &
                          LANE_MASK(fabs(slope) < 2.0f * bend) & tested;
    lane_float lowest = middle, f_lowest = fm;
    if (lanes_any(dips)) {
        const lane_float part =
            0.5f - 0.25f * exact_divide(slope, LANES_SELECT(dips, bend, (lane_float)1.0f));
        lowest = LANES_SELECT(dips, fma(part, b - a, a), middle);
        f_lowest = LANES_SELECT(dips, field_along(f, ray, side, lowest) + level, fm);
    }
    const lane_int before = LANE_MASK(f_lowest < 0.0f);
    const lane_int crossed = (before | LANE_MASK(fb < 0.0f)) & tested;
    *at = a;
    if (!lanes_any(crossed)) return crossed;
    a = LANES_SELECT(before, a, lowest), fa = LANES_SELECT(before, fa, f_lowest);
    b = LANES_SELECT(before, lowest, b), fb = LANES_SELECT(before, f_lowest, fb);
    // This is regula falsi on a bracket with F(a) >= 0 > F(b). The value at an end that is kept
    // twice is halved (Illinois), so that both ends close in. Halving it at once would put the
    // estimate as far off on the other side.
    lane_int kept_a = (lane_int)0, kept_b = (lane_int)0;
    for (int step = 0;; ++step) {
        const lane_float gap = LANES_SELECT(crossed, fa - fb, (lane_float)1.0f);
        *at = fma(exact_divide(fa, gap), b - a, a);
        if (step == VXL_SECANT_STEPS) return crossed;
        const lane_float fu = field_along(f, ray, side, *at) + level;
        const lane_int below = LANE_MASK(fu < 0.0f);
        fa = LANES_SELECT(kept_a & below, 0.5f * fa, LANES_SELECT(below, fa, fu));
        fb = LANES_SELECT(kept_b & ~below, 0.5f * fb, LANES_SELECT(below, fu, fb));
        b = LANES_SELECT(below, *at, b);
        a = LANES_SELECT(below, a, *at);
        kept_a = below;
        kept_b = ~below;
    }
}

/// Tests the fields of the voxels that the `tested` lanes are in. Returns the mask of those hit,
/// and their t in `t_hit`.
///
/// A ray comes from outside the surface, or from inside (then F has the opposite sign), and hits
/// where F turns negative. If F is already negative at the entry point, that is the hit, so that no
/// ray slips through between two voxels.
static inline lane_int hit_smooth(const Field* f, const Walk* w, float plane_bound, lane_int tested,
                                  FieldApproach* from, lane_float* level, lane_float* t_hit) {
    const LocalRay ray = local_ray(w);
    const lane_float zero = (lane_float)0.0f, u_exit = fmax(exit_time(w) - w->t, 0.0f);
    const FieldEntry e =
        enter_field(field_along(f, &ray, (lane_float)1.0f, zero), plane_bound, tested, from, level);
    const lane_float fa = e.value + *level;
    const lane_int entered = LANE_MASK(fa < 0.0f) & ~e.beginning & tested;
    lane_float u;
    const lane_int crossed =
        first_zero(f, &ray, e.side, *level, zero, u_exit, fa, tested & ~entered, &u);
    *t_hit = LANES_SELECT(entered | crossed, w->t + LANES_SELECT(crossed, u, zero), *t_hit);
    return entered | crossed;
}

#endif
