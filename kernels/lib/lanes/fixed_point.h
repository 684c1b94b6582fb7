// SPDX-License-Identifier: Apache-2.0
// Functions that snap rays to the fixed point in which the walk is exact (shared/trace.h).
#ifndef VXL_FIXED_POINT_H
#define VXL_FIXED_POINT_H

#include "lib/lanes/vector.h"
#include "shared/trace.h"

/// The power of two that brings the largest of |x|, |y|, |z| into [1/2, 1). At least one of them
/// must be normal.
static inline lane_float power_of_two_scale(lane_float x, lane_float y, lane_float z) {
    const lane_float largest = fmax(fabs(x), fmax(fabs(y), fabs(z)));
    const lane_int exponent = (LANES_AS_INT(largest) >> 23) & 255;
    return LANES_AS_FLOAT((253 - exponent) << 23);
}

/// A direction component in [-1, 1], rounded to a multiple of 2^-22.
static inline lane_float snap_direction(lane_float d) {
    return rint(d * (float)(1 << VXL_DIRECTION_BITS)) * (1.0f / (float)(1 << VXL_DIRECTION_BITS));
}

/// A coordinate rounded to the fixed point: to the nearest value where `side` is 0, else in the
/// direction of its sign.
static inline lane_float snap_position(lane_float o, lane_float side, float fixed_point) {
    const lane_float scaled = o * fixed_point;
    const lane_float nearest = rint(scaled);
    const lane_float up = nearest - LANES_FLOAT(LANE_MASK(nearest < scaled));
    const lane_float down = nearest + LANES_FLOAT(LANE_MASK(nearest > scaled));
    const lane_float snapped = LANES_SELECT(LANE_MASK(side > 0.0f), up,
                                            LANES_SELECT(LANE_MASK(side < 0.0f), down, nearest));
    return snapped * inverse_of_power(fixed_point);
}

/// Limits [t_first, t_last] of a ray to the part between two planes of one axis.
static inline void clip_axis(lane_float o, lane_float d, float size, lane_float* t_first,
                             lane_float* t_last) {
    const lane_float inverse = exact_reciprocal(d);
    const lane_float a = -o * inverse, b = (size - o) * inverse;
    const lane_int moves = LANE_MASK(d != 0.0f);
    const lane_int outside = LANE_MASK(o < 0.0f) | LANE_MASK(o > size);
    const lane_float none = LANES_SELECT(outside, (lane_float)-INFINITY, (lane_float)INFINITY);
    *t_first = fmax(*t_first, LANES_SELECT(moves, fmin(a, b), (lane_float)-INFINITY));
    *t_last = fmin(*t_last, LANES_SELECT(moves, fmax(a, b), none));
}

/// Limits [t_first, t_last] of a ray to the part in the world.
static inline void clip_to_world(Vector o, Vector d, int size_x, int size_y, int size_z,
                                 lane_float* t_first, lane_float* t_last) {
    clip_axis(o.x, d.x, (float)size_x, t_first, t_last);
    clip_axis(o.y, d.y, (float)size_y, t_first, t_last);
    clip_axis(o.z, d.z, (float)size_z, t_first, t_last);
}

/// The length of one unit of t in metres, for voxels with these edges.
static inline lane_float metres_per_t(float4 edge, Vector d) {
    const Vector metric = {d.x * edge.x, d.y * edge.y, d.z * edge.z};
    return exact_sqrt(dot_product(metric, metric));
}

/// A coordinate of the ray o + low + d t at t_first: exactly the world's side where the ray enters
/// there.
static inline lane_float start_coordinate(float o, lane_float low, lane_float d, float size,
                                          lane_float t_first) {
    const lane_float side = LANES_SELECT(LANE_MASK(d < 0.0f), (lane_float)size, (lane_float)0.0f);
    const lane_float t_side = (side - (o + low)) * exact_reciprocal(d);  // as clip_axis has it
    const lane_float at_start = clamp(fma(d, t_first, o) + low, 0.0f, size);
    return LANES_SELECT(LANE_MASK(t_side == t_first), side, at_start);
}

#endif
