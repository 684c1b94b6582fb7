// SPDX-License-Identifier: Apache-2.0
// The exact set of voxels in a brick's row that a triangle covers.
#ifndef VXL_COVER_H
#define VXL_COVER_H

#include "lib/voxelize/lattice.h"

// How far a voxel's closed cube extends beyond its sides for SUPERCOVER, in lattice units. On every
// axis, the lattice's corners are up to half a unit from those that rays meet, so voxels that list
// triangles for rays must also list triangles that come only that close.
#ifndef VXL_MARGIN
#define VXL_MARGIN 0
#endif

// This is 1 for a mesh of points and lines alone. A closed voxel shares a point on its side with
// the next voxel, so up to eight voxels would be taken; instead, only the next one counts what lies
// on its lower sides.
#ifndef VXL_POINTS
#define VXL_POINTS 0
#endif
#define LOWEST_REACH (1 - VXL_POINTS + VXL_MARGIN)

/// The position of brick `index` in a grid of `bricks`.
static inline int3 brick_of(uint index, int4 bricks) {
    const uint row = index / (uint)bricks.x;
    return (int3)((int)(index % (uint)bricks.x), (int)(row % (uint)bricks.y),
                  (int)(row / (uint)bricks.y));
}

/// Voxels of a brick, both ends included; none where first > last.
typedef struct {
    int3 first, last;
} CoverBox;

/// The voxels up to `last` whose closed cubes the triangle's bounding box meets; for points and
/// lines, the cubes are half-open.
static inline CoverBox cover_box(const LatticeTriangle* t, int3 last) {
    CoverBox box;
    box.first = max((lowest_corner(t) - LOWEST_REACH) >> LATTICE_BITS, (int3)(0));
    box.last = min((highest_corner(t) + VXL_MARGIN) >> LATTICE_BITS, last);
    return box;
}

/// -1 for each axis along which the triangle's whole bounding box meets more than one voxel.
static inline int3 long_axes(const LatticeTriangle* t) {
    const int3 first = (lowest_corner(t) - LOWEST_REACH) >> LATTICE_BITS;
    const int3 last = (highest_corner(t) + VXL_MARGIN) >> LATTICE_BITS;
    return first < last;
}

/// Bits first .. last.
static inline uint bits_between(int first, int last) {
    return (2u << last) - (1u << first);
}

/// A triangle prepared for tests of rows of voxels along x.
typedef struct {
    CoverBox box;
    // SUPERCOVER: the tests that are needed. In a single layer of voxels, the triangle meets
    // exactly those that its silhouette seen across the layer meets; in a single line of voxels it
    // meets all, because it is connected.
    bool sees_xy, sees_yz, sees_zx, meets_plane;
    long3 n;
    long low, high;  // SUPERCOVER: bounds on n·(v - box.first) for the plane to meet voxel v
    Silhouette xy, yz, zx;  // seen along z, x, y
    Crossing x, y, z;       // THIN: of the plane with lines along each axis
    ushort xy_rows[16];     // SUPERCOVER: the silhouette seen along z; bit x of row y
} Cover;

static inline void prepare_plane(Cover* c, const LatticeTriangle* t) {
    const long3 n = c->n;
    const long3 positive = max(n, (long3)(0)), negative = min(n, (long3)(0));
    const int3 outwards = VXL_MARGIN * convert_int3((n < 0L) - (n > 0L));
    const int3 near = t->corner[0] - c->box.first * LATTICE_VOXEL;
    long low, high;
    if (is_short(t)) {
        low = (dot_long(n, near - outwards) + (LATTICE_VOXEL - 1)) >> LATTICE_BITS;
        high = dot_long(n, near + outwards) >> LATTICE_BITS;
    } else {
        low = wide_ceil(wide_dot(n, near - outwards), LATTICE_BITS);
        high = wide_floor(wide_dot(n, near + outwards), LATTICE_BITS);
    }
    c->low = low - (positive.x + positive.y + positive.z);
    c->high = high - (negative.x + negative.y + negative.z);
}

