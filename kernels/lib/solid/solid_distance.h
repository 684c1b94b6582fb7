// SPDX-License-Identifier: Apache-2.0
// Signed distances to the analytic shapes of shared/solid.h, over lanes, positive outside.
//
// All except the ellipsoid's are closed forms of the exact Euclidean distance. Near the surface,
// each is right within the shape's `rounding`.
#ifndef VXL_SOLID_DISTANCE_H
#define VXL_SOLID_DISTANCE_H

#include "lib/lanes/exact_float.h"
#include "shared/solid.h"

/// The kinds of shapes that may occur, as bits 1 << VXL_SOLID_*. Spheres may always occur.
#ifndef VXL_SOLID_KINDS
#define VXL_SOLID_KINDS 0xFFu
#endif

/// True for a kind that may occur; code for other kinds is left out.
#define VXL_IS_SOLID(kind, other) ((VXL_SOLID_KINDS >> (other)&1u) != 0u && (kind) == (other))

static inline uint solid_kind(global const SolidShape* s) {
    return s->kind & VXL_SOLID_KIND_MASK;
}

/// A point or a direction in a shape's space.
typedef struct {
    lane_float x, y, z;
} SolidPoint;

static inline lane_float solid_length2(lane_float x, lane_float y) {
    return exact_sqrt(fma(x, x, y * y));
}

static inline lane_float solid_length3(lane_float x, lane_float y, lane_float z) {
    return exact_sqrt(fma(x, x, fma(y, y, z * z)));
}

static inline lane_float box_distance(SolidPoint p, float half_x, float half_y, float half_z) {
    const lane_float x = fabs(p.x) - half_x, y = fabs(p.y) - half_y, z = fabs(p.z) - half_z;
    const lane_float inside = fmin(fmax(x, fmax(y, z)), (lane_float)0.0f);
    return inside + solid_length3(fmax(x, 0.0f), fmax(y, 0.0f), fmax(z, 0.0f));
}

static inline lane_float cylinder_distance(SolidPoint p, float radius, float half_height) {
    const lane_float x = solid_length2(p.x, p.z) - radius, y = fabs(p.y) - half_height;
    const lane_float inside = fmin(fmax(x, y), (lane_float)0.0f);
    return inside + solid_length2(fmax(x, 0.0f), fmax(y, 0.0f));
}

/// The distance to a frustum. In the half plane of (distance from the axis, y) it is a quadrangle.
/// Inside, the line of the side or a cap is closest; outside, the segment of the side or of a cap.
static inline lane_float cone_distance(SolidPoint p, global const SolidShape* s) {
    const float bottom = s->size[0], half_height = s->size[1], top = s->size[2];
    const lane_float across = solid_length2(p.x, p.z);
    const lane_float x = across - bottom, y = p.y + half_height;  // from the bottom's rim
    const lane_float side = fma(x, (lane_float)s->derived[0], y * s->derived[1]);
    const lane_float cap = fabs(p.y) - half_height;
    const float edge_x = top - bottom, edge_y = 2.0f * half_height;
    const lane_float along = clamp(fma(x, (lane_float)s->derived[2], y * s->derived[3]),
                                   (lane_float)0.0f, (lane_float)1.0f);
    const lane_float to_side =
        solid_length2(fma(-along, (lane_float)edge_x, x), fma(-along, (lane_float)edge_y, y));
    const lane_float cap_radius =
        LANES_SELECT(LANE_MASK(p.y < 0.0f), (lane_float)bottom, (lane_float)top);
    const lane_float to_cap = solid_length2(fmax(across - cap_radius, 0.0f), cap);
    const lane_float inside = fmax(side, cap);
    return LANES_SELECT(LANE_MASK(inside <= 0.0f), inside, fmin(to_side, to_cap));
}

static inline lane_float torus_distance(SolidPoint p, float ring, float tube) {
    return solid_length2(solid_length2(p.x, p.z) - ring, p.y) - tube;
}

static inline lane_float capsule_distance(SolidPoint p, float radius, float half_height) {
    return solid_length3(p.x, fmax(fabs(p.y) - half_height, 0.0f), p.z) - radius;
}

#define VXL_ELLIPSOID_STEPS 8

/// One Newton step from t towards |s(t)| = 1, applied to 1/|s|; `reach` and `curve` are |s|² and Σ
/// s_i²/(t + r_i²).
static inline lane_float ellipsoid_step(lane_float t, lane_float reach, lane_float curve) {
    const lane_float next = t + exact_divide((exact_sqrt(reach) - 1.0f) * reach, curve);
    return LANES_SELECT(LANE_MASK(curve > 0.0f), next, t);
}

