// SPDX-License-Identifier: Apache-2.0
// object grids -> S: every object's bricks, resampled into the world's bricks by the inverse map.
//
// Objects are painted one after another, the winner of an overlap last. Each object is painted by
// one launch over the leaves of the bricks listed in `painted`, so no two work-items write the same
// voxel. Integers alone decide which voxel is set, and a brick's voxels depend on nothing but the
// objects.
//
// Build constants: VXL_SMOOTH: the object has distances instead of occupancy. VXL_ATTRIBUTES,
// VXL_COLORS, VXL_VOXEL_NORMALS: the world has them. VXL_OBJECT_ATTRIBUTES, VXL_OBJECT_COLORS,
// VXL_OBJECT_NORMALS: the object has them. VXL_REACH: the reach is not 0. VXL_KEEPS_INSIDE: bricks
// inside of the object are stored, too.
#include "lib/lanes/work_item.h"
#include "lib/traverse/world_bounds.h"
#include "lib/voxelize/painted_world.h"
#include "lib/voxelize/placed_attributes.h"
#include "lib/voxelize/placed_field.h"
#include "lib/voxelize/placed_normal.h"

// One work-item takes one brick of an object. It finds which of the brick's leaves hold voxels, or
// distances below `threshold`.
kernel void mark_near_leaves(const uint count, const int threshold,
                             global const ulong* restrict occupancy,
                             global const short* restrict distance, global ulong* restrict near) {
    const uint slot = work_item();
    if (slot >= count) return;
    ulong mask = 0;
    for (int layer = 0; layer < 16; ++layer) {  // four rows of nodes in y, four in z
        const int first = (layer & 3) << 2, leaf = layer << 2;
        if (VXL_SMOOTH) {
            global const short* nodes =
                distance + (size_t)slot * VXL_BRICK_VOXELS + (first << 4) + (layer >> 2 << 10);
            short16 nearest = VXL_SATURATED;
            for (int row = 0; row < 16; ++row) {
                const short16 f = vload16(0, nodes + ((row & 3) << 4) + (row >> 2 << 8));
                const short16 size = LARGER(f, -f);
                nearest = SMALLER(nearest, size);
            }
            const short8 two = min(nearest.even, nearest.odd);
            const short4 four = min(two.even, two.odd);
            mask |= (ulong)((four.x < threshold) | (four.y < threshold) << 1 |
                            (four.z < threshold) << 2 | (four.w < threshold) << 3)
                    << leaf;
        } else {
            for (int x = 0; x < 4; ++x)
                if (occupancy[(size_t)slot * 64 + leaf + x] != 0) mask |= 1ul << (leaf + x);
        }
    }
    near[slot] = mask;
}

// One work-item takes one brick of the world: one of those listed or, without a list, of all. It
// raises the brick's state to what the object has there. A brick is full only if the voxels around
// it are full, too, since a brick next to an empty voxel or to the world's end must be stored.
kernel void classify_bricks(const uint count, global const uint* restrict listed,
                            const int4 world_bricks, const WorldBounds bounds,
                            VXL_OBJECT_PARAMETERS, global uchar* restrict states) {
    const uint item = work_item();
    if (item >= count) return;
    const uint index = listed ? listed[item] : item;
    if (states[index] == VXL_SURFACE) return;
    const PlacedObject object = VXL_OBJECT;
    const int4 low = (brick_at(index, world_bricks) << 5) - (int4)(2, 2, 2, 0);
    const CellBox box = map_box(&object, low, 36, true);
    uint state = state_of_bricks(&object, box);
    if (state == VXL_SURFACE && !touches_near_leaf(&object, object.near, box)) {
        const int4 middle = (box.first + box.last) >> 1;
        if (VXL_SMOOTH)
            state = is_inside_field(&object, object.distance, middle) ? VXL_FULL : VXL_NOTHING;
        else if (!touches_full_brick(&object, box))
            state = VXL_NOTHING;
    }
    if (state == VXL_FULL &&
        (is_at_bounds(bounds, brick_at(index, world_bricks) * 16, 16) || VXL_KEEPS_INSIDE))
        state = VXL_SURFACE;
    states[index] = (uchar)max((uint)states[index], state);
}

