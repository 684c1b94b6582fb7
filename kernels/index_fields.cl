// SPDX-License-Identifier: Apache-2.0
// distance fields of several objects, and voxels among them -> Pyramid.
//
// Each smooth object has a grid of its own in the world's lattice, and `mark_voxels` (index.cl) has
// found the voxels that its surface may cross. The kernels here unite these grids brick by brick: a
// voxel with one field has its record, and a voxel with several fields lists records behind the
// voxels' own (shared/voxel.h).
//
// Build constants: VXL_BASE: there are cubes or exact voxels, too. VXL_BASE_ATTRIBUTES,
// VXL_PRIMITIVES: those voxels have attributes of their own, primitives. VXL_COLORS: the world has
// colours. VXL_VOXEL_NORMALS: its cubes have normals. VXL_ATTRIBUTES, VXL_OWN_COLORS: the object
// whose fields are written has them. VXL_LINKED: the preceding field may belong to the same object.
#include "lib/lanes/work_item.h"
#include "lib/surface/brick_field.h"
#include "lib/surface/brick_nodes.h"
#include "lib/surface/field_brackets.h"
#include "lib/voxelize/brick_grid.h"
#include "lib/voxelize/chain_parts.h"
#include "lib/voxelize/leaf_voxels.h"
#include "lib/voxelize/written_voxels.h"

// The fields in the world's bricks that hold any voxels. Entries first[b] .. first[b + 1] - 1 are
// the fields in brick b, in the order of priorities. An entry is the number of an object's brick
// among all objects' bricks (x), the object's rank (y), and the brackets that the field stands in
// (z, shared/field_place.h). `masks` holds the masks of each field's leaves. The other masks are of
// the world's bricks: of all voxels, and of those that list fields.
#define VXL_UNITED_PARAMETERS                                                     \
    global const uint *restrict entry_first, global const uint *restrict entries, \
        global ulong *restrict masks, global ulong *restrict united,              \
        global ulong *restrict listing

// Copies the masks of one object's leaves behind the masks of the objects before it.
kernel void append_masks(const uint count, const uint first, global const ulong* restrict from,
                         global ulong* restrict to) {
    const uint item = work_item();
    if (item < count) to[(size_t)first * 64 + item] = from[item];
}

// One work-item takes one brick of a part of a solid, number `first` + its slot among all fields'
// bricks. It writes the masks of the cells that lie inside the part.
kernel void mark_inside(const uint count, const uint first, global const short* restrict distance,
                        global const ulong* restrict masks, global ulong* restrict inside) {
    const uint slot = work_item();
    if (slot >= count) return;
    for (int leaf = 0; leaf < 64; ++leaf) {
        ulong mask = 0;
        for (int bit = 0; bit < 64; ++bit)
            if (distance[(size_t)slot * VXL_BRICK_VOXELS + voxel_in_brick(leaf, bit)] < 0)
                mask |= 1ul << bit;
        const size_t at = (size_t)(first + slot) * 64 + leaf;
        inside[at] = mask & ~masks[at];
    }
}

// One work-item takes one brick of a solid. It removes from the parts' masks the cells in which a
// part's surface is not the solid's, because another part decides there. Entries chain_first[b] ..
// chain_first[b + 1] - 1 are the parts in brick b, in their order: the number of a part's brick
// among all fields' bricks, or that it has none (x), the brackets that it stands in (y), and the
// links of these and its own (z, shared/field_place.h).
kernel void join_parts(const uint count, global const uint* restrict chain_first,
                       global const uint* restrict chain, global const ulong* restrict inside,
                       global ulong* masks) {
    const uint item = work_item();
    if (item >= count) return;
    const uint begin = chain_first[item], end = chain_first[item + 1];
    for (int leaf = 0; leaf < 64; ++leaf) {
        const ChainParts parts = {chain, masks, leaf};
        Joined open[VXL_MAX_BRACKETS + 1] = {{0, 0, begin, 0}};
        int depth = 0;
        uint path = 0;
        for (uint e = begin; e < end; ++e) {
            const uint own = chain[3 * e], links = chain[3 * e + 2];
            const int shared = e > begin ? shared_brackets(path, chain[3 * e + 1]) : 0;
            for (; depth > shared; --depth) join(&parts, &open[depth - 1], &open[depth], e);
            path = chain[3 * e + 1];
            uint link = e > begin ? links >> VXL_LINK_BITS * shared & 3u : 0;
            for (; depth < bracket_depth(path); link = 0) open[++depth] = (Joined){0, 0, e, link};
            const size_t at = (size_t)own * 64 + leaf;
            Joined part = {own == VXL_BRICK_INSIDE ? ~0ul : 0, 0, e, link};
            if (brick_is_stored(own)) part = (Joined){inside[at], masks[at], e, link};
            join(&parts, &open[depth], &part, e + 1);
        }
        for (; depth > 0; --depth) join(&parts, &open[depth - 1], &open[depth], end);
    }
}

