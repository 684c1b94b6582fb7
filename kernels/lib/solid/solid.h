// SPDX-License-Identifier: Apache-2.0
// The signed distance to an analytic solid (shared/solid.h) at points of its grid, over lanes.
#ifndef VXL_SOLID_H
#define VXL_SOLID_H

#include "lib/solid/solid_distance.h"

/// A point of the grid, in voxels: cell + offset, exact on the lattice and precise near it.
typedef struct {
    lane_int x, y, z;
    lane_float offset_x, offset_y, offset_z;
} LatticePoint;

typedef struct {
    lane_float distance;  // positive outside, in shortest voxel edges
    lane_float rounding;  // bound on its error
} SolidDistance;

static inline SolidPoint to_shape(global const float* m, lane_float x, lane_float y, lane_float z) {
    SolidPoint p;
    p.x = fma((lane_float)m[0], x, fma((lane_float)m[1], y, m[2] * z));
    p.y = fma((lane_float)m[3], x, fma((lane_float)m[4], y, m[5] * z));
    p.z = fma((lane_float)m[6], x, fma((lane_float)m[7], y, m[8] * z));
    return p;
}

static inline SolidDistance shape_distance_at(global const SolidShape* s, LatticePoint at) {
    const lane_float x = LANES_FLOAT(at.x - s->cell[0]) + (at.offset_x - s->fraction[0]);
    const lane_float y = LANES_FLOAT(at.y - s->cell[1]) + (at.offset_y - s->fraction[1]);
    const lane_float z = LANES_FLOAT(at.z - s->cell[2]) + (at.offset_z - s->fraction[2]);
    const lane_float distance = shape_distance(s, to_shape(s->shape_from_grid, x, y, z));
    SolidDistance d;
    d.distance = (s->kind & VXL_SOLID_COMPLEMENT) ? -distance : distance;
    d.rounding =
        fma((lane_float)s->rounding[0], fabs(x) + fabs(y) + fabs(z), (lane_float)s->rounding[1]);
    return d;
}

/// The distance to the solid that starts at record `number`. It never exceeds the true distance to
/// a combination's surface, and it is exactly 0 on the surface.
static inline SolidDistance solid_distance(global const SolidShape* solids, uint number,
                                           LatticePoint at) {
    lane_float stack[VXL_SOLID_STACK];
    int depth = 0;
    const uint count = solids[number].shape_count;
    SolidDistance top = shape_distance_at(solids + number, at);
    for (uint i = 1; i < count; ++i) {
        stack[depth++] = top.distance;
        const SolidDistance shape = shape_distance_at(solids + number + i, at);
        top.distance = shape.distance;
        top.rounding = fmax(top.rounding, shape.rounding);
        for (uint left = solids[number + i].operations; left != 0u;
             left >>= VXL_SOLID_OPERATION_BITS) {
            const lane_float below = stack[--depth];
            top.distance = (left & VXL_SOLID_OPERATION_MASK) == VXL_SOLID_UNION
                               ? fmin(below, top.distance)
                               : fmax(below, top.distance);
        }
    }
    return top;
}

#endif