static inline void prepare_supercover(Cover* c, const LatticeTriangle* t) {
    const int3* p = t->corner;
    const int3 is_long = long_axes(t);
    c->sees_xy = is_long.x & is_long.y;
    c->sees_yz = is_long.y & is_long.z;
    c->sees_zx = is_long.z & is_long.x;
    c->meets_plane = c->sees_xy & is_long.z;
    if (!(c->sees_xy | c->sees_yz | c->sees_zx)) return;
    c->n = area_vector(t);
    if (c->meets_plane) prepare_plane(c, t);
    if (c->sees_yz) c->yz = silhouette_of_cells(p[0].yz, p[1].yz, p[2].yz, c->n.x, VXL_MARGIN);
    if (c->sees_zx) c->zx = silhouette_of_cells(p[0].zx, p[1].zx, p[2].zx, c->n.y, VXL_MARGIN);
    if (!c->sees_xy) return;
    c->xy = silhouette_of_cells(p[0].xy, p[1].xy, p[2].xy, c->n.z, VXL_MARGIN);
    for (int y = c->box.first.y; y <= c->box.last.y; ++y)
        c->xy_rows[y] = (ushort)silhouette_row(&c->xy, y, c->box.first.x, c->box.last.x);
}

static inline void prepare_thin(Cover* c, const LatticeTriangle* t) {
    const int3* p = t->corner;
    const long3 n = area_vector(t);
    const int center = LATTICE_VOXEL / 2;
    c->n = n;
    c->xy = silhouette_of_points(p[0].xy, p[1].xy, p[2].xy, n.z, center, true);
    c->yz = silhouette_of_points(p[0].yz, p[1].yz, p[2].yz, n.x, center, true);
    c->zx = silhouette_of_points(p[0].zx, p[1].zx, p[2].zx, n.y, center, false);
    c->x = plane_crossing(n, p[0], n.y, n.z, n.x);
    c->y = plane_crossing(n, p[0], n.z, n.x, n.y);
    c->z = plane_crossing(n, p[0], n.x, n.y, n.z);
}

static inline void prepare_cover(Cover* c, const LatticeTriangle* t, const CoverBox* box,
                                 bool thin) {
    c->box = *box;
    if (thin)
        prepare_thin(c, t);
    else
        prepare_supercover(c, t);
}

/// The voxels of row (y, z) whose closed cubes the closed triangle meets, as bits x.
static inline uint supercover_row(const Cover* c, int y, int z) {
    const uint seen = c->sees_xy ? c->xy_rows[y] : bits_between(c->box.first.x, c->box.last.x);
    if (!seen || (c->sees_yz && !cell_in_silhouette(&c->yz, y, z))) return 0u;
    if (!c->sees_zx) return seen;
    const long row_at = c->n.y * (y - c->box.first.y) + c->n.z * (z - c->box.first.z);
    uint row = 0;
    for (int x = c->box.first.x; x <= c->box.last.x; ++x) {
        bool inside = cell_in_silhouette(&c->zx, z, x);
        if (c->meets_plane) {
            const long at = row_at + c->n.x * (x - c->box.first.x);
            inside = inside & (at >= c->low) & (at <= c->high);
        }
        row |= (uint)inside << x;
    }
    return row & seen;
}

/// The voxels of row (y, z) whose crosshairs (the three half-open segments through the centre) the
/// triangle meets, as bits x. A centre line on an edge is moved by (e, e², e³).
static inline uint thin_row(const Cover* c, int y, int z) {
    uint row = 0;
    if (c->n.x != 0 && point_in_silhouette(&c->yz, y, z)) {
        const long x = crossed_voxel(&c->x, 2 * y + 1, 2 * z + 1);
        if (x >= c->box.first.x && x <= c->box.last.x) row |= 1u << x;
    }
    for (int x = c->box.first.x; x <= c->box.last.x; ++x) {
        const bool along_y = c->n.y != 0 && point_in_silhouette(&c->zx, z, x) &&
                             crossed_voxel(&c->y, 2 * z + 1, 2 * x + 1) == y;
        const bool along_z = c->n.z != 0 && point_in_silhouette(&c->xy, x, y) &&
                             crossed_voxel(&c->z, 2 * x + 1, 2 * y + 1) == z;
        row |= (uint)(along_y | along_z) << x;
    }
    return row;
}

#endif
