// SPDX-License-Identifier: Apache-2.0
// Shading normals: those of a triangle's corners, interpolated where rays meet the triangle, and
// those of the surface that cubes stand for.
//
// Visibility, sides and the medium behind a surface depend on the triangle's or the face's own
// normal.
#ifndef VXL_SHADING_NORMAL_H
#define VXL_SHADING_NORMAL_H

#include "lib/lanes/vector.h"
#include "lib/surface/packed_normal.h"

/// Unpacks normals to vectors in the voxels of their grid, not of unit length.
static inline Vector unpack_normal(lane_uint packed) {
    Vector n;
    unpack_components(packed, &n.x, &n.y, &n.z);
    return n;
}

/// A triangle's corner in the voxels of its grid.
static inline Vector triangle_corner(global const float* restrict triangles, lane_uint number,
                                     uint corner) {
    const lane_uint first = number * 9u + corner * 3u;
    const Vector v = {LANES_GATHER_FLOAT(triangles, first),
                      LANES_GATHER_FLOAT(triangles, first + 1u),
                      LANES_GATHER_FLOAT(triangles, first + 2u)};
    return v;
}

static inline Vector cross_of(Vector a, Vector b) {
    const Vector result = {fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)),
                           fma(a.x, b.y, -(a.y * b.x))};
    return result;
}

/// The weights of a triangle's corners at a point on it; each is at least 0, and their sum is 1.
/// `from` is the point relative to each corner.
static inline void corner_weights(const Vector* from, lane_float* weight) {
    const Vector ab = difference(from[0], from[1]), ac = difference(from[0], from[2]);
    const Vector n = cross_of(ab, ac);
    const lane_float squared = dot_product(n, n);
    const lane_float inverse =
        exact_reciprocal(LANES_SELECT(LANE_MASK(squared > 0.0f), squared, (lane_float)1.0f));
    const lane_float zero = (lane_float)0.0f;
    for (int i = 0; i < 3; ++i) {
        const Vector opposite_part = cross_of(from[(i + 1) % 3], from[(i + 2) % 3]);
        weight[i] = fmax(dot_product(opposite_part, n) * inverse, zero);
    }
    const lane_float sum = weight[0] + weight[1] + weight[2];
    const lane_int some = LANE_MASK(sum > 0.0f);
    const lane_float per_sum = exact_reciprocal(LANES_SELECT(some, sum, (lane_float)1.0f));
    for (int i = 0; i < 3; ++i)
        weight[i] = LANES_SELECT(some, weight[i] * per_sum, (lane_float)(1.0f / 3.0f));
}

/// How a surface point is lit.
typedef struct {
    Vector normal;  // a unit vector in metric space
    Vector offset;  // metres: from the point to where rays to lights begin; not 0 if they begin
                    // above a triangle, on the side of its geometric normal, or above a cube's
                    // steps
} ShadingPoint;

// The batch's `shading` holds six values for each ray, those of ShadingPoint: the normal from 0 on,
// and the offset from this index on.
#define VXL_SHADING_OFFSET 3u

/// The minimum cosine with surfaces that have smoothed normals of directions in which these scatter
/// light: directions that come closer to the surface are moved up to this cosine.
#define VXL_MIN_COSINE (1.0f / 4096.0f)

/// Mask: lanes whose vectors differ.
static inline lane_int are_different(Vector a, Vector b) {
    return LANE_MASK(a.x != b.x) | LANE_MASK(a.y != b.y) | LANE_MASK(a.z != b.z);
}

/// Mask: vectors that aren't 0.
static inline lane_int has_length(Vector v) {
    return LANE_MASK(v.x != 0.0f) | LANE_MASK(v.y != 0.0f) | LANE_MASK(v.z != 0.0f);
}

/// The direction v, moved along the unit normal n so far that v . n is at least `lowest`. The
/// result is not scaled to unit length.
static inline Vector keep_on_side(Vector v, Vector n, lane_float lowest) {
    const lane_float below = fmax(lowest - dot_product(v, n), 0.0f);
    return add_scaled(v, n, below);
}

/// The normal by which light along the unit vector `way` is reflected and refracted: the shading
/// normal, bent towards the geometric normal `n` until the reflected ray stays above the surface;
/// or `n` itself where the shading normal points behind the surface. As in Keller et al. 2017 ("The
/// Iray Light Transport Simulation and Rendering System", A.3), a bent normal is the half vector of
/// the corrected reflected ray.
static inline Vector reflecting_normal(Vector way, Vector n, Vector shading) {
    const lane_float above = -dot_product(way, n);
    const lane_float lowest = fmin(0.9f * fmax(above, 0.0f), 0.01f);
    const lane_float twice = -2.0f * dot_product(way, shading);
    const Vector mirrored = add_scaled(way, shading, twice);
    const lane_int below = LANE_MASK(dot_product(mirrored, n) < lowest);
    const Vector kept = unit(keep_on_side(mirrored, n, lowest));
    const Vector half_way = unit(difference(kept, way));
    const Vector used = select_vector(below, half_way, shading);
    return select_vector(LANE_MASK(dot_product(shading, n) > 0.0f), used, n);
}

#endif