/// The closest point of the ellipsoid with half axes r_i is r_i² p_i / (t + r_i²), with t the
/// largest root of |s(t)| = 1, s_i = r_i p_i / (t + r_i²); so the distance is t |p_i / (t + r_i²)|,
/// without cancellation. 1/|s| is concave and nearly linear in t (Hebden 1973): Newton's method
/// rises to the root from below. Both starts are below the root: a step from t = 0, and the t at
/// which one |s_i| alone is 1. Deep inside, the term of the shortest axis is 0/0 on the plane
/// across it, so that term is taken from |s| = 1 instead. Measured errors, in roundings of the
/// longest half axis: 4 within 3 voxels of the surface for axes up to 1:5, 15 elsewhere (163 at the
/// centre); 500 within 3 voxels at 1:300.
static inline lane_float ellipsoid_distance(SolidPoint p, global const SolidShape* s) {
    // in units of the shortest half axis, so that r >= 1 and a = r² >= 1
    const float rx = s->derived[0], ry = s->derived[1], rz = s->derived[2];
    const float ax = rx * rx, ay = ry * ry, az = rz * rz;
    const lane_float px = fabs(p.x) * s->derived[3], py = fabs(p.y) * s->derived[3],
                     pz = fabs(p.z) * s->derived[3];
    lane_float xx = exact_divide(px * px, (lane_float)ax),
               yy = exact_divide(py * py, (lane_float)ay),
               zz = exact_divide(pz * pz, (lane_float)az);
    lane_float t = fmax(
        fmax(fma(px, (lane_float)rx, (lane_float)-ax), fma(py, (lane_float)ry, (lane_float)-ay)),
        fma(pz, (lane_float)rz, (lane_float)-az));
    const lane_float curve = exact_divide(xx, (lane_float)ax) + exact_divide(yy, (lane_float)ay) +
                             exact_divide(zz, (lane_float)az);
    t = fmax(t, ellipsoid_step((lane_float)0.0f, xx + yy + zz, curve));
    const lane_float minimum = (lane_float)0x1p-20f;  // t + r² stays above 0 on the plane of 0/0
    for (int step = 0; step < VXL_ELLIPSOID_STEPS; ++step) {
        const lane_float ix = exact_reciprocal(fmax(t + ax, minimum));
        const lane_float iy = exact_reciprocal(fmax(t + ay, minimum));
        const lane_float iz = exact_reciprocal(fmax(t + az, minimum));
        const lane_float sx = rx * px * ix, sy = ry * py * iy, sz = rz * pz * iz;
        xx = sx * sx, yy = sy * sy, zz = sz * sz;
        t = ellipsoid_step(t, xx + yy + zz, fma(xx, ix, fma(yy, iy, zz * iz)));
    }
    t = fmax(t, -1.0f);
    const lane_float wx = exact_divide(px, fmax(t + ax, minimum));
    const lane_float wy = exact_divide(py, fmax(t + ay, minimum));
    const lane_float wz = exact_divide(pz, fmax(t + az, minimum));
    xx = wx * wx, yy = wy * wy, zz = wz * wz;
    lane_float rest, others;  // w² of the shortest axis from |s| = 1, and of the two others
    if (rx == 1.0f)
        others = yy + zz, rest = 1.0f - (ay * yy + az * zz);
    else if (ry == 1.0f)
        others = xx + zz, rest = 1.0f - (ax * xx + az * zz);
    else
        others = xx + yy, rest = 1.0f - (ax * xx + ay * yy);
    const lane_float squared =
        LANES_SELECT(LANE_MASK(t < -0.5f), others + fmax(rest, 0.0f), xx + yy + zz);
    return t * exact_sqrt(squared) * s->size[3];
}

/// The distance to one shape, in its space.
static inline lane_float shape_distance(global const SolidShape* s, SolidPoint p) {
    const uint kind = solid_kind(s);
    if (VXL_IS_SOLID(kind, VXL_SOLID_ELLIPSOID)) return ellipsoid_distance(p, s);
    if (VXL_IS_SOLID(kind, VXL_SOLID_BOX))
        return box_distance(p, s->size[0], s->size[1], s->size[2]);
    if (VXL_IS_SOLID(kind, VXL_SOLID_CYLINDER)) return cylinder_distance(p, s->size[0], s->size[1]);
    if (VXL_IS_SOLID(kind, VXL_SOLID_CONE)) return cone_distance(p, s);
    if (VXL_IS_SOLID(kind, VXL_SOLID_TORUS)) return torus_distance(p, s->size[0], s->size[1]);
    if (VXL_IS_SOLID(kind, VXL_SOLID_CAPSULE)) return capsule_distance(p, s->size[0], s->size[1]);
    if (VXL_IS_SOLID(kind, VXL_SOLID_SLAB)) return fabs(p.y) - s->size[0];
    return solid_length3(p.x, p.y, p.z) - s->size[0];
}

#endif
