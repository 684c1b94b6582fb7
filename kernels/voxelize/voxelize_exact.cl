// SPDX-License-Identifier: Apache-2.0
// triangles of each brick -> for each voxel the triangles that it lists, in ascending order.
//
// A voxel lists the triangles that its closed cube meets (SUPERCOVER), widened by VXL_MARGIN. Lists
// are counted, their starts are summed up, and then the lists are written.
#include "lib/voxelize/cover.h"

static inline uint voxel_index(int x, int y, int z) {
    return (uint)(x | y << 4 | z << 8);
}

/// Inserts `number` into a voxel's list of `count` ascending numbers.
static inline void insert_ascending(global uint* list, uint count, uint number) {
    uint at = count;
    for (; at > 0 && list[at - 1] > number; --at) list[at] = list[at - 1];
    list[at] = number;
}

/// Adds one triangle to the counts of a brick's voxels and, with `fill`, to their lists.
static inline void list_triangle(uint number, const LatticeTriangle* t, int3 last, uint* counts,
                                 bool fill, global const uint* starts, global uint* primitives) {
    const CoverBox box = cover_box(t, last);
    if (any(box.first > box.last)) return;
    Cover cover;
    prepare_cover(&cover, t, &box, false);
    for (int z = box.first.z; z <= box.last.z; ++z)
        for (int y = box.first.y; y <= box.last.y; ++y) {
            uint row = supercover_row(&cover, y, z);
            for (; row; row &= row - 1) {
                const uint v = voxel_index(31 - (int)clz(row & -row), y, z);
                if (fill) insert_ascending(primitives + starts[v], counts[v], number);
                ++counts[v];
            }
        }
}

/// One work-item takes one brick. It writes the number of triangles of each voxel, and the total.
kernel void count_brick_primitives(uint count, int4 size, int4 bricks, VXL_MESH_PARAMETERS,
                                   VXL_BINS_PARAMETERS, global uint* restrict counts,
                                   global uint* restrict totals) {
    const uint slot = work_item();
    if (slot >= count) return;
    const LatticeMesh mesh = VXL_MESH;
    const TriangleBins bins = VXL_BINS;
    const int3 brick = brick_of(bins.coordinates[slot], bricks);
    const int3 last = min(size.xyz - brick * 16, (int3)(16)) - 1;
    uint own[4096];
    for (int v = 0; v < 4096; ++v) own[v] = 0;
    for (uint i = bins.first[slot]; i < bins.first[slot + 1]; ++i) {
        const LatticeTriangle t = load_triangle(&mesh, bins.lists[i], brick * LATTICE_BRICK);
        list_triangle(bins.lists[i], &t, last, own, false, counts, counts);
    }
    uint total = 0;
    for (uint v = 0; v < 4096u; ++v) {
        counts[4096u * slot + v] = own[v];
        total += own[v];
    }
    totals[slot] = total;
}

/// One work-item takes one brick. It turns the counts into starts, beginning at the brick's start
/// in `bases`, and writes the lists.
kernel void list_primitives(uint count, int4 size, int4 bricks, VXL_MESH_PARAMETERS,
                            VXL_BINS_PARAMETERS, global const uint* restrict bases,
                            global uint* restrict starts, global uint* restrict primitives) {
    const uint slot = work_item();
    if (slot >= count) return;
    const LatticeMesh mesh = VXL_MESH;
    const TriangleBins bins = VXL_BINS;
    uint start = bases[slot];
    for (uint v = 0; v < 4096u; ++v) {
        const uint voxel_count = starts[4096u * slot + v];
        starts[4096u * slot + v] = start;
        start += voxel_count;
    }
    if (slot == count - 1u) starts[4096u * count] = start;
    const int3 brick = brick_of(bins.coordinates[slot], bricks);
    const int3 last = min(size.xyz - brick * 16, (int3)(16)) - 1;
    uint own[4096];
    for (int v = 0; v < 4096; ++v) own[v] = 0;
    for (uint i = bins.first[slot]; i < bins.first[slot + 1]; ++i) {
        const LatticeTriangle t = load_triangle(&mesh, bins.lists[i], brick * LATTICE_BRICK);
        list_triangle(bins.lists[i], &t, last, own, true, starts + 4096u * slot, primitives);
    }
}
