// SPDX-License-Identifier: Apache-2.0
// Exact integer geometry of triangles on the lattice of 1/4096 voxel that voxelization works on.
//
// Coordinates are lattice units from a brick's minimum corner, |v| <= 2^27. Edge functions then fit
// 62 bits. Plane terms need 84 bits: they are formed once per triangle and brick in 128 bits, and
// their quotient by the lattice spacing of the compared values fits 64 bits again (or is saturated,
// which changes no comparison inside the brick).
#ifndef VXL_LATTICE_H
#define VXL_LATTICE_H

#include "lib/lanes/work_item.h"
#include "lib/voxelize/mesh.h"

#define LATTICE_BITS 12
#define LATTICE_VOXEL 4096
#define LATTICE_BRICK 65536

/// Corners counter-clockwise, in lattice units.
typedef struct {
    int3 corner[3];
} LatticeTriangle;

static inline LatticeTriangle load_triangle(const LatticeMesh* mesh, uint number, int3 origin) {
    LatticeTriangle t;
    for (int i = 0; i < 3; ++i)
        t.corner[i] = vload3(mesh->triangles[3u * number + i], mesh->vertices) - origin;
    return t;
}

static inline int3 lowest_corner(const LatticeTriangle* t) {
    return min(min(t->corner[0], t->corner[1]), t->corner[2]);
}

static inline int3 highest_corner(const LatticeTriangle* t) {
    return max(max(t->corner[0], t->corner[1]), t->corner[2]);
}

