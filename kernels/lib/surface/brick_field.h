// SPDX-License-Identifier: Apache-2.0
// The cells of a brick's distance field whose half-Taylor interpolant can be 0, and their records.
// The functions work on nodes gathered by lib/surface/brick_nodes.h.
#ifndef VXL_BRICK_FIELD_H
#define VXL_BRICK_FIELD_H

#include "lib/surface/brick_nodes.h"

// A cell is kept when min f - m <= 0 <= max f + m, with m = 129/128 1/8 Σ_a max|D_a| + 1 over the
// three axes and each axis' four edges. This test misses no zero of the interpolant F in voxel.h:
//   min f <= Σ w_i f_i <= max f, since the weights are positive and sum to 1; ½ x(1-x) <= 1/8 on
//   [0,1]; |Σ w_yz D_x| <= max|D_x|; so |F - Σ w_i f_i| <= 1/8 Σ_a max|D_a|.
// Records hold D to within |D|/128 + 1/2, or a smaller value; the 1 in m covers three eighths of
// that half unit, and the rounding of F.

// The minimum and maximum of vectors of shorts. PoCL's min, max and abs_diff for these work lane by
// lane (107 against 39 ms of CPU time for the bunny at 512 voxels).
#define SMALLER(a, b) ((a) < (b) ? (a) : (b))
#define LARGER(a, b) ((a) > (b) ? (a) : (b))

// Twice D of the edge from `node` to node[step]; 0 where one of its nodes is saturated.
static inline int twice_curvature(const short* node, int step) {
    const int before = node[-step], first = node[0], second = node[step], after = node[2 * step];
    const int high = max(max(before, first), max(second, after));
    const int low = min(min(before, first), min(second, after));
    const bool saturated = high >= VXL_SATURATED || low <= -VXL_SATURATED;
    return saturated ? 0 : second - before - after + first;
}

// |2D| of sixteen neighbouring edges.
static inline int16 curvature_sizes(const short* node, int step) {
    const int16 before = convert_int16(vload16(0, node - step));
    const int16 first = convert_int16(vload16(0, node));
    const int16 second = convert_int16(vload16(0, node + step));
    const int16 after = convert_int16(vload16(0, node + 2 * step));
    const int16 high = LARGER(LARGER(before, first), LARGER(second, after));
    const int16 low = SMALLER(SMALLER(before, first), SMALLER(second, after));
    const int16 saturated = high >= VXL_SATURATED | low <= -VXL_SATURATED;
    const int16 twice = second - before - after + first;
    return LARGER(twice, -twice) & ~saturated;
}

// The largest |2D| of each cell's four edges along the axis of `step`, across the other two.
static inline int16 largest_of_edges(const short* node, int step, int across, int over) {
    return max(
        max(curvature_sizes(node, step), curvature_sizes(node + across, step)),
        max(curvature_sizes(node + over, step), curvature_sizes(node + across + over, step)));
}

static inline bool any_lane(short16 mask) {
    const ulong4 words = as_ulong4(mask);
    return (words.x | words.y | words.z | words.w) != 0;
}

