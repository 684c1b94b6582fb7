// SPDX-License-Identifier: Apache-2.0
// triangles -> the bricks that each of them reaches; these are counted, then listed.
//
// Bins are the frame's bricks and one more column at x = -1, which stands for all space left of the
// frame: crossings there count for the winding numbers to their right.
#include "lib/voxelize/lattice.h"

// A bound on the rounding of floats, with u = 2^-24. Values come from integers, so each has a
// relative error of at most u. A term of a sum has two such factors and is rounded by its product
// and at most two sums: 5 u of the terms' magnitudes, whose own sum is right within 6 u. The bound
// is 8 u.
#define SUM_ROUNDING 0x1p-21f
// A term of a radius has one such factor and is rounded by its product and three sums, and its half
// box was rounded three times: 8 u. The bound is 16 u.
#define RADIUS_ROUNDING 0x1p-20f

/// The bricks that one triangle's bounding box reaches.
typedef struct {
    int3 first, last;
} BrickRange;

/// `reach` is the distance in lattice units within which a triangle concerns a brick; `extent` is
/// the edge of a brick's closed box: 16 voxels, or 15 when only nodes count.
static inline BrickRange reached_bricks(const LatticeTriangle* t, int3 reach, int extent,
                                        int4 bins) {
    const int3 low = lowest_corner(t) - reach, high = highest_corner(t) + reach;
    BrickRange r;
    r.first = max((low - extent + (LATTICE_BRICK - 1)) >> 16, (int3)(-1, 0, 0));
    r.last = min(high >> 16, (int3)(bins.x - 2, bins.y - 1, bins.z - 1));
    r.last.x = max(r.last.x, -1);
    return r;
}

/// True if the triangle's plane may pass through the brick's box, widened by the reach. This is a
/// conservative test in floats.
static inline bool plane_reaches(float3 n, float3 to_corner, float3 half_box) {
    const float3 size = fabs(n);
    const float distance = fabs(n.x * to_corner.x + n.y * to_corner.y + n.z * to_corner.z);
    const float slack = SUM_ROUNDING * (size.x * fabs(to_corner.x) + size.y * fabs(to_corner.y) +
                                        size.z * fabs(to_corner.z));
    return distance <= size.x * half_box.x + size.y * half_box.y + size.z * half_box.z + slack;
}

/// False if one edge of the triangle, seen along an axis, separates the triangle from the box. This
/// is a conservative test in floats: it may return true for separate ones.
static inline bool edge_reaches(float2 edge, float2 to_corner, float2 to_opposite,
                                float2 half_box) {
    const float at = edge.x * to_corner.y - edge.y * to_corner.x;
    const float opposite = edge.x * to_opposite.y - edge.y * to_opposite.x;
    const float radius = fabs(edge.x) * half_box.y + fabs(edge.y) * half_box.x;
    const float slack = SUM_ROUNDING * (fabs(edge.x) * (fabs(to_corner.y) + fabs(to_opposite.y)) +
                                        fabs(edge.y) * (fabs(to_corner.x) + fabs(to_opposite.x)));
    return min(at, opposite) <= radius + slack && max(at, opposite) >= -radius - slack;
}

static inline bool triangle_reaches(const LatticeTriangle* t, float3 n, int3 brick, int3 reach,
                                    int extent) {
    const float3 half_box =
        (convert_float3(reach) + 0.5f * (float)extent) * (1.0f + RADIUS_ROUNDING);
    const int3 center = brick * LATTICE_BRICK + extent / 2;
    const float3 p[3] = {convert_float3(t->corner[0] - center),
                         convert_float3(t->corner[1] - center),
                         convert_float3(t->corner[2] - center)};
    if (!plane_reaches(n, p[0], half_box)) return false;
    for (int i = 0; i < 3; ++i) {
        // The difference is taken of the integers, because a difference of floats would include
        // their errors.
        const float3 edge = convert_float3(t->corner[(i + 1) % 3] - t->corner[i]);
        const float3 a = p[i], opposite = p[(i + 2) % 3];
        if (!edge_reaches(edge.xy, a.xy, opposite.xy, half_box.xy)) return false;
        if (!edge_reaches(edge.yz, a.yz, opposite.yz, half_box.yz)) return false;
        if (!edge_reaches(edge.zx, a.zx, opposite.zx, half_box.zx)) return false;
    }
    return true;
}

/// For each bin that triangle `number` reaches, counts it or, with `fill`, writes the triangle to
/// the bin's list.
static inline void visit_bins(const LatticeMesh* mesh, uint number, int4 bins, int4 reach,
                              int extent, bool fill, global uint* cursors, global uint* lists) {
    const LatticeTriangle t = load_triangle(mesh, number, (int3)(0, 0, 0));
    const BrickRange r = reached_bricks(&t, reach.xyz, extent, bins);
    const float3 n = convert_float3(area_vector(&t));
    const bool several = any(r.first != r.last);
    int3 b;
    for (b.z = r.first.z; b.z <= r.last.z; ++b.z)
        for (b.y = r.first.y; b.y <= r.last.y; ++b.y)
            for (b.x = r.first.x; b.x <= r.last.x; ++b.x) {
                if (several && b.x >= 0 && !triangle_reaches(&t, n, b, reach.xyz, extent)) continue;
                const uint bin = (uint)((b.z * bins.y + b.y) * bins.x + b.x + 1);
                const uint at = atomic_inc(&cursors[bin]);
                if (fill) lists[at] = number;
            }
}

/// One work-item takes one of the mesh's triangles. It adds 1 to the count of each bin that the
/// triangle reaches.
kernel void count_pairs(int4 bins, int4 reach, int extent, VXL_MESH_PARAMETERS,
                        global uint* restrict counts) {
    if (work_item() >= triangle_count) return;
    const LatticeMesh mesh = VXL_MESH;
    visit_bins(&mesh, mesh.first + work_item(), bins, reach, extent, false, counts, counts);
}

/// One work-item takes one of the mesh's triangles. It writes the triangle's number at the cursor
/// of each bin that it reaches.
///
/// The order within a list depends on the device, but every reader gives the same result for any
/// order.
kernel void list_pairs(int4 bins, int4 reach, int extent, VXL_MESH_PARAMETERS,
                       global uint* restrict cursors, global uint* restrict lists) {
    if (work_item() >= triangle_count) return;
    const LatticeMesh mesh = VXL_MESH;
    visit_bins(&mesh, mesh.first + work_item(), bins, reach, extent, true, cursors, lists);
}

/// One work-item takes one row of bricks along x. It gives each brick its slot, or marks it as
/// outside.
kernel void mark_outside(uint count, int4 bins, global const uint* restrict number_of_bin,
                         global uint* restrict slots) {
    const uint row = work_item();
    if (row >= count) return;
    for (int x = 1; x < bins.x; ++x)
        slots[row * (uint)(bins.x - 1) + (uint)(x - 1)] =
            number_of_bin[row * (uint)bins.x + (uint)x];
}
