// SPDX-License-Identifier: Apache-2.0
// triangles of each brick -> winding numbers at voxels' corners or centres, exact for closed
// meshes.
//
// The winding number of a point is the signed number of crossings left of it on its row along x.
// Ties, points on edges and crossings at points, are decided as if each point were moved by (e, e²,
// e³) for an infinitesimal e.
#include "lib/voxelize/cover.h"
#include "shared/voxel.h"

/// With VXL_CENTERS 1, points are voxels' centres; otherwise, their minimum corners.
#ifndef VXL_CENTERS
#define VXL_CENTERS 0
#endif
#define POINT_OFFSET (VXL_CENTERS * LATTICE_VOXEL / 2)

#define COLUMN_NUMBERS ((short16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))

/// Adds one triangle's crossings to the rows of a brick: to `winding`, 16 points a row, and to
/// `totals`.
///
/// Each crossing is counted in the brick that holds it. `left` is true for the column that stands
/// for all space x < 0.
static inline void add_crossings(const LatticeTriangle* t, bool left, short16* winding,
                                 short* totals) {
    const long3 n = area_vector(t);
    if (n.x == 0) return;
    const int3 low = lowest_corner(t), high = highest_corner(t);
    if (left ? low.x >= 0 : (high.x < 0 || low.x >= LATTICE_BRICK)) return;
    // The rows whose points lie in the bounding box: from the ceiling of its start to the floor of
    // its end.
    const int2 first =
        max((low.yz - POINT_OFFSET + (LATTICE_VOXEL - 1)) >> LATTICE_BITS, (int2)(0));
    const int2 last = min((high.yz - POINT_OFFSET) >> LATTICE_BITS, (int2)(15));
    if (any(first > last)) return;
    const Silhouette s = silhouette_of_points(t->corner[0].yz, t->corner[1].yz, t->corner[2].yz,
                                              n.x, POINT_OFFSET, true);
    const Crossing plane = plane_crossing(n, t->corner[0], n.y, n.z, n.x);
    const short turn = n.x < 0 ? 1 : -1;
    for (int z = first.y; z <= last.y; ++z)
        for (int y = first.x; y <= last.x; ++y) {
            if (!point_in_silhouette(&s, y, z)) continue;
            const long u = 2 * y + VXL_CENTERS, w = 2 * z + VXL_CENTERS;
            const long voxel = crossed_voxel(&plane, u, w);
            if (left ? voxel >= 0 : (voxel < 0 || voxel > 15)) continue;
            totals[16 * z + y] += turn;
            if (left) continue;
            const short before = (short)points_before(&plane, u, w, VXL_CENTERS);
            winding[16 * z + y] += select((short16)(0), (short16)(turn), COLUMN_NUMBERS >= before);
        }
}

/// One work-item takes one bin with triangles. Bins below `stored` are bricks that get winding
/// numbers counted from their own left face; all bins get the totals of their 256 rows.
kernel void count_crossings(VXL_MESH_PARAMETERS, VXL_BINS_PARAMETERS,
                            global short* restrict winding, global short* restrict totals) {
    const uint number = work_item();
    if (number >= bin_count) return;
    const LatticeMesh mesh = VXL_MESH;
    const TriangleBins bins = VXL_BINS;
    const int3 bin = brick_of(bins.occupied[number], bins.size);
    const bool left = bin.x == 0;
    const int3 origin = (int3)(max(bin.x - 1, 0), bin.y, bin.z) * LATTICE_BRICK;
    short16 rows[256];
    short row_totals[256];
    for (int i = 0; i < 256; ++i) {
        rows[i] = (short16)(0);
        row_totals[i] = 0;
    }
    for (uint i = bins.first[number]; i < bins.first[number + 1]; ++i) {
        const LatticeTriangle t = load_triangle(&mesh, bins.lists[i], origin);
        add_crossings(&t, left, rows, row_totals);
    }
    for (uint i = 0; i < 256u; ++i) {
        totals[256u * number + i] = row_totals[i];
        if (number < bins.stored) vstore16(rows[i], 256u * number + i, winding);
    }
}

/// One work-item takes one row of bricks along x. It turns the totals into each brick's winding
/// numbers at its left face, marks bricks without triangles as inside or outside, and writes the
/// winding number of all points of such bricks to `passing`.
kernel void carry_rows(uint count, int4 bins, global const uint* restrict number_of_bin,
                       global short* restrict totals, global uint* restrict slots,
                       global short* restrict passing) {
    const uint row = work_item();
    if (row >= count) return;
    short16 running[16];
    for (int i = 0; i < 16; ++i) running[i] = (short16)(0);
    for (int x = 0; x < bins.x; ++x) {
        const uint number = number_of_bin[row * (uint)bins.x + (uint)x];
        const uint brick = row * (uint)(bins.x - 1) + (uint)(x - 1);
        if (number == VXL_BRICK_OUTSIDE) {
            if (x == 0) continue;
            slots[brick] = running[0].s0 > 0 ? VXL_BRICK_INSIDE : VXL_BRICK_OUTSIDE;
            passing[brick] = running[0].s0;
            continue;
        }
        if (x > 0) slots[brick] = number;
        for (uint i = 0; i < 16u; ++i) {
            const short16 total = vload16(16u * number + i, totals);
            vstore16(running[i], 16u * number + i, totals);
            running[i] += total;
        }
    }
}

/// One work-item takes one brick. Bit x of inside[16 z + y] says whether the winding number of
/// point (x, y, z) is above 1/2.
kernel void find_inside(uint count, global const short* restrict winding,
                        global const short* restrict row_starts, global ushort* restrict inside) {
    const uint slot = work_item();
    if (slot >= count) return;
    const short16 bits = (short16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192,
                                   16384, (short)-32768);
    for (uint i = 0; i < 256u; ++i) {
        const short16 w = vload16(256u * slot + i, winding) + row_starts[256u * slot + i];
        const short16 set = select((short16)(0), bits, w > (short16)(0));
        const short8 h8 = set.lo | set.hi;
        const short4 h4 = h8.lo | h8.hi;
        const short2 h2 = h4.lo | h4.hi;
        inside[256u * slot + i] = as_ushort((short)(h2.x | h2.y));
    }
}

/// One work-item takes one brick. It writes the brick's SOLID occupancy from the rows of `inside`,
/// within the frame's size.
kernel void fill_solid(uint count, int4 size, int4 bricks, global const uint* restrict coordinates,
                       global const ushort* restrict inside, global ulong* restrict occupancy) {
    const uint slot = work_item();
    if (slot >= count) return;
    const int3 within = min(size.xyz - brick_of(coordinates[slot], bricks) * 16, (int3)(16));
    const uint row_mask = within.x <= 0 ? 0u : (1u << within.x) - 1u;
    for (int leaf = 0; leaf < 64; ++leaf) {
        const int x = 4 * (leaf & 3), y = 4 * ((leaf >> 2) & 3), z = 4 * (leaf >> 4);
        ulong mask = 0;
        for (int i = 0; i < 16; ++i) {
            const int row_y = y + (i & 3), row_z = z + (i >> 2);
            if (row_y >= within.y || row_z >= within.z) continue;
            const uint row = inside[256u * slot + 16u * (uint)row_z + (uint)row_y] & row_mask;
            mask |= (ulong)((row >> x) & 15u) << (4 * i);
        }
        occupancy[64u * slot + (uint)leaf] = mask;
    }
}
