// SPDX-License-Identifier: Apache-2.0
// rays -> the cells and times of their discrete walks: `voxelume stress` compares these with exact
// arithmetic.
#include "lib/lanes/fixed_point.h"
#include "lib/lanes/work_item.h"
#include "lib/traverse/walk.h"
#include "shared/scene.h"
#include "shared/stress.h"

#ifndef VXL_BLOCKS
#define VXL_BLOCKS 0
#endif

static inline lane_uint mix_cell(lane_int x, lane_int y, lane_int z) {
    return LANES_AS_UINT(x) * VXL_HASH_X + LANES_AS_UINT(y) * VXL_HASH_Y +
           LANES_AS_UINT(z) * VXL_HASH_Z;
}

/// The log2 of the edge of the block around the walk's cell that is left in one step.
static inline lane_int block_log2(const Walk* w) {
    if (!VXL_BLOCKS) return (lane_int)0;
    const lane_uint mix = mix_cell(w->x >> 3, w->y >> 3, w->z >> 3) * VXL_HASH_FACTOR;
    return max(LANES_AS_INT(mix >> 28) - 9, 0);
}

/// Walks rays 0 .. count-1 through at most `maximum` cells each. Arrays hold a multiple of 16 rays.
///
/// Writes for each ray the number of cells entered, and a hash of the cells, axes and times in
/// order. With VXL_BLOCKS the walk leaves blocks of up to 64 cells in one step.
kernel void digest_walks(PyramidShape shape, global const float* restrict rays, uint count,
                         uint stride, uint maximum, global uint* restrict digests) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const PyramidView grid = grid_view(shape);
    Walk w = load_walk(rays, stride, first);
    lane_uint cells = (lane_uint)0, hash = (lane_uint)0;
    lane_int walking = in_grid(&grid, &w);
    while (lanes_any(walking)) {
        const lane_uint cell_hash = mix_cell(w.x, w.y, w.z) + LANES_AS_UINT(w.axis);
        const lane_uint mixed = ((hash ^ LANES_AS_UINT(w.t)) + cell_hash) * VXL_HASH_FACTOR;
        hash = LANES_SELECT(walking, mixed, hash);
        cells -= LANES_AS_UINT(walking);
        walking &= LANE_MASK(cells < maximum);
        advance(&grid, &w, block_log2(&w), walking);
        walking &= in_grid(&grid, &w);
    }
    LANES_STORE(cells, digests, first);
    LANES_STORE(hash, digests, stride + first);
}

/// Lists the cells themselves: `maximum` slots of x, y, z, axis and t, `stride` values apart. Slots
/// that a walk doesn't reach keep their contents.
kernel void list_walks(PyramidShape shape, global const float* restrict rays, uint count,
                       uint stride, uint maximum, global int* restrict lists) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const PyramidView grid = grid_view(shape);
    Walk w = load_walk(rays, stride, first);
    lane_int walking = in_grid(&grid, &w);
    for (uint i = 0; i < maximum && lanes_any(walking); ++i) {
        const uint at = 5u * i * stride + first;
        LANES_STORE(LANES_SELECT(walking, w.x, (lane_int)-1), lists, at);
        LANES_STORE(w.y, lists, at + stride);
        LANES_STORE(w.z, lists, at + 2u * stride);
        LANES_STORE(w.axis, lists, at + 3u * stride);
        LANES_STORE(LANES_AS_INT(w.t), lists, at + 4u * stride);
        advance(&grid, &w, block_log2(&w), walking);
        walking &= in_grid(&grid, &w);
    }
}

/// Snaps rays of any origin and length to fixed point, as is done for sight rays. The snapped rays
/// begin where they enter the grid. Rays that miss the grid get t_end = -1. `snapped` must not be
/// `rays`.
kernel void snap_rays(PyramidShape shape, global const float* restrict rays, uint count,
                      uint stride, global float* restrict snapped) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    lane_float d[3], o[3];
    for (int a = 0; a < 3; ++a) {
        o[a] = LANES_LOAD(rays, (uint)(VXL_RAY_OX + a) * stride + first);
        d[a] = LANES_LOAD(rays, (uint)(VXL_RAY_DX + a) * stride + first);
    }
    const lane_float scale = power_of_two_scale(d[0], d[1], d[2]);
    const float size[3] = {(float)shape.size_x, (float)shape.size_y, (float)shape.size_z};
    lane_float t_first = (lane_float)0.0f, t_last = (lane_float)INFINITY;
    for (int a = 0; a < 3; ++a) {
        d[a] = snap_direction(d[a] * scale);
        clip_axis(o[a], d[a], size[a], &t_first, &t_last);
    }
    const lane_int seen = LANE_MASK(t_first <= t_last);
    t_first = LANES_SELECT(seen, t_first, (lane_float)0.0f);
    for (int a = 0; a < 3; ++a) {
        LANES_STORE(d[a], snapped, (uint)(VXL_RAY_DX + a) * stride + first);
        // start_coordinate takes one rounded part of the origin for all lanes. It is 0 here, so the
        // rest is the lane's whole origin.
        const lane_float at = start_coordinate(0.0f, o[a], d[a], size[a], t_first);
        LANES_STORE(snap_position(at, (lane_float)0.0f, shape.fixed_point), snapped,
                    (uint)(VXL_RAY_OX + a) * stride + first);
    }
    const lane_float t_end = LANES_SELECT(seen, (lane_float)INFINITY, (lane_float)-1.0f);
    LANES_STORE(t_end, snapped, VXL_RAY_END * stride + first);
}
