// SPDX-License-Identifier: Apache-2.0
// Where a ray is inside a torus: up to two intervals.
//
// Along the ray the torus is a quartic, which is monotone between its extrema. These are the roots
// of a cubic, which is monotone between its own extrema. So every root is found in a bracket, and
// none is lost to cancellation in a closed form. The quartic only says where to split: signs and
// roots are those of the distance itself, whose value near its zero is right to a rounding of the
// torus' size.
#ifndef VXL_SOLID_TORUS_H
#define VXL_SOLID_TORUS_H

#include "lib/solid/solid_ray.h"

#define VXL_TORUS_STEPS \
    40  // Newton ends after 4 to 8 steps unless roots nearly meet; halving takes 30

typedef struct {
    ShapeSpan first, second;
} TorusSpans;

typedef struct {
    lane_float value, slope;
} TorusValue;

static inline TorusValue torus_value(ShapeRay r, float ring, float tube, lane_float s) {
    const lane_float x = fma(s, r.v.x, r.p.x), y = fma(s, r.v.y, r.p.y), z = fma(s, r.v.z, r.p.z);
    const lane_float across = solid_length2(x, z);
    const lane_float from_ring = across - ring;
    const lane_float from_core = solid_length2(from_ring, y);
    const lane_float outwards = exact_divide(fma(x, r.v.x, z * r.v.z), fmax(across, FLT_MIN));
    TorusValue f;
    f.value = from_core - tube;
    f.slope = exact_divide(fma(from_ring, outwards, y * r.v.y), fmax(from_core, FLT_MIN));
    return f;
}

/// The root of s³ + e s + g in [low, high], where the cubic is monotone; an end if there is no
/// root.
static inline lane_float cubic_root(lane_float e, lane_float g, lane_float low, lane_float high) {
    const lane_int falls =
        LANE_MASK(fma(fma(low, low, e), low, g) > fma(fma(high, high, e), high, g));
    lane_float s = 0.5f * (low + high);
    for (int step = 0; step < 12; ++step) {  // only splits an interval, so a few digits are enough
        const lane_float value = fma(fma(s, s, e), s, g);
        const lane_int goes_up = LANE_MASK(value < 0.0f) ^ falls;
        low = LANES_SELECT(goes_up, s, low);
        high = LANES_SELECT(goes_up, high, s);
        const lane_float slope = fma(3.0f * s, s, e);
        const lane_int has_slope = LANE_MASK(slope != 0.0f);
        const lane_float newton =
            s - exact_divide(value, LANES_SELECT(has_slope, slope, (lane_float)1.0f));
        const lane_int is_inside = LANE_MASK(newton > low) & LANE_MASK(newton < high) & has_slope;
        s = LANES_SELECT(is_inside, newton, 0.5f * (low + high));
    }
    return s;
}

/// The crossing of the surface in [low, high], for the `searched` lanes, by Newton's method. The
/// bracket is halved where a step leaves it or is more than half of the step before. Lanes stop one
/// by one, so that a lane's result does not depend on its neighbours.
static inline lane_float torus_root(ShapeRay r, float ring, float tube, lane_float low,
                                    lane_float high, lane_int falls, lane_int searched) {
    lane_float s = 0.5f * (low + high), last = high - low;
    for (int step = 0; step < VXL_TORUS_STEPS && lanes_any(searched); ++step) {
        const TorusValue f = torus_value(r, ring, tube, s);
        const lane_int goes_up = LANE_MASK(f.value > 0.0f) ^ ~falls;
        low = LANES_SELECT(goes_up & searched, s, low);
        high = LANES_SELECT(~goes_up & searched, s, high);
        const lane_int has_slope = LANE_MASK(f.slope != 0.0f);
        const lane_float move =
            -exact_divide(f.value, LANES_SELECT(has_slope, f.slope, (lane_float)1.0f));
        const lane_float newton = s + move;
        const lane_int is_good = has_slope & LANE_MASK(newton >= low) & LANE_MASK(newton <= high) &
                                 LANE_MASK(fabs(move) <= 0.5f * last);
        const lane_float next = LANES_SELECT(is_good, newton, 0.5f * (low + high));
        last = LANES_SELECT(searched, fabs(next - s), last);
        const lane_int stays = LANE_MASK(next == s);
        s = LANES_SELECT(searched, next, s);
        searched &= ~stays;
    }
    return s;
}