// One work-item takes one leaf of the world. It keeps the smaller of the leaf's distances and the
// object's.
kernel void paint_distances(const uint count, VXL_OBJECT_PARAMETERS, VXL_PAINTED_PARAMETERS) {
    const uint item = work_item();
    if (item >= count) return;
    const PlacedObject object = VXL_OBJECT;
    const PaintedWorld world = VXL_PAINTED;
    const uint leaf = painted_leaf(item, world.painted);
    const int4 low = leaf_in_world(leaf, world.coordinates, world.bricks);
    global short* out = world.distance + (size_t)(leaf >> 6) * VXL_BRICK_VOXELS + leaf_index(leaf);
    const CellBox cells = map_box(&object, low, 6, false);
    const CellBox nodes = {cells.first, cells.last + 1};
    const bool is_near = touches_near_leaf(&object, object.near, nodes);
    if (!is_near) {
        if (!is_inside_field(&object, object.distance, cells.first)) return;
        for (int row = 0; row < 16; ++row)
            vstore4((short4)(-VXL_SATURATED), 0, out + ((row & 3) << 4) + (row >> 2 << 8));
        return;
    }
    short block[VXL_BLOCK_NODES];
    CellBox gathered = nodes_of_cells(cells);
    const bool at_once = fits_block(gathered);
    if (at_once) gather_block(&object, object.distance, gathered, block);
    for (int i = 0; i < 64; ++i) {
        const int4 node = (int4)(i & 3, i >> 2 & 3, i >> 4, 0);
        const FixedPoint p = map_half_steps(&object, low + node * 2);
        if (!at_once) {
            const int4 cell = cell_at(p, object.fraction_bits);
            const CellBox one = {cell, cell};
            gathered = nodes_of_cells(one);
            gather_block(&object, object.distance, gathered, block);
        }
        const short value =
            stored_distance(object.distance_scale * distance_at(&object, block, gathered.first, p));
        global short* value_at = out + node.x + (node.y << 4) + (node.z << 8);
        *value_at = min(*value_at, value);
    }
}

// One work-item takes one leaf of the world. It cuts the distances off at the world's bounds.
kernel void close_distances(const uint count, VXL_PAINTED_PARAMETERS) {
    const uint item = work_item();
    if (item >= count) return;
    const PaintedWorld world = VXL_PAINTED;
    const uint leaf = painted_leaf(item, world.painted);
    const int4 low = leaf_in_world(leaf, world.coordinates, world.bricks);
    if (!is_at_bounds(world.bounds, low / 2 - 4, 12)) return;
    global short* out = world.distance + (size_t)(leaf >> 6) * VXL_BRICK_VOXELS + leaf_index(leaf);
    for (int i = 0; i < 64; ++i) {
        const int4 node = (int4)(i & 3, i >> 2 & 3, i >> 4, 0);
        global short* value_at = out + node.x + (node.y << 4) + (node.z << 8);
        *value_at = (short)max((int)*value_at, -depth_in_world(world.bounds, low + node * 2));
    }
}

// One work-item takes one leaf of the world. It writes the attributes and colours of the voxels
// near the object's surface.
kernel void paint_smooth_voxels(const uint count, const int crossing, VXL_OBJECT_PARAMETERS,
                                VXL_PAINTED_PARAMETERS) {
    const uint item = work_item();
    if (item >= count) return;
    const PlacedObject object = VXL_OBJECT;
    const PaintedWorld world = VXL_PAINTED;
    const uint leaf = painted_leaf(item, world.painted);
    const int4 low = leaf_in_world(leaf, world.coordinates, world.bricks);
    const CellBox cells = map_box(&object, low, 8, false);
    const CellBox nodes = {cells.first, cells.last + 1};
    if (!touches_near_leaf(&object, object.near, nodes) && !is_at_bounds(world.bounds, low / 2, 4))
        return;
    short block[VXL_BLOCK_NODES];
    CellBox gathered = nodes_of_cells(cells);
    const bool at_once = fits_block(gathered);
    if (at_once) gather_block(&object, object.distance, gathered, block);
    for (int i = 0; i < 64; ++i) {
        const int4 voxel = (int4)(i & 3, i >> 2 & 3, i >> 4, 0);
        const int index = leaf_index(leaf) + voxel.x + (voxel.y << 4) + (voxel.z << 8);
        const size_t number = (size_t)(leaf >> 6) * VXL_BRICK_VOXELS + index;
        // Where the surface crosses, the corners' distances are within a voxel's diagonal: for most
        // voxels this one test is enough.
        if (world.distance[number] > 3 * crossing) continue;
        const int4 half_steps = low + voxel * 2 + (int4)(1, 1, 1, 0);
        const FixedPoint centre = map_half_steps(&object, half_steps);
        const int4 cell = cell_at(centre, object.fraction_bits);
        if (!at_once) {
            const CellBox one = {cell, cell};
            gathered = nodes_of_cells(one);
            gather_block(&object, object.distance, gathered, block);
        }
        const short own = stored_distance(object.distance_scale *
                                          distance_at(&object, block, gathered.first, centre));
        const int value = max((int)own, -depth_in_world(world.bounds, half_steps));
        // `crossing` is half a voxel's diagonal; the bend of a distance field adds less than that.
        if ((int)abs(value) > 2 * crossing) continue;
        const int4 at = cell - gathered.first;
        const int4 source =
            cell_on_surface(block + at.x + at.y * VXL_BLOCK_ROW + at.z * VXL_BLOCK_LAYER, cell);
        const long from = index_of_voxel(&object, source);
        if (VXL_ATTRIBUTES)
            world.attributes[number] =
                attributes_of(object.attribute_map, object.materials, object.attributes, from);
        if (VXL_COLORS) world.colors[number] = color_of(object.colors, from);
    }
}

