// SPDX-License-Identifier: Apache-2.0
// Maps from points of the unit square to points of disks and to directions.
#ifndef VXL_DIRECTIONS_H
#define VXL_DIRECTIONS_H

#include "lib/lanes/exact_exp.h"
#include "lib/lanes/vector.h"
#include "lib/sampling/sobol.h"

/// A point of the unit disk. All points are equally probable.
static inline SquarePoint disk_point(SquarePoint p) {
    const lane_float radius = exact_sqrt(p.x);
    lane_float sine, cosine;
    exact_sincos(p.y * 6.28318531f, &sine, &cosine);
    const SquarePoint result = {radius * cosine, radius * sine};
    return result;
}

/// a * x + b * y + c * n, where x, y and the unit vector n are the axes of a right-handed system
/// (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1)).
static inline Vector around_normal(Vector n, lane_float a, lane_float b, lane_float c) {
    const lane_float one = (lane_float)1.0f;
    const lane_float sign = LANES_SELECT(LANE_MASK(n.z < 0.0f), -one, one);
    const lane_float k = -exact_reciprocal(sign + n.z), xy = n.x * n.y * k;
    const Vector x = {fma(sign * n.x * n.x, k, one), sign * xy, -sign * n.x};
    const Vector y = {xy, fma(n.y * n.y, k, sign), -n.y};
    const Vector result = {fma(a, x.x, fma(b, y.x, c * n.x)), fma(a, x.y, fma(b, y.y, c * n.y)),
                           fma(a, x.z, fma(b, y.z, c * n.z))};
    return result;
}

/// A direction above a surface. Its density is its cosine with the unit normal n, divided by pi.
/// The point's 24 bits keep that cosine from falling below 2^-12.
static inline Vector cosine_direction(Vector n, SquarePoint p) {
    const SquarePoint d = disk_point(p);
    return around_normal(n, d.x, d.y, exact_sqrt(1.0f - p.x));
}

#endif