static inline TorusSpans torus_spans(ShapeRay ray, float ring, float tube) {
    TorusSpans found;
    found.first = found.second = span_where((lane_int)0);
    // The ray gets unit speed, and s counts from its point closest to the centre.
    const lane_float speed = solid_length3(ray.v.x, ray.v.y, ray.v.z);
    ShapeRay r;
    r.v.x = exact_divide(ray.v.x, speed);
    r.v.y = exact_divide(ray.v.y, speed);
    r.v.z = exact_divide(ray.v.z, speed);
    const lane_float closest = -fma(ray.p.x, r.v.x, fma(ray.p.y, r.v.y, ray.p.z * r.v.z));
    r.p.x = fma(closest, r.v.x, ray.p.x);
    r.p.y = fma(closest, r.v.y, ray.p.y);
    r.p.z = fma(closest, r.v.z, ray.p.z);
    const ShapeSpan around = cylinder_span(r, ring + tube, tube);
    lane_int searched = LANE_MASK(around.enter < around.leave);
    if (!lanes_any(searched)) return found;
    const lane_float low = LANES_SELECT(searched, around.enter, (lane_float)0.0f);
    const lane_float high = LANES_SELECT(searched, around.leave, (lane_float)0.0f);

    // A quarter of the quartic's slope is s³ + e s + g, since p·v = 0. Its extrema are at ±turn.
    const lane_float pp = fma(r.p.x, r.p.x, fma(r.p.y, r.p.y, r.p.z * r.p.z));
    const lane_float vv = fma(r.v.x, r.v.x, r.v.z * r.v.z);
    const float ring_squared = ring * ring;
    const lane_float e = pp + (ring_squared - tube * tube) - 2.0f * ring_squared * vv;
    const lane_float g = -2.0f * ring_squared * fma(r.p.x, r.v.x, r.p.z * r.v.z);
    const lane_float turn = exact_sqrt(fmax(e * (-1.0f / 3.0f), 0.0f));
    const lane_float turn_low = fmin(fmax(-turn, low), high),
                     turn_high = fmin(fmax(turn, low), high);
    lane_float ends[5];
    ends[0] = low;
    ends[1] = cubic_root(e, g, low, turn_low);
    ends[2] = cubic_root(e, g, turn_low, turn_high);
    ends[3] = cubic_root(e, g, turn_high, high);
    ends[4] = high;

    // The ray is outside at both ends of the box around the torus; each change of side is a
    // crossing.
    lane_int inside = (lane_int)0, count = (lane_int)0;
    for (int part = 0; part < 4; ++part) {
        lane_int next = (lane_int)0;
        if (part < 3) next = LANE_MASK(torus_value(r, ring, tube, ends[part + 1]).value < 0.0f);
        const lane_int changes = searched & (inside ^ next);
        if (lanes_any(changes)) {
            const lane_float s = exact_divide(
                closest + torus_root(r, ring, tube, ends[part], ends[part + 1], next, changes),
                speed);
            found.first.enter = LANES_SELECT(changes & LANE_MASK(count == 0), s, found.first.enter);
            found.first.leave = LANES_SELECT(changes & LANE_MASK(count == 1), s, found.first.leave);
            found.second.enter =
                LANES_SELECT(changes & LANE_MASK(count == 2), s, found.second.enter);
            found.second.leave =
                LANES_SELECT(changes & LANE_MASK(count == 3), s, found.second.leave);
            count -= changes;
        }
        inside = next;
    }
    return found;
}

#endif