/// Twice the area vector; 0 for a triangle without area. Each component is below 2^56.
static inline long3 area_vector(const LatticeTriangle* t) {
    const long3 u = convert_long3(t->corner[1]) - convert_long3(t->corner[0]);
    const long3 v = convert_long3(t->corner[2]) - convert_long3(t->corner[0]);
    return (long3)(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
}

/// True if the triangle spans at most 128 voxels. Then n · p of its corners, taken from a voxel of
/// its box, stays below 2^61.
static inline bool is_short(const LatticeTriangle* t) {
    const int3 size = highest_corner(t) - lowest_corner(t);
    return max(size.x, max(size.y, size.z)) <= 128 * LATTICE_VOXEL;
}

static inline long dot_long(long3 n, int3 p) {
    return n.x * p.x + n.y * p.y + n.z * p.z;
}

/// A signed number of 128 bits.
typedef struct {
    long high;
    ulong low;
} Wide;

static inline Wide wide_sum(Wide a, long high, ulong low) {
    Wide s;
    s.low = a.low + low;
    s.high = a.high + high + (s.low < low ? 1 : 0);
    return s;
}

static inline Wide wide_product_sum(Wide s, long a, long b) {
    return wide_sum(s, mul_hi(a, b), (ulong)a * (ulong)b);
}

/// n · p.
static inline Wide wide_dot(long3 n, int3 p) {
    Wide s = {0, 0};
    s = wide_product_sum(s, n.x, (long)p.x);
    s = wide_product_sum(s, n.y, (long)p.y);
    return wide_product_sum(s, n.z, (long)p.z);
}

/// floor(s / 2^bits), saturated to ±2^62; 2 <= bits < 64.
static inline long wide_floor(Wide s, int bits) {
    const long limit = 1L << (bits - 2);
    if (s.high >= limit) return 1L << 62;
    if (s.high < -limit) return -(1L << 62);
    return (long)(((ulong)s.high << (64 - bits)) | (s.low >> bits));
}

/// ceil(s / 2^bits), saturated to ±2^62.
static inline long wide_ceil(Wide s, int bits) {
    return wide_floor(wide_sum(s, 0, (1UL << bits) - 1UL), bits);
}

/// The float nearest to s, with 24 bits of precision; the last bit may be off by one.
static inline float wide_to_float(Wide s) {
    const long low = (long)s.low;
    if ((low < 0 ? -1L : 0L) == s.high) return (float)low;
    return (float)s.high * 18446744073709551616.0f + (float)s.low;
}

/// floor(a / b) for b > 0.
static inline long floor_quotient(long a, long b) {
    const long q = a / b;
    return q - (a - q * b < 0 ? 1 : 0);
}

/// The three edges of a triangle seen along an axis, as bounds low <= u U + w W <= high on a cell
/// or point (U, W) in voxels. Vector components are edges, because a loop over edges took a fifth
/// more time.
typedef struct {
    long3 u, w, low, high;
} Silhouette;

/// A triangle's corners seen along an axis. Vector components are corners.
typedef struct {
    int3 u, w;
} Outline;

static inline Outline outline_of(int2 a, int2 b, int2 c) {
    const Outline p = {(int3)(a.x, b.x, c.x), (int3)(a.y, b.y, c.y)};
    return p;
}

static inline void silhouette_edges(Silhouette* s, const Outline* p) {
    s->u = convert_long3(p->w - p->w.yzx);
    s->w = convert_long3(p->u.yzx - p->u);
}

/// The closed cells [U,U+1] x [W,W+1] that may meet the closed triangle; `area` is twice its signed
/// area.
///
/// `margin` widens the cells on all sides, in lattice units.
///
/// Each edge is tested from both sides (as a separating axis), so triangles without area are exact,
/// too. Together with the axes of the cell itself, which are those of the bounding box, the test is
/// exact.
static inline Silhouette silhouette_of_cells(int2 a, int2 b, int2 c, long area, int margin) {
    const Outline p = outline_of(a, b, c);
    Silhouette s;
    silhouette_edges(&s, &p);
    const long3 at = s.u * convert_long3(p.u) + s.w * convert_long3(p.w);
    // oclgrind mistakes a vector's max(v, 0L) for the scalar function.
    const long3 positive = max(s.u, (long3)(0)) + max(s.w, (long3)(0));
    const long3 negative = min(s.u, (long3)(0)) + min(s.w, (long3)(0));
    const long3 widened = margin * (positive - negative);
    s.low = ((at + (min(area, 0L) + (LATTICE_VOXEL - 1)) - widened) >> LATTICE_BITS) - positive;
    s.high = ((at + max(area, 0L) + widened) >> LATTICE_BITS) - negative;
    return s;
}

/// The points (U,W) + offset/4096 inside the triangle, whose area must not be 0.
///
/// A point on an edge is decided as if it were moved by (e, e²) for an infinitesimal e, with the
/// larger part along u if `u_first`, otherwise along w. So each point on a shared edge of a closed
/// outline is in exactly one of the two neighbours.
static inline Silhouette silhouette_of_points(int2 a, int2 b, int2 c, long area, int offset,
                                              bool u_first) {
    const Outline p = outline_of(a, b, c);
    Silhouette s;
    silhouette_edges(&s, &p);
    const long sign = area < 0 ? -1 : 1;
    s.u *= sign;
    s.w *= sign;
    const long3 major = u_first ? s.u : s.w, minor = u_first ? s.w : s.u;
    const long3 tie_is_outside = (major < 0L) | ((major == 0L) & (minor <= 0L));
    const long3 minimum =
        s.u * convert_long3(p.u - offset) + s.w * convert_long3(p.w - offset) - tie_is_outside;
    s.low = (minimum + (LATTICE_VOXEL - 1)) >> LATTICE_BITS;
    return s;
}

static inline bool cell_in_silhouette(const Silhouette* s, int u, int w) {
    const long3 at = s->u * u + s->w * w;
    return all((at >= s->low) & (at <= s->high));
}

static inline bool point_in_silhouette(const Silhouette* s, int u, int w) {
    return all(s->u * u + s->w * w >= s->low);
}

/// The cells of row w, from `first` to `last`, that are in the silhouette, as bits u.
static inline uint silhouette_row(const Silhouette* s, int w, int first, int last) {
    uint row = 0;
    for (int u = first; u <= last; ++u) row |= (uint)cell_in_silhouette(s, u, w) << u;
    return row;
}

/// The crossings of lines along an axis with a triangle's plane; c runs along the line, u and w
/// across it. Units are half voxels, since lines go through voxels' corners or centres.
typedef struct {
    long u, w, c;            // the normal, turned so that c > 0
    long floor_at, ceil_at;  // of n·p for the plane's points p, in half voxels
} Crossing;

static inline Crossing plane_crossing(long3 n, int3 point, long nu, long nw, long nc) {
    const long sign = nc < 0 ? -1 : 1;
    const Wide at = wide_dot(n * sign, point);
    Crossing p = {nu * sign, nw * sign, nc * sign, 0, 0};
    p.floor_at = wide_floor(at, LATTICE_BITS - 1);
    p.ceil_at = wide_ceil(at, LATTICE_BITS - 1);
    return p;
}

/// The voxel v with v <= crossing < v+1 on the line at (u, w) half voxels.
static inline long crossed_voxel(const Crossing* p, long u, long w) {
    return floor_quotient(p->floor_at - p->u * u - p->w * w, 2 * p->c);
}

/// The number of points offset/2 + 0, 1, 2, ... voxels that lie before the crossing (not on it).
static inline long points_before(const Crossing* p, long u, long w, long offset) {
    return -floor_quotient(p->u * u + p->w * w - p->ceil_at + offset * p->c, 2 * p->c);
}

#endif
