// SPDX-License-Identifier: Apache-2.0
// A distance field interpolated between its nodes, from a block of nodes gathered for a few
// neighbours.
#ifndef VXL_PLACED_FIELD_H
#define VXL_PLACED_FIELD_H

#include "lib/surface/brick_field.h"
#include "lib/voxelize/placed.h"

// A block of an object's nodes. Its first x is a multiple of four, so four neighbours along x are
// always in one brick.
#define VXL_BLOCK_ROW 16
#define VXL_BLOCK_ROWS 12
#define VXL_BLOCK_LAYER (VXL_BLOCK_ROW * VXL_BLOCK_ROWS)
#define VXL_BLOCK_NODES (VXL_BLOCK_LAYER * VXL_BLOCK_ROWS)

// The nodes that interpolation anywhere in the box's cells reads.
static inline CellBox nodes_of_cells(CellBox cells) {
    CellBox nodes = {cells.first - 1, cells.last + 2};
    nodes.first.x &= ~3;
    return nodes;
}

static inline bool fits_block(CellBox nodes) {
    const int4 size = nodes.last - nodes.first + 1;
    return size.x <= VXL_BLOCK_ROW && size.y <= VXL_BLOCK_ROWS && size.z <= VXL_BLOCK_ROWS;
}

static inline void gather_block(const PlacedObject* object, global const short* distance,
                                CellBox nodes, short* block) {
    for (int x = nodes.first.x; x <= nodes.last.x; x += 4)
        for (int z = nodes.first.z; z <= nodes.last.z; ++z) {
            uint slot = VXL_BRICK_OUTSIDE;
            for (int y = nodes.first.y; y <= nodes.last.y; ++y) {
                if (y == nodes.first.y || (y & 15) == 0)
                    slot = brick_slot(object->slots, object->bricks, (int4)(x, y, z, 0) >> 4);
                short4 four = (short)(slot == VXL_BRICK_INSIDE ? -VXL_SATURATED : VXL_SATURATED);
                if (brick_is_stored(slot))
                    four = vload4(0, distance + (size_t)slot * VXL_BRICK_VOXELS + (x & 15) +
                                         ((y & 15) << 4) + ((z & 15) << 8));
                vstore4(four, 0,
                        block + (x - nodes.first.x) + (y - nodes.first.y) * VXL_BLOCK_ROW +
                            (z - nodes.first.z) * VXL_BLOCK_LAYER);
            }
        }
}

// Twice D of four edges, from their nodes -1, 0, 1, 2; 0 where a node is saturated.
static inline float4 twice_curvatures(int4 before, int4 first, int4 second, int4 after) {
    const int4 high = LARGER(LARGER(before, first), LARGER(second, after));
    const int4 low = SMALLER(SMALLER(before, first), SMALLER(second, after));
    const int4 saturated = high >= VXL_SATURATED | low <= -VXL_SATURATED;
    return convert_float4((second - before - after + first) & ~saturated);
}

// Interpolates four values at the corners 00, 10, 01, 11 of a square.
static inline float between(float4 corners, float x, float y) {
    const float2 row = fma((float2)(x), corners.odd - corners.even, corners.even);
    return fma(y, row.y - row.x, row.x);
}

// A first-order expansion from the unsaturated corner with the largest weight, for a cell at the
// end of the band. A point on a saturated corner, or in a cell without unsaturated corners, is
// saturated.
static inline float extrapolate(const short* node, float4 s) {
    const int4 step = (int4)(1, VXL_BLOCK_ROW, VXL_BLOCK_LAYER, 0);
    float best_weight = 0.0f, best = node[0] < 0 ? -VXL_SATURATED : VXL_SATURATED;
    for (int corner = 0; corner < 8; ++corner) {
        const int4 at = (int4)(corner & 1, corner >> 1 & 1, corner >> 2, 0);
        const short* n = node + at.x + at.y * step.y + at.z * step.z;
        const float4 offset = s - convert_float4(at);
        const float weight =
            (1.0f - fabs(offset.x)) * (1.0f - fabs(offset.y)) * (1.0f - fabs(offset.z));
        if (weight <= best_weight) continue;
        if (n[0] >= VXL_SATURATED || n[0] <= -VXL_SATURATED) {
            if (weight == 1.0f) return n[0];
            continue;
        }
        best_weight = weight;
        best = n[0];
        for (int axis = 0; axis < 3; ++axis) {
            const int a = axis == 0 ? step.x : axis == 1 ? step.y : step.z;
            const float along = axis == 0 ? offset.x : axis == 1 ? offset.y : offset.z;
            const bool has_before = n[-a] < VXL_SATURATED && n[-a] > -VXL_SATURATED;
            const bool has_after = n[a] < VXL_SATURATED && n[a] > -VXL_SATURATED;
            const float differences =
                (has_before ? n[0] - n[-a] : 0) + (has_after ? n[a] - n[0] : 0);
            best = fma(along, has_before && has_after ? 0.5f * differences : differences, best);
        }
    }
    return best;
}