// The packed attributes of a voxel in the base grid, which holds cubes and exact voxels.
static inline uint base_attributes(const BrickGrid* grid, size_t voxel) {
    return VXL_BASE_ATTRIBUTES ? grid->attributes[voxel] : grid->attribute;
}

// Decides which of the voxels that hold `both` cubes and fields stay cubes alone: those whose cube
// comes before the fields in the order of priorities. Returns these voxels, and clears them in the
// fields' masks.
static inline ulong settle_cubes(const BrickGrid* grid, uint slot, int leaf, ulong both,
                                 global const uint* restrict ranks, uint begin, uint end,
                                 global const uint* restrict entries, global ulong* masks) {
    ulong stay = 0;
    for (; both != 0; both &= both - 1) {
        const int bit = lowest_bit(both);
        const uint packed =
            base_attributes(grid, (size_t)slot * VXL_BRICK_VOXELS + voxel_in_brick(leaf, bit));
        if (packed >> VXL_KIND_SHIFT != VXL_KIND_CUBES) continue;
        uint first = 0xFFFFFFFFu;
        for (uint e = begin; e < end && first == 0xFFFFFFFFu; ++e)
            if (masks[(size_t)entries[3 * e] * 64 + leaf] >> bit & 1) first = entries[3 * e + 1];
        if (ranks[packed & VXL_OBJECT_MASK] < first) stay |= 1ul << bit;
    }
    for (uint e = begin; stay != 0 && e < end; ++e)
        masks[(size_t)entries[3 * e] * 64 + leaf] &= ~stay;
    return stay;
}

// One work-item takes one brick of the world. It writes the masks of its voxels, of those that list
// fields, and of those whose attributes are the base grid's; the mask of its leaves; and its counts
// of voxels, primitives and listed fields. `base_slots` holds the brick's slot in the base grid, or
// VXL_BRICK_OUTSIDE.
kernel void unite_marks(const uint count, VXL_BRICK_GRID_PARAMETERS,
                        global const uint* restrict brick_numbers,
                        global const uint* restrict base_slots, global const uint* restrict ranks,
                        VXL_UNITED_PARAMETERS, global ulong* restrict of_base,
                        global ulong* restrict leaf_masks, global uint* restrict counts) {
    const uint item = work_item();
    if (item >= count) return;
    const BrickGrid grid = VXL_BRICK_GRID;
    const uint slot = VXL_BASE ? base_slots[item] : VXL_BRICK_OUTSIDE;
    const bool has_base = VXL_BASE && brick_is_stored(slot);
    const int4 room = grid.size - brick_at(brick_numbers[item], grid.bricks) * 16;
    const uint begin = entry_first[item], end = entry_first[item + 1];
    ulong leaf_mask = 0;
    uint voxels = 0, primitives = 0, fields = 0;
    for (int leaf = 0; leaf < 64; ++leaf) {
        ulong some = 0, several = 0;
        for (uint e = begin; e < end; ++e) {
            const ulong mask = masks[(size_t)entries[3 * e] * 64 + leaf];
            several |= some & mask;
            some |= mask;
        }
        ulong base = 0;
        if (has_base) {
            base = grid.occupancy[(size_t)slot * 64 + leaf] & mask_within(room - leaf_origin(leaf));
            const ulong stay =
                settle_cubes(&grid, slot, leaf, base & some, ranks, begin, end, entries, masks);
            some &= ~stay, several &= ~stay;
            several |= base & some;
        }
        const ulong all = some | base;
        united[(size_t)item * 64 + leaf] = all;
        listing[(size_t)item * 64 + leaf] = several;
        if (VXL_BASE) of_base[(size_t)item * 64 + leaf] = base;
        if (all != 0) leaf_mask |= 1ul << leaf;
        voxels += (uint)popcount(all);
        for (uint e = begin; several != 0 && e < end; ++e)
            fields += (uint)popcount(masks[(size_t)entries[3 * e] * 64 + leaf] & several);
        if (VXL_PRIMITIVES && has_base)
            for (; base != 0; base &= base - 1) {
                const size_t voxel =
                    (size_t)slot * VXL_BRICK_VOXELS + voxel_in_brick(leaf, lowest_bit(base));
                primitives += grid.primitive_first[voxel + 1] - grid.primitive_first[voxel];
            }
    }
    leaf_masks[item] = leaf_mask;
    counts[3 * item] = voxels;
    counts[3 * item + 1] = primitives;
    counts[3 * item + 2] = fields;
}

