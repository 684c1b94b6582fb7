// SPDX-License-Identifier: Apache-2.0
// object grid, rest of space without solids -> object grid: the intersection of the two.
//
// `sources` name each brick of the result by its slots in the operands. An operand that doesn't
// store the brick is wholly inside or wholly outside there.
#include "lib/lanes/work_item.h"
#include "shared/normal.h"
#include "shared/voxel.h"

static inline int is_stored(uint slot) {
    return slot < VXL_BRICK_INSIDE;
}

static inline ulong mask_at(global const ulong* restrict occupancy, uint slot, uint leaf) {
    if (is_stored(slot)) return occupancy[64u * slot + leaf];
    return slot == VXL_BRICK_INSIDE ? ~0ul : 0ul;
}

/// One work-item takes one leaf of the result. It finds the voxels of each body's cover that are in
/// the other's cover or inside the other. `sources` holds the slots in body, body_inside, rest and
/// rest_inside.
kernel void join_covers(uint count, global const uint4* restrict sources,
                        global const ulong* restrict body, global const ulong* restrict body_inside,
                        global const ulong* restrict rest, global const ulong* restrict rest_inside,
                        global ulong* restrict occupancy) {
    const uint number = work_item();
    if (number >= 64u * count) return;
    const uint4 slots = sources[number >> 6];
    const uint leaf = number & 63u;
    const ulong a = mask_at(body, slots.x, leaf), b = mask_at(rest, slots.z, leaf);
    occupancy[number] = (a & (b | mask_at(rest_inside, slots.w, leaf))) |
                        (b & (a | mask_at(body_inside, slots.y, leaf)));
}

/// One work-item takes one brick. Its voxels get the body's normals or, where the body has none,
/// the normals of what the cuts leave. `sources` is as in join_covers.
kernel void join_normals(uint count, global const uint4* restrict sources,
                         global const uint* restrict body, global const uint* restrict rest,
                         global uint* restrict normals) {
    const uint brick = work_item();
    if (brick >= count) return;
    const uint4 slots = sources[brick];
    for (uint i = 0; i < 4096u; ++i) {
        uint code = is_stored(slots.x) ? body[4096u * (size_t)slots.x + i] : VXL_NO_NORMAL;
        if (code == VXL_NO_NORMAL && is_stored(slots.z)) code = rest[4096u * (size_t)slots.z + i];
        normals[4096u * (size_t)brick + i] = code;
    }
}

/// One work-item takes one brick. It copies the brick's words from its slot in `from`, or writes
/// `word` if the brick has no slot there.
kernel void keep_words(uint count, global const uint* restrict slots,
                       global const uint* restrict from, uint word, global uint* restrict words) {
    const uint brick = work_item();
    if (brick >= count) return;
    const uint slot = slots[brick];
    for (uint i = 0; i < 4096u; ++i)
        words[4096u * (size_t)brick + i] = is_stored(slot) ? from[4096u * (size_t)slot + i] : word;
}
