// SPDX-License-Identifier: Apache-2.0
// The squared distance from points near a brick to a triangle, as accurate as floats allow.
//
// In the frame of the triangle everything is affine in the point: h above its plane, s_i outside
// each edge line, e_i along each edge. The constants are evaluated at the foot point that is
// nearest to the brick's centre, found in 64-bit fixed point, so a triangle of thousands of voxels
// loses no digit.
//
// Vectors are chosen by `if`, because choosing one by a scalar condition isn't valid in SPIR-V
// before 1.4.
#ifndef VXL_POINT_TRIANGLE_H
#define VXL_POINT_TRIANGLE_H

#include "lib/lanes/exact_float.h"
#include "lib/voxelize/lattice.h"

/// The number of floats of `shapes` per triangle: normal, plane scale; 3 x (edge direction,
/// length); 3 x 1/length.
#define SHAPE_FLOATS 20

static inline float first_lane(lane_float v) {
    return ((const float*)&v)[0];
}
static inline float scalar_root(float x) {
    return first_lane(exact_sqrt((lane_float)(x)));
}
static inline float scalar_reciprocal(float x) {
    return first_lane(exact_reciprocal((lane_float)(x)));
}

static inline float dot_product(float3 a, float3 b) {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}

static inline float3 cross_product(float3 a, float3 b) {
    return (float3)(fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)),
                    fma(a.x, b.y, -(a.y * b.x)));
}

/// The function f(p) = at + gradient · p, with p in voxels from the brick's centre and f in the
/// shortest voxel edge.
typedef struct {
    float3 gradient;
    float at;
} Affine;

typedef struct {
    Affine outside;  ///< signed distance from the edge's line in the triangle's plane
    Affine along;    ///< from the edge's end nearest to the brick, towards the other
    float length;
} TriangleEdge;

typedef struct {
    Affine height;         ///< above the plane
    TriangleEdge edge[3];  ///< the longest edge first
} TriangleFrame;

/// A unit vector perpendicular to the unit vector e.
static inline float3 any_perpendicular(float3 e) {
    const float3 a = fabs(e);
    const bool is_x = a.x <= a.y && a.x <= a.z, is_y = !is_x && a.y <= a.z;
    const float3 axis =
        (float3)(is_x ? 1.0f : 0.0f, is_y ? 1.0f : 0.0f, is_x || is_y ? 0.0f : 1.0f);
    const float3 p = cross_product(e, axis);
    return p * scalar_reciprocal(scalar_root(dot_product(p, p)));
}

/// Writes the part of a triangle's frame that is equal for all bricks: unit vectors, in metric
/// space; `scale` is each voxel edge in units of the shortest. The plane scale is 0 for a triangle
/// without area, whose normal is any unit vector perpendicular to its longest edge.
static inline void shape_of_triangle(const LatticeTriangle* t, float3 scale, global float* shape) {
    const float to_voxels = 1.0f / LATTICE_VOXEL, shrink = 1.0f / 1048576.0f;
    float longest = -1.0f;
    float3 longest_direction;
    for (int i = 0; i < 3; ++i) {
        const float3 edge =
            convert_float3(t->corner[(i + 1) % 3] - t->corner[i]) * scale * to_voxels;
        const float length = scalar_root(dot_product(edge, edge));
        const float inverse = length > 0.0f ? scalar_reciprocal(length) : 0.0f;
        float3 direction = edge * inverse;
        if (!(length > 0.0f)) direction = (float3)(1.0f, 0.0f, 0.0f);
        vstore4((float4)(direction, length), 0, shape + 4 + 4 * i);
        shape[16 + i] = inverse;
        if (length > longest) {
            longest = length;
            longest_direction = direction;
        }
    }
    const long3 n = area_vector(t);
    if (!(n.x | n.y | n.z)) {
        vstore4((float4)(any_perpendicular(longest_direction), 0.0f), 0, shape);
        return;
    }
    // The area vector is shrunk by a power of two, so that squares of 2^56 stay within floats.
    const float3 area = convert_float3(n) * shrink *
                        (float3)(scale.y * scale.z, scale.z * scale.x, scale.x * scale.y);
    const float inverse = scalar_reciprocal(scalar_root(dot_product(area, area)));
    const float volume = scale.x * scale.y * scale.z;
    vstore4((float4)(area * inverse, inverse * volume * shrink * to_voxels), 0, shape);
}

static inline Affine affine_through(float3 unit, float3 zero, float3 scale) {
    Affine f = {unit * scale, -dot_product(unit, zero)};
    return f;
}

