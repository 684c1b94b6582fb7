// SPDX-License-Identifier: Apache-2.0
// The surface of analytic solids for the tracer: closest hits and normals for packets whose lanes
// may test different solids.
#ifndef VXL_SOLID_SURFACE_H
#define VXL_SOLID_SURFACE_H

#include "lib/solid/solid_hit.h"

/// The outward gradient of a shape's distance at p, near its surface; it is not of unit length.
static inline SolidPoint shape_gradient(global const SolidShape* s, SolidPoint p) {
    SolidPoint n = p;
    const lane_float none = (lane_float)0.0f, up = copysign((lane_float)1.0f, p.y);
    const uint kind = solid_kind(s);
    if (VXL_IS_SOLID(kind, VXL_SOLID_ELLIPSOID)) {
        n.x = exact_divide(p.x, (lane_float)(s->size[0] * s->size[0]));
        n.y = exact_divide(p.y, (lane_float)(s->size[1] * s->size[1]));
        n.z = exact_divide(p.z, (lane_float)(s->size[2] * s->size[2]));
    } else if (VXL_IS_SOLID(kind, VXL_SOLID_BOX)) {
        const lane_float x = fabs(p.x) - s->size[0], y = fabs(p.y) - s->size[1],
                         z = fabs(p.z) - s->size[2];
        const lane_int is_x = LANE_MASK(x >= y) & LANE_MASK(x >= z);
        const lane_int is_y = ~is_x & LANE_MASK(y >= z);
        n.x = LANES_SELECT(is_x, copysign((lane_float)1.0f, p.x), none);
        n.y = LANES_SELECT(is_y, up, none);
        n.z = LANES_SELECT(is_x | is_y, none, copysign((lane_float)1.0f, p.z));
    } else if (VXL_IS_SOLID(kind, VXL_SOLID_CYLINDER) || VXL_IS_SOLID(kind, VXL_SOLID_CONE)) {
        const float slope_x = kind == VXL_SOLID_CONE ? s->derived[0] : 1.0f;
        const float slope_y = kind == VXL_SOLID_CONE ? s->derived[1] : 0.0f;
        const lane_float across = solid_length2(p.x, p.z);
        const lane_float side =
            fma(across - s->size[0], (lane_float)slope_x, (p.y + s->size[1]) * slope_y);
        const lane_int is_cap = LANE_MASK(fabs(p.y) - s->size[1] > side);
        n.x = LANES_SELECT(is_cap, none, p.x * slope_x);
        n.y = LANES_SELECT(is_cap, up, across * slope_y);
        n.z = LANES_SELECT(is_cap, none, p.z * slope_x);
    } else if (VXL_IS_SOLID(kind, VXL_SOLID_TORUS)) {
        const lane_float across = fmax(solid_length2(p.x, p.z), FLT_MIN);
        const lane_float share = exact_divide(across - s->size[0], across);
        n.x = p.x * share;
        n.z = p.z * share;
    } else if (VXL_IS_SOLID(kind, VXL_SOLID_CAPSULE)) {
        n.y = p.y - clamp(p.y, -s->size[1], s->size[1]);
    } else if (VXL_IS_SOLID(kind, VXL_SOLID_SLAB)) {
        n.x = none, n.y = up, n.z = none;
    }
    return n;
}

/// A shape's or a solid's distance with its gradient along the grid's axes, in voxels.
typedef struct {
    lane_float distance;
    SolidPoint gradient;
} SolidSlope;

static inline SolidSlope shape_slope(global const SolidShape* s, const SolidRay* ray,
                                     lane_float t) {
    const ShapePath path = shape_path(s, ray);
    const lane_float along = t - path.from;
    SolidPoint p;
    p.x = fma(along, path.ray.v.x, path.ray.p.x);
    p.y = fma(along, path.ray.v.y, path.ray.p.y);
    p.z = fma(along, path.ray.v.z, path.ray.p.z);
    const SolidPoint n = shape_gradient(s, p);
    global const float* m = s->shape_from_grid;
    const float outwards = (s->kind & VXL_SOLID_COMPLEMENT) ? -1.0f : 1.0f;
    SolidSlope slope;
    slope.distance = outwards * shape_distance(s, p);
    slope.gradient.x =
        outwards * fma((lane_float)m[0], n.x, fma((lane_float)m[3], n.y, m[6] * n.z));
    slope.gradient.y =
        outwards * fma((lane_float)m[1], n.x, fma((lane_float)m[4], n.y, m[7] * n.z));
    slope.gradient.z =
        outwards * fma((lane_float)m[2], n.x, fma((lane_float)m[5], n.y, m[8] * n.z));
    return slope;
}