static inline uint lanes_to_bits(int16 mask) {
    const int16 bits =
        mask & (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
    const int8 eight = bits.lo | bits.hi;
    const int4 four = eight.lo | eight.hi;
    return (uint)(four.x | four.y | four.z | four.w);
}

static inline ushort largest_lane(ushort16 values) {
    const ushort8 eight = max(values.lo, values.hi);
    const ushort4 four = max(eight.lo, eight.hi);
    return max(max(four.x, four.y), max(four.z, four.w));
}

static inline ushort16 larger_step(ushort16 largest, short16 a, short16 b) {
    const ushort16 step = as_ushort16(LARGER(a, b) - SMALLER(a, b));
    return LARGER(largest, step);
}

// The largest difference of two neighbouring nodes, over all gathered nodes.
static inline int largest_step(const short* nodes) {
    ushort16 largest = 0;
    // Without this, compilers for GPUs would unroll the loop 361 times.
#pragma unroll 1
    for (int z = 0; z < VXL_NODES; ++z)
#pragma unroll 1
        for (int y = 0; y < VXL_NODES; ++y) {
            const short* row = nodes + y * VXL_NODE_ROW + z * VXL_NODE_LAYER;
            for (int x = 0; x <= 3; x += 3) {  // two overlapping vectors of sixteen cover nineteen
                const short16 here = vload16(0, row + x);
                if (y + 1 < VXL_NODES)
                    largest = larger_step(largest, here, vload16(0, row + x + VXL_NODE_ROW));
                if (z + 1 < VXL_NODES)
                    largest = larger_step(largest, here, vload16(0, row + x + VXL_NODE_LAYER));
            }
            largest = larger_step(largest, vload16(0, row), vload16(0, row + 1));
            largest = larger_step(largest, vload16(0, row + 2), vload16(0, row + 3));
        }
    return (int)largest_lane(largest);
}

// The bits of the cells to keep, among the sixteen along x from the one at `node`. `reach` bounds m
// in the brick.
static inline uint keep_row(const short* node, short reach) {
    short16 low = VXL_SATURATED, high = -VXL_SATURATED;
    for (int corner = 0; corner < 8; ++corner) {
        const short16 f = vload16(0, node + (corner & 1) + (corner >> 1 & 1) * VXL_NODE_ROW +
                                         (corner >> 2) * VXL_NODE_LAYER);
        low = SMALLER(low, f);
        high = LARGER(high, f);
    }
    if (!any_lane(low <= reach & high >= (short)(-reach))) return 0;
    short16 nearest = VXL_SATURATED;
    for (int corner = 0; corner < 8; ++corner) {
        const short16 f = vload16(0, node + (corner & 1) + (corner >> 1 & 1) * VXL_NODE_ROW +
                                         (corner >> 2) * VXL_NODE_LAYER);
        const short16 size = LARGER(f, -f);
        nearest = SMALLER(nearest, size);
    }
    const int16 x = largest_of_edges(node, 1, VXL_NODE_ROW, VXL_NODE_LAYER);
    const int16 y = largest_of_edges(node, VXL_NODE_ROW, 1, VXL_NODE_LAYER);
    const int16 z = largest_of_edges(node, VXL_NODE_LAYER, 1, VXL_NODE_ROW);
    const int16 twice = x + y + z;
    const int16 reach16 = twice + (twice >> 7) + 16;  // 16 m, less than 1 too small
    const int16 kept = convert_int16(low) * 16 <= reach16 & convert_int16(high) * 16 >= -reach16 &
                       convert_int16(nearest) < VXL_SATURATED;
    return lanes_to_bits(kept);
}

// Adds the cells that the interpolant can cross to the 64 leaf masks.
static inline void keep_smooth_cells(const short* nodes, ulong* kept) {
    // |2D| is at most two steps, so m - 1 is at most 3/8 of 129/128 of the largest step.
    const short reach = (short)(largest_step(nodes) * 97 / 256 + 2);
#pragma unroll 1
    for (int z = 0; z < 16; ++z)
#pragma unroll 1
        for (int y = 0; y < 16; ++y) {
            const ulong bits = keep_row(nodes + node_index(0, y, z), reach);
            if (bits == 0) continue;
            const int leaf = (y & 12) | (z & 12) << 2;
            const int shift = (y & 3) << 2 | (z & 3) << 4;
            for (int x = 0; x < 4; ++x) kept[leaf | x] |= (bits >> 4 * x & 15) << shift;
        }
}

// Encodes an edge's curvature in ten bits as in shared/voxel.h, from twice D. Rounds to the nearest
// code, ties to even.
static inline uint curvature_bits(int twice) {
    const int shifted = abs(twice) + 128;  // 2 (|D| + 64), at least 2^7
    const int shift = 25 - clz(shifted);   // e + 1
    const int floored = shifted >> shift, rest = shifted & ((1 << shift) - 1);
    const int middle = 1 << (shift - 1);
    const int rounded = floored + (rest > middle || (rest == middle && (floored & 1)));
    const uint code = (uint)((shift - 1) * 64 + rounded - 64);
    return min(code, 511u) | (twice < 0 ? 512u : 0u);
}

// The eight words of a cell as shared/voxel.h describes them.
static inline uint8 field_record(const short* nodes, int4 cell) {
    const short* node = nodes + node_index(cell.x, cell.y, cell.z);
    uint words[8];
    for (int i = 0; i < 4; ++i) {
        const int low = i & 1, high = i >> 1;
        const short* pair = node + low * VXL_NODE_ROW + high * VXL_NODE_LAYER;
        words[i] = (uint)(ushort)pair[0] | (uint)(ushort)pair[1] << 16;
        const int x = twice_curvature(pair, 1);
        const int y = twice_curvature(node + low + high * VXL_NODE_LAYER, VXL_NODE_ROW);
        const int z = twice_curvature(node + low + high * VXL_NODE_ROW, VXL_NODE_LAYER);
        words[4 + i] = curvature_bits(x) | curvature_bits(y) << 10 | curvature_bits(z) << 20;
    }
    return vload8(0, words);
}

#endif
