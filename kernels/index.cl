// SPDX-License-Identifier: Apache-2.0
// BrickGrid -> Pyramid: the voxels that a ray must see, and their data in the pyramid's order.
//
// There are two passes over the stored bricks, one brick a work-item: `mark_voxels` finds each
// brick's voxels and counts them, the host numbers them by prefix sums, and `write_voxels` fills
// the pyramid.
//
// Build constants: VXL_OCCUPANCY, VXL_SMOOTH, VXL_ATTRIBUTES, VXL_WRITE_ATTRIBUTES, VXL_COLORS,
// VXL_VOXEL_NORMALS, VXL_PRIMITIVES say which of the grid's buffers exist.
#include "lib/lanes/work_item.h"
#include "lib/surface/brick_field.h"
#include "lib/surface/brick_nodes.h"
#include "lib/voxelize/brick_grid.h"
#include "lib/voxelize/leaf_voxels.h"
#include "lib/voxelize/written_voxels.h"

// Moves the mask of one leaf of a brick to another slot. `moves` holds pairs of slots: from, to.
kernel void move_masks(const uint count, global const uint* restrict moves, global ulong* masks) {
    const uint item = work_item();
    if (item >= count) return;
    const uint2 slots = vload2(item >> 6, moves);
    masks[(size_t)slots.y * 64 + (item & 63u)] = masks[(size_t)slots.x * 64 + (item & 63u)];
}

// Marks one brick of those `listed`, or of all bricks if that is null: writes the masks of its
// voxels, the mask of its leaves, and its counts of voxels and primitives. Leaf masks and counts
// are in the list's order.
kernel void mark_voxels(const uint count, global const uint* restrict listed,
                        VXL_BRICK_GRID_PARAMETERS, global ulong* restrict masks,
                        global ulong* restrict leaf_masks, global uint* restrict counts) {
    const uint item = work_item();
    if (item >= count) return;
    const BrickGrid grid = VXL_BRICK_GRID;
    const uint slot = listed ? listed[item] : item;
    const int4 brick = brick_at(grid.coordinates[slot], grid.bricks);
    ulong kept[64];
    for (int leaf = 0; leaf < 64; ++leaf)
        kept[leaf] = VXL_OCCUPANCY ? grid.occupancy[(size_t)slot * 64 + leaf] : 0;
    if (VXL_SMOOTH) {
        short nodes[VXL_NODE_COUNT];
        gather_nodes(grid.slots, grid.bricks, grid.distance, brick, nodes);
        keep_smooth_cells(nodes, kept);
    }
    const int4 room = grid.size - brick * 16;
    const bool whole = room.x >= 16 && room.y >= 16 && room.z >= 16;
    ulong leaf_mask = 0;
    uint voxels = 0, primitives = 0;
    for (int leaf = 0; leaf < 64; ++leaf) {
        ulong mask = kept[leaf];
        if (!whole) mask &= mask_within(room - leaf_origin(leaf));
        masks[(size_t)slot * 64 + leaf] = mask;
        if (mask != 0) leaf_mask |= 1ul << leaf;
        voxels += (uint)popcount(mask);
        if (VXL_PRIMITIVES)
            for (; mask != 0; mask &= mask - 1) {
                const size_t voxel =
                    (size_t)slot * VXL_BRICK_VOXELS + voxel_in_brick(leaf, lowest_bit(mask));
                primitives += grid.primitive_first[voxel + 1] - grid.primitive_first[voxel];
            }
    }
    leaf_masks[item] = leaf_mask;
    vstore2((uint2)(voxels, primitives), item, counts);
}

// The packed attributes of a voxel in the pyramid. Their kind bits are kinds.x for voxels in the
// occupancy masks, and kinds.y for others.
static inline uint word_with_kind(const BrickGrid* grid, size_t voxel, bool smooth, uint2 kinds) {
    const uint packed = VXL_ATTRIBUTES ? grid->attributes[voxel] : grid->attribute;
    const uint without_kind = packed & (VXL_MATERIAL_MASK << VXL_MATERIAL_SHIFT | VXL_OBJECT_MASK);
    if (smooth) return without_kind | kinds.y;
    // The attributes of an occupied voxel already say whether it is exact.
    return VXL_ATTRIBUTES ? packed : without_kind | kinds.x;
}

// Writes the voxel at `index` of a brick of the grid to voxel `number` of the pyramid, and its
// primitives to number `primitive` and up. Returns the number after the last primitive.
static inline uint write_voxel(const BrickGrid* grid, uint slot, int index, bool smooth,
                               uint2 kinds, const short* nodes, uint number, uint primitive,
                               const WrittenVoxels* to) {
    const size_t voxel = (size_t)slot * VXL_BRICK_VOXELS + index;
    if (VXL_WRITE_ATTRIBUTES) to->attributes[number] = word_with_kind(grid, voxel, smooth, kinds);
    if (VXL_COLORS) to->colors[number] = grid->colors[voxel];
    if (VXL_VOXEL_NORMALS) to->normals[number] = grid->normals[voxel];
    if (VXL_SMOOTH) {
        const int4 cell = (int4)(index & 15, index >> 4 & 15, index >> 8, 0);
        vstore8(smooth ? field_record(nodes, cell) : (uint8)(0), number, to->fields);
    }
    if (VXL_PRIMITIVES) {
        to->primitive_first[number] = primitive;
        for (uint i = grid->primitive_first[voxel]; i < grid->primitive_first[voxel + 1]; ++i)
            to->primitives[primitive++] = grid->primitives[i];
    }
    return primitive;
}

// Writes the leaves and voxels of one brick. Their numbers begin at those in `starts` (first leaf,
// voxel and primitive of each slot). `kinds` holds the kind bits of voxels in the occupancy masks
// (x) and of others (y). The host writes the last voxel's end in `voxel_primitive_first`.
kernel void write_voxels(const uint count, const uint2 kinds, VXL_BRICK_GRID_PARAMETERS,
                         global const ulong* restrict masks, global const uint* restrict starts,
                         VXL_WRITTEN_PARAMETERS) {
    const uint slot = work_item();
    if (slot >= count) return;
    const BrickGrid grid = VXL_BRICK_GRID;
    const WrittenVoxels to = VXL_WRITTEN;
    const uint3 start = vload3(slot, starts);
    uint leaf_number = start.x, number = start.y, primitive = start.z;
    short nodes[VXL_SMOOTH ? VXL_NODE_COUNT : 1];
    bool gathered = false;
    for (int leaf = 0; leaf < 64; ++leaf) {
        ulong mask = masks[(size_t)slot * 64 + leaf];
        if (mask == 0) continue;
        write_leaf(&to, leaf_number++, mask, number);
        const ulong occupied = VXL_OCCUPANCY ? grid.occupancy[(size_t)slot * 64 + leaf] : 0;
        if (VXL_SMOOTH && !gathered) {
            gather_nodes(grid.slots, grid.bricks, grid.distance,
                         brick_at(grid.coordinates[slot], grid.bricks), nodes);
            gathered = true;
        }
        if (!(VXL_WRITE_ATTRIBUTES | VXL_COLORS | VXL_VOXEL_NORMALS | VXL_SMOOTH |
              VXL_PRIMITIVES)) {
            number += (uint)popcount(mask);
            continue;
        }
        for (; mask != 0; mask &= mask - 1, ++number) {
            const int bit = lowest_bit(mask);
            const bool smooth = VXL_SMOOTH && !(occupied >> bit & 1);
            primitive = write_voxel(&grid, slot, voxel_in_brick(leaf, bit), smooth, kinds, nodes,
                                    number, primitive, &to);
        }
    }
}
