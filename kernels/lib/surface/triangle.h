// SPDX-License-Identifier: Apache-2.0
// The points where rays meet the source triangles that exact voxels list.
//
// The watertight test of Woop, Benthin and Wald 2013: the ray becomes the z axis by a shear, and
// the signs of three edge functions decide. Two triangles evaluate a shared edge to opposite signs,
// so a ray cannot pass between them. Corners are taken relative to the ray's own origin, whichever
// voxel lists them.
#ifndef VXL_TRIANGLE_H
#define VXL_TRIANGLE_H

#include "lib/lanes/records.h"
#include "lib/lanes/vector.h"
#include "lib/traverse/walk.h"

/// The normal of triangles with counter-clockwise corners, not of unit length, for voxels with the
/// edges `edge`.
static inline Vector triangle_normal(global const float* restrict triangles, lane_uint number,
                                     float4 edge) {
    const lane_uint first = number * 9u;
    const lane_float ax = LANES_GATHER_FLOAT(triangles, first);
    const lane_float ay = LANES_GATHER_FLOAT(triangles, first + 1u);
    const lane_float az = LANES_GATHER_FLOAT(triangles, first + 2u);
    const lane_float ux = (LANES_GATHER_FLOAT(triangles, first + 3u) - ax) * edge.x;
    const lane_float uy = (LANES_GATHER_FLOAT(triangles, first + 4u) - ay) * edge.y;
    const lane_float uz = (LANES_GATHER_FLOAT(triangles, first + 5u) - az) * edge.z;
    const lane_float vx = (LANES_GATHER_FLOAT(triangles, first + 6u) - ax) * edge.x;
    const lane_float vy = (LANES_GATHER_FLOAT(triangles, first + 7u) - ay) * edge.y;
    const lane_float vz = (LANES_GATHER_FLOAT(triangles, first + 8u) - az) * edge.z;
    Vector n = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
    return n;
}

/// The shear of a ray: its largest direction component is axis z of the sheared space.
typedef struct {
    lane_int z_is_x, z_is_y;  // masks
    lane_float shear_x, shear_y, scale;
} RayShear;

static inline RayShear ray_shear(const Walk* w) {
    RayShear s;
    const lane_float ax = fabs(w->dx), ay = fabs(w->dy), az = fabs(w->dz);
    s.z_is_x = LANE_MASK(ax >= ay) & LANE_MASK(ax >= az);
    s.z_is_y = LANE_MASK(ay >= az) & ~s.z_is_x;
    const lane_float dz = LANES_SELECT(s.z_is_x, w->dx, LANES_SELECT(s.z_is_y, w->dy, w->dz));
    const lane_float dx = LANES_SELECT(s.z_is_x, w->dy, LANES_SELECT(s.z_is_y, w->dz, w->dx));
    const lane_float dy = LANES_SELECT(s.z_is_x, w->dz, LANES_SELECT(s.z_is_y, w->dx, w->dy));
    s.scale = exact_reciprocal(dz);
    s.shear_x = dx * s.scale;
    s.shear_y = dy * s.scale;
    return s;
}

/// A corner in the ray's sheared space.
typedef struct {
    lane_float x, y, z;
} ShearedCorner;

static inline ShearedCorner shear_corner(lane_uint x_bits, lane_uint y_bits, lane_uint z_bits,
                                         const Walk* w, const RayShear* s) {
    const lane_float vx = LANES_AS_FLOAT(x_bits) - w->ox;
    const lane_float vy = LANES_AS_FLOAT(y_bits) - w->oy;
    const lane_float vz = LANES_AS_FLOAT(z_bits) - w->oz;
    const lane_float z = LANES_SELECT(s->z_is_x, vx, LANES_SELECT(s->z_is_y, vy, vz));
    const lane_float x = LANES_SELECT(s->z_is_x, vy, LANES_SELECT(s->z_is_y, vz, vx));
    const lane_float y = LANES_SELECT(s->z_is_x, vz, LANES_SELECT(s->z_is_y, vx, vy));
    ShearedCorner corner = {fma(-s->shear_x, z, x), fma(-s->shear_y, z, y), z * s->scale};
    return corner;
}

/// The edge function of a and b, within 1.5 of its own units in the last place. So its sign is
/// right, unless products underflow (Kahan's difference of products: Jeannerod, Louvet and Muller
/// 2013).
static inline lane_float edge_function(ShearedCorner a, ShearedCorner b) {
    const lane_float right = a.y * b.x;
    const lane_float rounded = fma(-a.y, b.x, right);
    return fma(a.x, b.y, -right) + rounded;
}

/// Tests triangle `number` of each lane in `tested`; hits in the world beyond t_min, or at it where
/// `counts_at_first` is set, that are closer than *t replace it. Rays from `within` the triangle's
/// object meet only its back, because the neighbour across an edge at which they entered has its
/// front towards them. Rays from `outside` meet only its front. `front` is set where they meet its
/// front.
static inline lane_int hit_triangle(const PyramidView* p, lane_float t_min,
                                    lane_int counts_at_first, global const float* triangles,
                                    lane_uint number, const Walk* w, const RayShear* s,
                                    lane_int within, lane_int outside, lane_int tested,
                                    lane_float* t, lane_int* front) {
    global const uint* words = (global const uint*)triangles;
    const Records r = read_words(words, 9u, number);
    const lane_uint last = LANES_GATHER_UINT(words, number * 9u + 8u);
    const ShearedCorner a = shear_corner(r.word[0], r.word[1], r.word[2], w, s);
    const ShearedCorner b = shear_corner(r.word[3], r.word[4], r.word[5], w, s);
    const ShearedCorner c = shear_corner(r.word[6], r.word[7], last, w, s);
    const lane_float u = edge_function(c, b);
    const lane_float v = edge_function(a, c);
    const lane_float e = edge_function(b, a);
    const lane_int one_side = (LANE_MASK(u >= 0.0f) & LANE_MASK(v >= 0.0f) & LANE_MASK(e >= 0.0f)) |
                              (LANE_MASK(u <= 0.0f) & LANE_MASK(v <= 0.0f) & LANE_MASK(e <= 0.0f));
    const lane_float determinant = u + v + e;
    lane_int solid = LANE_MASK(determinant != 0.0f) & one_side & tested;
    // The determinant's sign is that of -(n . d) times the direction along the sheared z.
    if (VXL_TRANSMISSION) solid &= ~within | LANE_MASK(determinant * s->scale < 0.0f);
    *front = LANE_MASK(determinant * s->scale > 0.0f);
    if (VXL_MIXED) solid &= ~outside | *front;
    if (!lanes_any(solid)) return solid;
    const lane_float weighted = fma(u, a.z, fma(v, b.z, e * c.z));
    const lane_float at =
        exact_divide(weighted, LANES_SELECT(solid, determinant, (lane_float)1.0f));
    const lane_int closer = solid &
                            (LANE_MASK(at > t_min) | (counts_at_first & LANE_MASK(at == t_min))) &
                            LANE_MASK(at < *t) & is_in_world(p, w, at);
    *t = LANES_SELECT(closer, at, *t);
    return closer;
}

#endif
