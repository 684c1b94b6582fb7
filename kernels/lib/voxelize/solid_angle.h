// SPDX-License-Identifier: Apache-2.0
// The part of a point's winding number that comes from the triangles that cap open outlines, in
// float arithmetic.
#ifndef VXL_SOLID_ANGLE_H
#define VXL_SOLID_ANGLE_H

#include "lib/lanes/exact_float.h"
#include "lib/voxelize/lattice.h"

static inline lane_float take_sign(lane_float magnitude, lane_float sign) {
    const lane_int bit = (lane_int)((int)0x80000000u);
    return LANES_AS_FLOAT((LANES_AS_INT(magnitude) & ~bit) | (LANES_AS_INT(sign) & bit));
}

/// The angle of (x, y), with the sign of y even for zero, within 3e-7. Every device gives the same
/// bits.
///
/// The polynomial is that of Moshier's atanf (Cephes), after a rotation by 45 degrees above tan
/// 22.5 degrees.
static inline lane_float lanes_atan2(lane_float y, lane_float x) {
    const lane_float ax = fabs(x), ay = fabs(y);
    const lane_float small = fmin(ax, ay), large = fmax(fmax(ax, ay), (lane_float)(1e-30f));
    const lane_int turned = LANE_MASK(small > 0.41421356f * large);
    const lane_float a = exact_divide(LANES_SELECT(turned, small - large, small),
                                      LANES_SELECT(turned, small + large, large));
    const lane_float s = a * a;
    lane_float p = fma((lane_float)(8.05374449538e-2f), s, (lane_float)(-1.38776856032e-1f));
    p = fma(p, s, (lane_float)(1.99777106478e-1f));
    p = fma(p, s, (lane_float)(-3.33329491539e-1f));
    lane_float angle = fma(p * s, a, a);
    angle = LANES_SELECT(turned, angle + 0.78539816f, angle);
    angle = LANES_SELECT(LANE_MASK(ay > ax), 1.57079633f - angle, angle);
    angle = LANES_SELECT(LANE_MASK(x < 0.0f), 3.14159265f - angle, angle);
    return take_sign(angle, y);
}

/// A triangle relative to the points of one brick: its corners from a common origin.
typedef struct {
    LatticeTriangle lattice;
    long3 area;     // in lattice units
    float3 normal;  // the area in metric space, of any length
} Cap;

/// Prepares a cap; `scale` is each voxel edge in units of the shortest.
static inline Cap make_cap(LatticeTriangle t, float3 scale) {
    Cap c;
    c.lattice = t;
    c.area = area_vector(&t);
    c.normal = convert_float3(c.area) * (1.0f / (LATTICE_VOXEL * (float)LATTICE_VOXEL)) *
               (float3)(scale.y * scale.z, scale.z * scale.x, scale.x * scale.y);
    return c;
}

/// Lattice points, one per lane, from the same origin as the caps.
typedef struct {
    lane_int x, y, z;
} LanePoints;

typedef struct {
    lane_float x, y, z, length;
} LaneVector;

static inline LaneVector vector_to(int3 corner, const LanePoints* p, float3 to_metric) {
    LaneVector v;
    v.x = LANES_FLOAT(corner.x - p->x) * to_metric.x;
    v.y = LANES_FLOAT(corner.y - p->y) * to_metric.y;
    v.z = LANES_FLOAT(corner.z - p->z) * to_metric.z;
    v.length = exact_sqrt(fma(v.x, v.x, fma(v.y, v.y, v.z * v.z)));
    return v;
}

static inline lane_float lane_dot(const LaneVector* a, const LaneVector* b) {
    return fma(a->x, b->x, fma(a->y, b->y, a->z * b->z));
}

/// The side of the cap's plane on which each lane's point lies, exactly: 1 behind it, -1 in front.
/// Points on the plane are moved by (e, e², e³), as for crossings.
static inline lane_float exact_sides(const Cap* cap, const LanePoints* p) {
    lane_float sides;
    for (int i = 0; i < VXL_LANES; ++i) {
        const int3 point =
            (int3)(((const int*)&p->x)[i], ((const int*)&p->y)[i], ((const int*)&p->z)[i]);
        const Wide at = wide_dot(cap->area, cap->lattice.corner[0] - point);
        const long3 n = cap->area;
        const long tie = n.x != 0 ? n.x : n.y != 0 ? n.y : n.z;
        const bool in_front = (at.high | (long)at.low) == 0 ? tie > 0 : at.high < 0;
        ((float*)&sides)[i] = in_front ? -1.0f : 1.0f;
    }
    return sides;
}

// Bounds on rounding, with u = 2^-24. A vector's components are off by 2 u of themselves, the
// normal's by 3 u and the sum of their products by 3 u of its terms: 8 u. Lengths are off by 2.5 u
// beyond that, products of three by 9.5 u, products of a length and a dot product, of which there
// are three, by 6.5 u, and their sums by 10 u. The vectors' own 2 u make 24 u of the four terms:
// below 64 u of the product of lengths.
#define HEIGHT_ROUNDING 5e-7f
#define REACH_ROUNDING 4e-6f
#define ARC_ROUNDING 3e-7f

/// An angle, and a bound on its error that is infinite or NaN where nothing is known.
typedef struct {
    lane_float angle, error;
} HalfAngle;

/// Half the solid angle of the cap seen from each point, positive from behind (van Oosterom and
/// Strackee 1983). The angle jumps across the cap; integers decide the side, so that it agrees with
/// the crossings. Near the cap's edges both legs may vanish, and the angle is unknown.
static inline HalfAngle half_solid_angle(const Cap* cap, const LanePoints* p, float3 to_metric) {
    const LaneVector a = vector_to(cap->lattice.corner[0], p, to_metric);
    const LaneVector b = vector_to(cap->lattice.corner[1], p, to_metric);
    const LaneVector c = vector_to(cap->lattice.corner[2], p, to_metric);
    const float3 n = cap->normal;
    lane_float height = fma((lane_float)(n.x), a.x, fma((lane_float)(n.y), a.y, n.z * a.z));
    const lane_float bound =
        HEIGHT_ROUNDING * (fabs(n.x) * fabs(a.x) + fabs(n.y) * fabs(a.y) + fabs(n.z) * fabs(a.z));
    const lane_float reach = fma(a.length * b.length, c.length,
                                 fma(lane_dot(&a, &b), c.length,
                                     fma(lane_dot(&b, &c), a.length, lane_dot(&c, &a) * b.length)));
    if (lanes_any(LANE_MASK(fabs(height) <= bound) & LANE_MASK(reach <= 0.0f)))
        height = LANES_SELECT(LANE_MASK(fabs(height) <= bound),
                              take_sign(height, exact_sides(cap, p)), height);
    // The rotation that the errors of both legs cause if the legs are as short as they may be. It
    // is doubled for the rounding of this bound.
    const lane_float slack = REACH_ROUNDING * a.length * b.length * c.length;
    const lane_float min_height = fmax(fabs(height) - bound, (lane_float)(0.0f));
    const lane_float min_reach = fmax(fabs(reach) - slack, (lane_float)(0.0f));
    const lane_float turn = (bound * (fabs(reach) + slack) + slack * (fabs(height) + bound)) /
                            fma(min_height, min_height, min_reach * min_reach);
    const HalfAngle seen = {lanes_atan2(height, reach), 2.0f * turn + ARC_ROUNDING};
    return seen;
}

#endif
