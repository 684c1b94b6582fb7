// SPDX-License-Identifier: Apache-2.0
// A brick's nodes as tiles of VXL_LANES neighbours in x and y; one tile fills a vector.
//
// Compact tiles waste fewer lanes than rows of 16 on nodes that a small triangle does not concern.
#ifndef VXL_NODE_TILE_H
#define VXL_NODE_TILE_H

#include "lib/lanes/lanes.h"

#if VXL_LANES == 1
#define TILE_X 1
#define TILE_Y 1
#define TILE_LANE_X 0.0f
#define TILE_LANE_Y 0.0f
#else
#define TILE_X 4
#define TILE_Y (VXL_LANES / 4)
#define TILE_LANE_X LANES_FLOAT(LANES_NUMBERS & 3)
#define TILE_LANE_Y LANES_FLOAT(LANES_NUMBERS >> 2)
#endif
#define TILES_X (16 / TILE_X)
#define TILES_Y (16 / TILE_Y)

/// Writes a tile's values to 16-bit nodes of a slice, x fastest, 16 per row; `first` is the tile's
/// corner.
static inline void store_tile(lane_int values, global short* first) {
#if VXL_LANES == 1
    first[0] = (short)values;
#elif VXL_LANES == 4
    vstore4(convert_short4(values), 0, first);
#elif VXL_LANES == 8
    const short8 v = convert_short8(values);
    vstore4(v.lo, 0, first);
    vstore4(v.hi, 0, first + 16);
#else
    const short16 v = convert_short16(values);
    vstore4(v.s0123, 0, first);
    vstore4(v.s4567, 0, first + 16);
    vstore4(v.s89ab, 0, first + 32);
    vstore4(v.scdef, 0, first + 48);
#endif
}

/// Writes a tile's values to 32-bit nodes of a slice, in the order of store_tile.
static inline void store_tile_words(lane_uint values, global uint* first) {
#if VXL_LANES == 1
    first[0] = values;
#elif VXL_LANES == 4
    vstore4(values, 0, first);
#elif VXL_LANES == 8
    vstore4(values.lo, 0, first);
    vstore4(values.hi, 0, first + 16);
#else
    vstore4(values.s0123, 0, first);
    vstore4(values.s4567, 0, first + 16);
    vstore4(values.s89ab, 0, first + 32);
    vstore4(values.scdef, 0, first + 48);
#endif
}

/// The mask of a tile's nodes whose bits are set. Bit x of rows[y] is node (x, y); the tile's
/// corner is at (x, 0).
static inline lane_int tile_mask(const ushort* rows, int x) {
    uint bits = 0;
    for (int y = 0; y < TILE_Y; ++y)
        bits |= (((uint)rows[y] >> x) & ((1u << TILE_X) - 1u)) << (TILE_X * y);
#if VXL_LANES == 1
    return -(int)bits;
#else
    return LANE_MASK((((lane_int)((int)bits) >> LANES_NUMBERS) & 1) != 0);
#endif
}

#endif
