// SPDX-License-Identifier: Apache-2.0
// Functions that read the occupancy pyramid (runtime/grid/grid.hpp describes its layout).
//
// A half of a 64-bit mask covers 4 x 4 x 2 children: bit x | y << 2 | (z & 1) << 4 of half z >> 1.
// With the lowest bits of x and y cleared from a bit's number, the pattern 0x00330033
//   ....0011 0011 0011 0011 (x 0-1, y 0-1, both z)
// shifted there covers the aligned group of 2 x 2 x 2 children around it.
#ifndef VXL_PYRAMID_H
#define VXL_PYRAMID_H

#include "lib/lanes/lanes.h"
#include "shared/scene.h"

#define VXL_GROUP_OF_EIGHT 0x00330033u
#define VXL_GROUP_CORNER 0x0Au

typedef struct {
    global const uint* restrict sectors;
    global const uint* restrict bricks;
    global const uint* restrict leaves;
    global const uint* restrict leaf_voxels;
    int size_x, size_y, size_z;  // voxels
    int sectors_x, sectors_y;
    float plane_bound;  // how far a computed crossing can lie from the true one, voxels
    float fixed_point;  // 2^fraction_bits: one voxel in the rays' fixed point
} PyramidView;

static inline PyramidView pyramid_view(PyramidShape shape, global const uint* restrict sectors,
                                       global const uint* restrict bricks,
                                       global const uint* restrict leaves,
                                       global const uint* restrict leaf_voxels) {
    PyramidView p = {sectors,           bricks,           leaves,
                     leaf_voxels,       shape.size_x,     shape.size_y,
                     shape.size_z,      shape.sectors_x,  shape.sectors_y,
                     shape.plane_bound, shape.fixed_point};
    return p;
}

/// A view of the grid alone, for walks that look nothing up.
static inline PyramidView grid_view(PyramidShape shape) {
    return pyramid_view(shape, 0, 0, 0, 0);
}

/// What the pyramid tells about a cell: the empty block around it, or the leaf that holds its
/// voxel.
typedef struct {
    lane_int occupied;   // mask: the cell's voxel is set
    lane_int log2_size;  // of the aligned empty block around the cell, if it isn't occupied
    lane_uint leaf;      // number of the cell's leaf, where occupied
} CellState;

/// The sector that each lane looked up last, which neighbouring cells usually share.
typedef struct {
    lane_int number;  // -1: none yet
    lane_uint entry;
} LastSector;

static inline LastSector no_sector(void) {
    const LastSector none = {(lane_int)-1, (lane_uint)0x80000000u};  // an empty sector
    return none;
}

/// The bit, within its half of the mask, of the child of size 1 << shift that holds the cell.
static inline lane_uint child_bit(lane_int x, lane_int y, lane_int z, int shift) {
    return LANES_AS_UINT(((x >> shift) & 3) | (((y >> shift) & 3) << 2) |
                         (((z >> shift) & 1) << 4));
}

static inline lane_int group_is_empty(lane_uint mask, lane_uint bit) {
    return LANE_MASK(((mask >> (bit & VXL_GROUP_CORNER)) & VXL_GROUP_OF_EIGHT) == 0u);
}

/// Mask: the cell's leaf holds voxels. Also writes the state of the cells whose leaf is empty, and
/// the numbers of the other cells' leaves. Lanes that are not `active` read something harmless.
static inline lane_int look_up_leaf(const PyramidView* p, lane_int x, lane_int y, lane_int z,
                                    lane_int active, LastSector* last, CellState* state) {
    const lane_int sector = ((z >> 6) * p->sectors_y + (y >> 6)) * p->sectors_x + (x >> 6);
    const lane_int changed = LANE_MASK(sector != last->number) & active;
    if (lanes_any(changed)) {  // rarely: the branch lets the next loads begin early
        last->number = LANES_SELECT(changed, sector, last->number);
        last->entry =
            LANES_SELECT(changed, LANES_GATHER_UINT(p->sectors, sector & changed), last->entry);
    }
    const lane_uint entry = last->entry;
    const lane_int stored = LANE_MASK(LANES_AS_INT(entry) >= 0);
    const lane_uint in_sector =
        LANES_AS_UINT(((x >> 4) & 3) | (((y >> 4) & 3) << 2) | (((z >> 4) & 3) << 4));
    const lane_uint record = ((entry << 8) | (in_sector << 2)) & LANES_AS_UINT(stored);
    const lane_uint upper = LANES_AS_UINT((z >> 3) & 1);
    const lane_uint mask = LANES_GATHER_UINT(p->bricks, record + upper) & LANES_AS_UINT(stored);
    const lane_uint bit = child_bit(x, y, z, 2);
    const lane_int has_leaf = LANE_MASK(((mask >> bit) & 1u) != 0u) & active;
    state->occupied = (lane_int)0;
    state->leaf = (lane_uint)0;
    state->log2_size = 2 - group_is_empty(mask, bit);

    const lane_uint own = LANES_GATHER_UINT(p->bricks, record + 2u + upper);
    const lane_int empty = LANES_AS_INT(LANES_SELECT(stored, own, entry));
    const lane_int skip = LANES_SELECT(LANE_MASK(empty < 0), empty & 0xFF, (lane_int)3);
    state->log2_size = LANES_SELECT(LANE_MASK(mask == 0u), skip, state->log2_size);
    if (lanes_any(has_leaf)) {
        const lane_uint below = lanes_popcount(mask & (((lane_uint)1u << bit) - 1u));
        state->leaf = (own + below) & LANES_AS_UINT(has_leaf);
    }
    return has_leaf;
}

/// The state of cell (x,y,z); lanes that are not `active` read something harmless.
static inline CellState look_up(const PyramidView* p, lane_int x, lane_int y, lane_int z,
                                lane_int active, LastSector* last) {
    CellState state;
    const lane_int has_leaf = look_up_leaf(p, x, y, z, active, last, &state);
    if (lanes_any(has_leaf)) {
        const lane_uint voxels =
            LANES_GATHER_UINT(p->leaves, state.leaf * 2u + LANES_AS_UINT((z >> 1) & 1));
        const lane_uint voxel = child_bit(x, y, z, 0);
        state.occupied = LANE_MASK(((voxels >> voxel) & 1u) != 0u) & has_leaf;
        state.log2_size = LANES_SELECT(has_leaf, -group_is_empty(voxels, voxel), state.log2_size);
    }
    return state;
}

/// The number of the voxel in an occupied cell of `leaf`.
static inline lane_uint voxel_number(const PyramidView* p, lane_uint leaf, lane_int x, lane_int y,
                                     lane_int z) {
    const lane_uint upper = LANES_AS_UINT((z >> 1) & 1);
    const lane_uint lower_mask = LANES_GATHER_UINT(p->leaves, leaf * 2u);
    const lane_uint mask = LANES_GATHER_UINT(p->leaves, leaf * 2u + upper);
    const lane_uint below = lanes_popcount(mask & (((lane_uint)1u << child_bit(x, y, z, 0)) - 1u)) +
                            (lanes_popcount(lower_mask) & (lane_uint)(0u - upper));
    return LANES_GATHER_UINT(p->leaf_voxels, leaf) + below;
}

#endif