// One work-item takes one brick of the world. It writes the leaves and voxels, except for the
// records of their fields. Their numbers begin at those in `starts` (first leaf, voxel, primitive
// and listed field of each brick).
kernel void write_united(const uint count, VXL_BRICK_GRID_PARAMETERS,
                         global const uint* restrict base_slots, VXL_UNITED_PARAMETERS,
                         global const ulong* restrict of_base, global const uint* restrict starts,
                         VXL_WRITTEN_PARAMETERS) {
    const uint item = work_item();
    if (item >= count) return;
    const BrickGrid grid = VXL_BRICK_GRID;
    const uint slot = VXL_BASE ? base_slots[item] : VXL_BRICK_OUTSIDE;
    const WrittenVoxels to = VXL_WRITTEN;
    const uint begin = entry_first[item], end = entry_first[item + 1];
    const uint4 start = vload4(item, starts);
    uint leaf_number = start.x, number = start.y, primitive = start.z, field = start.w;
    for (int leaf = 0; leaf < 64; ++leaf) {
        ulong mask = united[(size_t)item * 64 + leaf];
        if (mask == 0) continue;
        write_leaf(&to, leaf_number++, mask, number);
        const ulong lists = listing[(size_t)item * 64 + leaf];
        const ulong base = VXL_BASE ? of_base[(size_t)item * 64 + leaf] : 0;
        for (; mask != 0; mask &= mask - 1, ++number) {
            const int bit = lowest_bit(mask);
            const bool is_base = VXL_BASE && (base >> bit & 1);
            uint fields = 0;
            if (lists >> bit & 1)
                for (uint e = begin; e < end; ++e)
                    fields += (uint)(masks[(size_t)entries[3 * e] * 64 + leaf] >> bit & 1);
            if (fields > 0) to.attributes[number] = VXL_KIND_EXACT << VXL_KIND_SHIFT;
            if (fields > 0 || is_base) {
                vstore8((uint8)(field, fields, 0, 0, 0, 0, 0, 0), number, to.fields);
                if (VXL_COLORS) to.colors[number] = 0xFFFFFFu;
            }
            field += fields;
            if (VXL_PRIMITIVES) to.primitive_first[number] = primitive;
            if (!is_base) continue;
            const size_t voxel = (size_t)slot * VXL_BRICK_VOXELS + voxel_in_brick(leaf, bit);
            uint packed = base_attributes(&grid, voxel);
            if (fields > 0 && packed >> VXL_KIND_SHIFT == VXL_KIND_CUBES)
                packed |= VXL_KIND_EXACT_IN_CUBE << VXL_KIND_SHIFT;
            to.attributes[number] = packed;
            if (VXL_COLORS && grid.colors) to.colors[number] = grid.colors[voxel];
            if (VXL_VOXEL_NORMALS) to.normals[number] = grid.normals[voxel];
            if (!VXL_PRIMITIVES) continue;
            for (uint i = grid.primitive_first[voxel]; i < grid.primitive_first[voxel + 1]; ++i)
                to.primitives[primitive++] = grid.primitives[i];
        }
    }
}

