// SPDX-License-Identifier: Apache-2.0
// triangles of each brick -> its occupancy masks: SUPERCOVER or THIN (6-separating).
//
// The tests follow Schwarz and Seidel 2010 (projections of the triangle and its plane against the
// voxel) and Laine 2013 (crosshairs), in exact integers.
#include "lib/voxelize/cover.h"

#ifndef VXL_SLICES
#define VXL_SLICES 16
#endif
#ifndef VXL_THIN
#define VXL_THIN 0
#endif

/// Adds a row of voxels, bit x each, to the masks of the leaves that it crosses.
static inline void add_row(ulong* masks, uint row, int y, int z) {
    const int leaf = ((y >> 2) << 2) | ((z >> 2) << 4);
    const int shift = ((y & 3) << 2) | ((z & 3) << 4);
    for (int i = 0; i < 4; ++i) masks[leaf + i] |= (ulong)((row >> (4 * i)) & 15u) << shift;
}

/// One work-item takes VXL_SLICES slices of one brick, and gathers them over the brick's triangles.
///
/// `size` is the frame's, in voxels; voxels beyond it stay empty. The list of bin i spans
/// lists[first[i]] .. lists[first[i+1] - 1].
kernel void cover_bricks(uint count, int4 size, int4 bricks, VXL_MESH_PARAMETERS,
                         VXL_BINS_PARAMETERS, global ulong* restrict occupancy) {
    if (work_item() >= count * (16 / VXL_SLICES)) return;
    const LatticeMesh mesh = VXL_MESH;
    const TriangleBins bins = VXL_BINS;
    const uint slot = work_item() / (16 / VXL_SLICES);
    const int first_slice = (int)(work_item() % (16 / VXL_SLICES)) * VXL_SLICES;
    const int3 brick = brick_of(bins.coordinates[slot], bricks);
    const int3 last = min(size.xyz - brick * 16, (int3)(16)) - 1;
    ulong masks[4 * VXL_SLICES];
    for (int i = 0; i < 4 * VXL_SLICES; ++i) masks[i] = 0;
    for (uint i = bins.first[slot]; i < bins.first[slot + 1]; ++i) {
        const LatticeTriangle t = load_triangle(&mesh, bins.lists[i], brick * LATTICE_BRICK);
        CoverBox box = cover_box(&t, last);
        box.first.z = max(box.first.z, first_slice);
        box.last.z = min(box.last.z, first_slice + VXL_SLICES - 1);
        if (any(box.first > box.last)) continue;
        Cover cover;
        prepare_cover(&cover, &t, &box, VXL_THIN);
        for (int z = box.first.z; z <= box.last.z; ++z)
            for (int y = box.first.y; y <= box.last.y; ++y) {
                const uint row = VXL_THIN ? thin_row(&cover, y, z) : supercover_row(&cover, y, z);
                if (row) add_row(masks, row, y, z - first_slice);
            }
    }
    for (int i = 0; i < 4 * VXL_SLICES; ++i)
        occupancy[64u * slot + 4u * first_slice + i] = masks[i];
}