// True if a cube with the packed attributes `before` stays when its voxel is painted `packed`: an
// exact object leaves cubes behind its surface. Where voxels have colours, one colour holds for all
// of a voxel, so cubes are replaced and this is not asked.
static inline bool stays_cube(uint before, uint packed) {
    const uint kind = before >> VXL_KIND_SHIFT;
    const bool is_cube = kind == VXL_KIND_CUBES || kind == VXL_KIND_EXACT_IN_CUBE;
    return is_cube && packed >> VXL_KIND_SHIFT == VXL_KIND_EXACT;
}

// One work-item takes one leaf of the world. It sets the voxels whose centre's image lies in an
// occupied voxel of the object, or has one within the reach.
kernel void paint_cubes(const uint count, VXL_OBJECT_PARAMETERS, VXL_PAINTED_PARAMETERS) {
    const uint item = work_item();
    if (item >= count) return;
    const PlacedObject object = VXL_OBJECT;
    const PaintedWorld world = VXL_PAINTED;
    const uint leaf = painted_leaf(item, world.painted);
    const int4 low = leaf_in_world(leaf, world.coordinates, world.bricks);
    const CellBox box = map_box(&object, low + (int4)(1, 1, 1, 0), 6, true);
    if (!touches_near_leaf(&object, object.near, box) && !touches_full_brick(&object, box)) return;
    ulong set = 0;
    for (int i = 0; i < 64; ++i) {
        const int4 voxel = (int4)(i & 3, i >> 2 & 3, i >> 4, 0);
        if (any((low / 2 + voxel >= world.bounds.size).xyz)) continue;
        const FixedPoint centre = map_half_steps(&object, low + voxel * 2 + (int4)(1, 1, 1, 0));
        long from;
        bool found =
            is_occupied(&object, object.occupancy, cell_at(centre, object.fraction_bits), &from);
        if (!found && VXL_REACH)
            found = find_in_box(&object, object.occupancy, object.near,
                                cells_around(&object, centre), &from);
        if (!found) continue;
        const bool was_set = world.occupancy[leaf] >> i & 1;
        set |= 1ul << i;
        const size_t number = (size_t)(leaf >> 6) * VXL_BRICK_VOXELS + leaf_index(leaf) + voxel.x +
                              (voxel.y << 4) + (voxel.z << 8);
        bool is_over_cube = false;
        if (VXL_ATTRIBUTES) {
            uint packed =
                attributes_of(object.attribute_map, object.materials, object.attributes, from);
            if (was_set && !VXL_COLORS) {
                is_over_cube = stays_cube(world.attributes[number], packed);
                if (is_over_cube)
                    packed = world.attributes[number] | VXL_KIND_EXACT_IN_CUBE << VXL_KIND_SHIFT;
            }
            world.attributes[number] = packed;
        }
        if (VXL_COLORS) world.colors[number] = color_of(object.colors, from);
        if (VXL_VOXEL_NORMALS && !is_over_cube)
            world.normals[number] = normal_in_world(&object, from);
    }
    world.occupancy[leaf] |= set;
}