/// The edge from `start` to `end` (lattice units from the brick's centre).
static inline TriangleEdge frame_edge(int3 start, int3 end, float4 edge, float inverse,
                                      float3 normal, float3 scale, float3* foot) {
    const float3 to_metric = scale * (1.0f / LATTICE_VOXEL);
    const float3 from = convert_float3(start) * to_metric;
    const float t = clamp(-dot_product(edge.xyz, from) * inverse, 0.0f, 1.0f);
    const long part = (long)(t * 16777216.0f);
    const long3 fixed =
        (convert_long3(start) << 24) + (convert_long3(end) - convert_long3(start)) * part;
    *foot = convert_float3(fixed) * (1.0f / 16777216.0f) * to_metric;
    float3 along = edge.xyz, zero = from;  // from the nearer end
    if (t > 0.5f) along = -edge.xyz, zero = convert_float3(end) * to_metric;
    TriangleEdge e;
    e.outside = affine_through(cross_product(edge.xyz, normal), *foot, scale);
    e.along = affine_through(along, zero, scale);
    e.length = edge.w;
    return e;
}

/// The triangle's frame for a brick; its corners are in lattice units from the brick's centre.
static inline TriangleFrame frame_triangle(const LatticeTriangle* t, global const float* shape,
                                           float3 scale) {
    const float4 plane = vload4(0, shape);
    const float a = shape[7], b = shape[11], c = shape[15];
    const int longest = a >= b && a >= c ? 0 : b >= c ? 1 : 2;
    const bool flat = plane.w != 0.0f;
    TriangleFrame f;
    float3 foot;
    for (int i = 0; i < 3; ++i) {
        const int n = flat ? (longest + i) % 3 : longest;
        f.edge[i] = frame_edge(t->corner[n], t->corner[(n + 1) % 3], vload4(n + 1, shape),
                               shape[16 + n], plane.xyz, scale, &foot);
    }
    if (flat) {
        f.height.gradient = plane.xyz * scale;
        f.height.at = -wide_to_float(wide_dot(area_vector(t), t->corner[0])) * plane.w;
    } else {
        // This is a segment: two edges back to back enclose no area, so only their own distance
        // counts.
        f.height = affine_through(plane.xyz, foot, scale);
        f.edge[1].outside.gradient = -f.edge[1].outside.gradient;
        f.edge[1].outside.at = -f.edge[1].outside.at;
    }
    return f;
}

/// A triangle's affine functions at the x and y of a tile's lanes, for z = 0.
typedef struct {
    lane_float height, outside[3], along[3];
} TileFrame;

static inline lane_float affine_at(const Affine* f, lane_float x, lane_float y) {
    return fma((lane_float)(f->gradient.y), y,
               fma((lane_float)(f->gradient.x), x, (lane_float)(f->at)));
}

static inline TileFrame tile_frame(const TriangleFrame* f, lane_float x, lane_float y) {
    TileFrame t;
    t.height = affine_at(&f->height, x, y);
    for (int i = 0; i < 3; ++i) {
        t.outside[i] = affine_at(&f->edge[i].outside, x, y);
        t.along[i] = affine_at(&f->edge[i].along, x, y);
    }
    return t;
}

/// The squared distances of the tile's nodes at height z.
static inline lane_float squared_distance(const TriangleFrame* f, const TileFrame* t, float z) {
    const lane_float zero = (lane_float)(0.0f), height_z = (lane_float)(z);
    const lane_float height = fma((lane_float)(f->height.gradient.z), height_z, t->height);
    lane_float nearest = zero, outermost = zero;
    for (int i = 0; i < 3; ++i) {
        const lane_float outside =
            fma((lane_float)(f->edge[i].outside.gradient.z), height_z, t->outside[i]);
        const lane_float along =
            fma((lane_float)(f->edge[i].along.gradient.z), height_z, t->along[i]);
        const lane_float beyond = fmax(-along, along - f->edge[i].length);
        const lane_float past_end = fmax(beyond, zero);
        const lane_float squared = fma(outside, outside, past_end * past_end);
        // For thin triangles, rounding may call points beyond a sharp tip inside all edges, but
        // such points are past the end of the longest edge.
        outermost = i == 0 ? fmax(outside, beyond) : fmax(outermost, outside);
        nearest = i == 0 ? squared : fmin(nearest, squared);
    }
    const lane_float in_plane = LANES_SELECT(LANE_MASK(outermost <= zero), zero, nearest);
    return fma(height, height, in_plane);
}

#endif