/// The outward normal of the solid's surface where the ray meets it at `t`: the gradient along the
/// grid's axes in voxels, not of unit length; each component divided by the voxel's edge there
/// gives the normal in metres. On an edge it is the normal of one of the faces that meet there.
static inline SolidPoint solid_normal(global const SolidShape* solids, uint number,
                                      const SolidRay* ray, lane_float t) {
    SolidSlope top = shape_slope(solids + number, ray, t), stack[VXL_SOLID_STACK];
    int depth = 0;
    const uint count = solids[number].shape_count;
    for (uint i = number + 1; i < number + count; ++i) {
        stack[depth++] = top;
        top = shape_slope(solids + i, ray, t);
        for (uint left = solids[i].operations; left != 0u; left >>= VXL_SOLID_OPERATION_BITS) {
            const SolidSlope below = stack[--depth];
            const int is_union = (left & VXL_SOLID_OPERATION_MASK) == VXL_SOLID_UNION;
            const lane_int takes = is_union ? LANE_MASK(below.distance <= top.distance)
                                            : LANE_MASK(below.distance >= top.distance);
            top.distance = LANES_SELECT(takes, below.distance, top.distance);
            top.gradient.x = LANES_SELECT(takes, below.gradient.x, top.gradient.x);
            top.gradient.y = LANES_SELECT(takes, below.gradient.y, top.gradient.y);
            top.gradient.z = LANES_SELECT(takes, below.gradient.z, top.gradient.z);
        }
    }
    return top.gradient;
}

/// Mask: a ray that starts on the solid's surface enters it.
static inline lane_int goes_inside(global const SolidShape* solids, uint number,
                                   const SolidRay* ray) {
    const SolidPoint n = solid_normal(solids, number, ray, (lane_float)0.0f);
    return LANE_MASK(fma(n.x, ray->dx, fma(n.y, ray->dy, n.z * ray->dz)) < 0.0f);
}

/// Tests the solid `number` of each lane in `tested` (an entry of `primitives` without
/// kSolidPrimitive); hits closer than *t, beyond t_first, replace it. Returns the mask of those
/// lanes.
///
/// The hit is the first of the whole ray, wherever the voxel that lists the solid lies. `known` and
/// `inside` describe rays that are known to travel inside or outside the solid from t_first on;
/// these don't meet a surface point at t_first again. See solid_crossing for t_clear.
static INLINED lane_int hit_solids(global const SolidShape* solids, lane_uint number,
                                   const SolidRay* ray, lane_float t_first, lane_float t_clear,
                                   lane_int known, lane_int inside, lane_int tested,
                                   lane_float* t) {
    lane_int closer = (lane_int)0, left = tested;
    while (lanes_any(left)) {
        const uint one = lanes_min(LANES_SELECT(left, number, (lane_uint)0xFFFFFFFFu));
        const lane_int same = left & LANE_MASK(number == one);
        left &= ~same;
        const lane_float at =
            solid_crossing(solids, one, ray, t_first, t_clear, known, inside, same);
        const lane_int nearer = same & LANE_MASK(at < *t);
        *t = LANES_SELECT(nearer, at, *t);
        closer |= nearer;
    }
    return closer;
}

/// goes_inside for the solid of each lane in `asked`; 0 in other lanes.
static inline lane_int go_inside(global const SolidShape* solids, lane_uint number,
                                 const SolidRay* ray, lane_int asked) {
    lane_int inside = (lane_int)0, left = asked;
    while (lanes_any(left)) {
        const uint one = lanes_min(LANES_SELECT(left, number, (lane_uint)0xFFFFFFFFu));
        const lane_int same = left & LANE_MASK(number == one);
        left &= ~same;
        inside |= same & goes_inside(solids, one, ray);
    }
    return inside;
}

/// solid_normal for the solid of each lane in `wanted`; 0 in other lanes.
static inline SolidPoint solid_normals(global const SolidShape* solids, lane_uint number,
                                       const SolidRay* ray, lane_float t, lane_int wanted) {
    SolidPoint normal = {(lane_float)0.0f, (lane_float)0.0f, (lane_float)0.0f};
    lane_int left = wanted;
    while (lanes_any(left)) {
        const uint one = lanes_min(LANES_SELECT(left, number, (lane_uint)0xFFFFFFFFu));
        const lane_int same = left & LANE_MASK(number == one);
        left &= ~same;
        const SolidPoint n = solid_normal(solids, one, ray, t);
        normal.x = LANES_SELECT(same, n.x, normal.x);
        normal.y = LANES_SELECT(same, n.y, normal.y);
        normal.z = LANES_SELECT(same, n.z, normal.z);
    }
    return normal;
}

#endif