// The half-Taylor interpolant (shared/voxel.h) of the cell whose first corner is `node`, at s.
static inline float interpolate(const short* node, float4 s) {
    const short4 a00 = vload4(0, node - 1);
    const short4 a10 = vload4(0, node - 1 + VXL_BLOCK_ROW);
    const short4 a01 = vload4(0, node - 1 + VXL_BLOCK_LAYER);
    const short4 a11 = vload4(0, node - 1 + VXL_BLOCK_ROW + VXL_BLOCK_LAYER);
    const int4 x0 = (int4)(a00.y, a10.y, a01.y, a11.y), x1 = (int4)(a00.z, a10.z, a01.z, a11.z);
    const int4 high = LARGER(x0, x1), low = SMALLER(x0, x1);
    const int2 high2 = LARGER(high.lo, high.hi), low2 = SMALLER(low.lo, low.hi);
    const int highest = max(high2.x, high2.y), lowest = min(low2.x, low2.y);
    if (lowest >= VXL_SATURATED || highest <= -VXL_SATURATED) return lowest;  // beyond the band
    if (highest >= VXL_SATURATED || lowest <= -VXL_SATURATED) return extrapolate(node, s);
    const float4 twice_x = twice_curvatures((int4)(a00.x, a10.x, a01.x, a11.x), x0, x1,
                                            (int4)(a00.w, a10.w, a01.w, a11.w));
    // The edges along y are at (x,z), those along z at (x,y), both in the order 00, 10, 01, 11.
    const int4 y0 = convert_int4((short4)(a00.yz, a01.yz)),
               y1 = convert_int4((short4)(a10.yz, a11.yz));
    const float4 twice_y = twice_curvatures(
        convert_int4((short4)(vload2(0, node - VXL_BLOCK_ROW),
                              vload2(0, node - VXL_BLOCK_ROW + VXL_BLOCK_LAYER))),
        y0, y1,
        convert_int4((short4)(vload2(0, node + 2 * VXL_BLOCK_ROW),
                              vload2(0, node + 2 * VXL_BLOCK_ROW + VXL_BLOCK_LAYER))));
    const int4 z0 = convert_int4((short4)(a00.yz, a10.yz)),
               z1 = convert_int4((short4)(a01.yz, a11.yz));
    const float4 twice_z = twice_curvatures(
        convert_int4((short4)(vload2(0, node - VXL_BLOCK_LAYER),
                              vload2(0, node - VXL_BLOCK_LAYER + VXL_BLOCK_ROW))),
        z0, z1,
        convert_int4((short4)(vload2(0, node + 2 * VXL_BLOCK_LAYER),
                              vload2(0, node + 2 * VXL_BLOCK_LAYER + VXL_BLOCK_ROW))));
    const float linear =
        fma(s.z, between(convert_float4(z1), s.x, s.y) - between(convert_float4(z0), s.x, s.y),
            between(convert_float4(z0), s.x, s.y));
    const float4 bend = 0.25f * s * (1.0f - s);  // half of ½ s(1-s), for twice D
    return fma(
        bend.x, between(twice_x, s.y, s.z),
        fma(bend.y, between(twice_y, s.x, s.z), fma(bend.z, between(twice_z, s.x, s.y), linear)));
}

// The position of a fixed-point coordinate in its cell, 0 <= s < 1, truncated to 24 bits.
static inline float fraction_of(long coordinate, int fraction_bits) {
    const uint bits = (uint)(coordinate >> (fraction_bits - 24)) & 0xFFFFFFu;
    return convert_float(bits) * 0x1p-24f;
}

// The distance at p, which lies in a cell of the gathered block, in the object's units.
static inline float distance_at(const PlacedObject* object, const short* block, int4 first,
                                FixedPoint p) {
    const int bits = object->fraction_bits;
    const int4 cell = cell_at(p, bits) - first;
    const float4 s =
        (float4)(fraction_of(p.x, bits), fraction_of(p.y, bits), fraction_of(p.z, bits), 0.0f);
    return interpolate(block + cell.x + cell.y * VXL_BLOCK_ROW + cell.z * VXL_BLOCK_LAYER, s);
}

static inline short stored_distance(float value) {
    return convert_short(convert_int_rte(clamp(value, -32767.0f, 32767.0f)));
}

#endif
