// SPDX-License-Identifier: Apache-2.0
// The attributes that a world voxel takes from an object's voxel, and which voxel that is.
#ifndef VXL_PLACED_ATTRIBUTES_H
#define VXL_PLACED_ATTRIBUTES_H

#include "lib/voxelize/placed_field.h"

// Describes an object's packed attributes in the world: its kind bits and object number, its own
// packed attributes if all its voxels have the same, the length of its list of materials, and 0.
typedef uint4 AttributeMap;

static inline uint attributes_in_world(AttributeMap map, global const uint* materials, uint own) {
    const uint group = own >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK;
    return map.x | materials[min(group, map.z - 1)] << VXL_MATERIAL_SHIFT;
}

// The packed attributes of a voxel in the world. `from` is its index in the object's buffers,
// negative if it has none.
static inline uint attributes_of(AttributeMap map, global const uint* materials,
                                 global const uint* attributes, long from) {
    const uint own = VXL_OBJECT_ATTRIBUTES && from >= 0 ? attributes[from] : map.y;
    return attributes_in_world(map, materials, own);
}

static inline uint color_of(global const uint* colors, long from) {
    return VXL_OBJECT_COLORS && from >= 0 ? colors[from] : 0xFFFFFFu;
}

// The index of voxel `v` in the object's buffers, or -1.
static inline long index_of_voxel(const PlacedObject* object, int4 v) {
    const uint slot = brick_slot(object->slots, object->bricks, v >> 4);
    if (!brick_is_stored(slot)) return -1;
    return (long)slot * VXL_BRICK_VOXELS + ((v.x & 15) | (v.y & 15) << 4 | (v.z & 15) << 8);
}

// The world's leaf for a work-item: leaves are painted brick by brick, and `painted` lists the
// bricks' slots.
static inline uint painted_leaf(uint item, global const uint* painted) {
    return painted[item >> 6] << 6 | (item & 63u);
}

// The first node, in half steps, of the world's leaf number 64 * slot + bit.
static inline int4 leaf_in_world(uint leaf, global const uint* coordinates, int4 world_bricks) {
    const int4 brick = brick_at(coordinates[leaf >> 6], world_bricks);
    return (brick * 16 + (int4)(leaf << 2 & 12, leaf & 12, leaf >> 2 & 12, 0)) * 2;
}

static inline int leaf_index(uint leaf) {
    return (int)((leaf << 2 & 12) | (leaf & 12) << 4 | (leaf >> 2 & 12) << 8);
}

// floor(½ - numerator / (2 denominator)): the number of whole cells between a cell and the one that
// holds the point at -numerator / (2 denominator) from the cell's middle.
static inline int cells_back(long numerator, long denominator) {
    const long doubled = denominator - numerator;
    const long low = doubled >= 0 ? doubled : doubled - (2 * denominator - 1);
    return (int)(low / (2 * denominator));
}

// The cell of the surface point that one Newton step from the middle of p's cell finds. It is
// computed in integers, so every device finds the same cell. `node` is the first corner of p's cell
// in a gathered block. Voxelizers guarantee attributes only in such cells.
static inline int4 cell_on_surface(const short* node, int4 cell) {
    long x = 0, y = 0, z = 0;  // four times the mean differences
    long sum = 0;              // eight times the mean distance
    for (int corner = 0; corner < 8; ++corner) {
        const long f = node[(corner & 1) + (corner >> 1 & 1) * VXL_BLOCK_ROW +
                            (corner >> 2) * VXL_BLOCK_LAYER];
        sum += f;
        x += corner & 1 ? f : -f;
        y += corner & 2 ? f : -f;
        z += corner & 4 ? f : -f;
    }
    const long size = x * x + y * y + z * z;
    if (size == 0) return cell;
    // f g / |g|² voxels with f = sum / 8, g = (x,y,z) / 4: sum * (x,y,z) / (2 size).
    return cell + (int4)(cells_back(sum * x, size), cells_back(sum * y, size),
                         cells_back(sum * z, size), 0);
}

#endif
