// SPDX-License-Identifier: Apache-2.0
// The world's stored bricks as a whole: they are cleared before objects are painted into them, and
// moved into the slots of removed bricks so that no gaps remain.
//
// Build constants: VXL_SMOOTH, VXL_OCCUPANCY, VXL_ATTRIBUTES, VXL_COLORS, VXL_VOXEL_NORMALS: the
// world has them.
#include "lib/lanes/work_item.h"
#include "lib/surface/brick_nodes.h"
#include "shared/normal.h"

// Clears one leaf's worth of a listed brick's values, 64 in their order.
kernel void clear_bricks(const uint count, global const uint* restrict listed,
                         global short* restrict distance, global ulong* restrict occupancy,
                         global uint* restrict attributes, global uint* restrict colors,
                         global uint* restrict normals) {
    const uint item = work_item();
    if (item >= count) return;
    const size_t part = ((size_t)listed[item >> 6] << 6) + (item & 63u);
    if (VXL_OCCUPANCY) occupancy[part] = 0;
    for (int i = 0; i < 4; ++i) {
        if (VXL_SMOOTH) vstore16((short16)(VXL_SATURATED), part * 4 + i, distance);
        if (VXL_ATTRIBUTES) vstore16((uint16)(0u), part * 4 + i, attributes);
        if (VXL_COLORS) vstore16((uint16)(0xFFFFFFu), part * 4 + i, colors);
        if (VXL_VOXEL_NORMALS) vstore16((uint16)(VXL_NO_NORMAL), part * 4 + i, normals);
    }
}

// Copies 64 voxels of a brick that moves. `moves` holds pairs of slots: from, to.
kernel void move_bricks(const uint count, global const uint* restrict moves,
                        global short* restrict distance, global ulong* restrict occupancy,
                        global uint* restrict attributes, global uint* restrict colors,
                        global uint* restrict normals) {
    const uint item = work_item();
    if (item >= count) return;
    const uint2 slots = vload2(item >> 6, moves);
    const uint in_brick = item & 63u;
    const size_t from = ((size_t)slots.x << 6) + in_brick, to = ((size_t)slots.y << 6) + in_brick;
    if (VXL_OCCUPANCY) occupancy[to] = occupancy[from];
    for (int i = 0; i < 4; ++i) {
        if (VXL_SMOOTH) vstore16(vload16(from * 4 + i, distance), to * 4 + i, distance);
        if (VXL_ATTRIBUTES) vstore16(vload16(from * 4 + i, attributes), to * 4 + i, attributes);
        if (VXL_COLORS) vstore16(vload16(from * 4 + i, colors), to * 4 + i, colors);
        if (VXL_VOXEL_NORMALS) vstore16(vload16(from * 4 + i, normals), to * 4 + i, normals);
    }
}
