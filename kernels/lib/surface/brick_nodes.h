// SPDX-License-Identifier: Apache-2.0
// The distances at a brick's nodes and around it, gathered from the bricks of a sparse grid.
#ifndef VXL_BRICK_NODES_H
#define VXL_BRICK_NODES_H

#include "shared/voxel.h"

#define VXL_BRICK_VOXELS 4096
#define VXL_SATURATED 32767

// A brick's nodes -1 .. 17 along each axis: those of its cells, and one more on each side for
// differences.
#define VXL_NODES 19
#define VXL_NODE_ROW VXL_NODES
#define VXL_NODE_LAYER (VXL_NODES * VXL_NODES)
#define VXL_NODE_COUNT (VXL_NODES * VXL_NODES * VXL_NODES)

static inline int4 brick_at(uint index, int4 bricks) {
    const int number = (int)index;
    return (int4)(number % bricks.x, number / bricks.x % bricks.y, number / (bricks.x * bricks.y),
                  0);
}

// The slot of brick `b`, or VXL_BRICK_*. The space outside the table is empty.
static inline uint brick_slot(global const uint* slots, int4 bricks, int4 b) {
    if (b.x < 0 || b.y < 0 || b.z < 0 || b.x >= bricks.x || b.y >= bricks.y || b.z >= bricks.z)
        return VXL_BRICK_OUTSIDE;
    return slots[b.x + bricks.x * (b.y + bricks.y * b.z)];
}

static inline bool brick_is_stored(uint slot) {
    return slot < VXL_BRICK_INSIDE;
}

// The index of node (x,y,z) of the brick, each in -1 .. 17, among the gathered nodes.
static inline int node_index(int x, int y, int z) {
    return x + 1 + (y + 1) * VXL_NODE_ROW + (z + 1) * VXL_NODE_LAYER;
}

// Copies the nodes that the brick's neighbour `d` (each component -1, 0 or 1) contributes. If this
// were inlined, compilers would unroll the loops around it: twenty-seven copies take longer to
// compile than the rest of a kernel (0.37 s instead of 0.23 s for mark_voxels).
static __attribute__((noinline)) void gather_neighbour(global const short* distance, uint slot,
                                                       int4 d, short* nodes) {
    const int4 first =
        (int4)(d.x < 0 ? -1 : 16 * d.x, d.y < 0 ? -1 : 16 * d.y, d.z < 0 ? -1 : 16 * d.z, 0);
    const int4 count = (int4)(d.x < 0    ? 1
                              : d.x == 0 ? 16
                                         : 2,
                              d.y < 0    ? 1
                              : d.y == 0 ? 16
                                         : 2,
                              d.z < 0    ? 1
                              : d.z == 0 ? 16
                                         : 2,
                              0);
    const bool stored = brick_is_stored(slot);
    const short missing = slot == VXL_BRICK_INSIDE ? -VXL_SATURATED : VXL_SATURATED;
    global const short* brick = distance + (stored ? (size_t)slot * VXL_BRICK_VOXELS : 0);
    for (int z = 0; z < count.z; ++z)
        for (int y = 0; y < count.y; ++y) {
            short* row = nodes + node_index(first.x, first.y + y, first.z + z);
            global const short* source =
                brick + (first.x & 15) + (((first.y + y) & 15) << 4) + (((first.z + z) & 15) << 8);
            if (count.x == 16)
                vstore16(stored ? vload16(0, source) : (short16)(missing), 0, row);
            else
                for (int x = 0; x < count.x; ++x) row[x] = stored ? source[x] : missing;
        }
}

// Fills the VXL_NODE_COUNT `nodes` of brick `b`. Nodes of bricks that are not stored are saturated.
static inline void gather_nodes(global const uint* slots, int4 bricks, global const short* distance,
                                int4 b, short* nodes) {
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const int4 d = (int4)(x, y, z, 0);
                gather_neighbour(distance, brick_slot(slots, bricks, b + d), d, nodes);
            }
}

#endif