// One work-item takes one brick of an object, number `first` + its slot among all objects' bricks.
// It writes the records of its fields. `bricks_of` holds the world brick of each; voxels are
// numbered as `write_united` numbers them. `links` are the links of the field's brackets and its
// own.
kernel void write_fields(const uint count, const uint first, const uint links,
                         VXL_BRICK_GRID_PARAMETERS, global const uint* restrict bricks_of,
                         VXL_UNITED_PARAMETERS, global const uint* restrict starts,
                         global uint* voxel_attributes, global uint* restrict voxel_colors,
                         global uint* voxel_fields) {
    const uint slot = work_item();
    if (slot >= count) return;
    const BrickGrid grid = VXL_BRICK_GRID;
    const uint own = first + slot, brick = bricks_of[own];
    if (brick == VXL_BRICK_OUTSIDE) return;
    uint number = starts[4 * brick + 1];
    short nodes[VXL_NODE_COUNT];
    bool gathered = false;
    for (int leaf = 0; leaf < 64; ++leaf) {
        const ulong all = united[(size_t)brick * 64 + leaf];
        ulong mask = masks[(size_t)own * 64 + leaf];
        const ulong lists = listing[(size_t)brick * 64 + leaf];
        if (mask != 0 && !gathered) {
            gather_nodes(grid.slots, grid.bricks, grid.distance,
                         brick_at(grid.coordinates[slot], grid.bricks), nodes);
            gathered = true;
        }
        for (; mask != 0; mask &= mask - 1) {
            const int bit = lowest_bit(mask);
            uint record = number + (uint)popcount(all & ((1ul << bit) - 1));
            uint rank_before = 0xFFFFFFFFu, path_before = 0, rank = 0, path = 0;
            if (lists >> bit & 1) {
                record = voxel_fields[(size_t)record * VXL_FIELD_WORDS];
                uint e = entry_first[brick];
                for (; entries[3 * e] != own; ++e) {
                    if (!(masks[(size_t)entries[3 * e] * 64 + leaf] >> bit & 1)) continue;
                    ++record;
                    rank_before = entries[3 * e + 1];
                    path_before = entries[3 * e + 2];
                }
                rank = entries[3 * e + 1];
                path = entries[3 * e + 2];
            }
            const int in_brick = voxel_in_brick(leaf, bit);
            const size_t voxel = (size_t)slot * VXL_BRICK_VOXELS + in_brick;
            const uint packed = VXL_ATTRIBUTES ? grid.attributes[voxel] : grid.attribute;
            voxel_attributes[record] = (packed & ~(3u << VXL_KIND_SHIFT)) | VXL_KIND_SMOOTH
                                                                                << VXL_KIND_SHIFT;
            if (VXL_COLORS) voxel_colors[record] = VXL_OWN_COLORS ? grid.colors[voxel] : 0xFFFFFFu;
            const int4 cell = (int4)(in_brick & 15, in_brick >> 4 & 15, in_brick >> 8, 0);
            uint8 words = field_record(nodes, cell);
            const bool linked = VXL_LINKED && rank == rank_before;
            const int shared = linked ? shared_brackets(path_before, path) : 0;
            words.s5 |= (uint)(bracket_depth(path) - shared) << VXL_LINK_SHIFT;
            if (linked) {
                words.s4 |= links >> VXL_LINK_BITS * shared << VXL_LINK_SHIFT;
                words.s6 |= (uint)(bracket_depth(path_before) - shared) << VXL_LINK_SHIFT;
            }
            vstore8(words, record, voxel_fields);
        }
        number += (uint)popcount(all);
    }
}
