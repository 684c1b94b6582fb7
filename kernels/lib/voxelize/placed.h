// SPDX-License-Identifier: Apache-2.0
// An object's brick grid as the world's voxels see it, through a map in fixed point.
#ifndef VXL_PLACED_H
#define VXL_PLACED_H

#include "lib/surface/brick_nodes.h"

// The map from world voxels to object voxels: row a holds the three coefficients of object axis a,
// then its offset, all times 2^fraction_bits. Coefficients are even, so that half steps are exact.
// Row 3 is the reach: how far along each object axis a world voxel looks around its centre. The
// host ensures that sums over the world's voxels stay below 2^62.
typedef struct {
    constant long* rows;
    int fraction_bits;
    int4 bricks;  // the object's brick table
    global const uint* slots;
    global const ulong* near;  // per slot: leaves with voxels, or with distances in the band
    global const ulong* occupancy;
    global const short* distance;
    float distance_scale;  // converts the object's distance units to the world's
    uint4 attribute_map;   // see placed_attributes.h
    global const uint* materials;
    global const uint* attributes;
    global const uint* colors;
    global const uint* normals;
} PlacedObject;

// The parameters that `bind` of a Painter sets, in its order.
#define VXL_OBJECT_PARAMETERS                                                                     \
    constant long *rows, int fraction_bits, int4 object_bricks,                                   \
        global const uint *restrict object_slots, global const ulong *restrict object_near,       \
        global const ulong *restrict object_occupancy,                                            \
        global const short *restrict object_distance, float distance_scale,                       \
        uint4 object_attribute_map, global const uint *restrict object_materials,                 \
        global const uint *restrict object_attributes, global const uint *restrict object_colors, \
        global const uint *restrict object_normals

// The value of a PlacedObject in a kernel with these parameters.
#define VXL_OBJECT                                                                       \
    {                                                                                    \
        rows, fraction_bits, object_bricks, object_slots, object_near, object_occupancy, \
            object_distance, distance_scale, object_attribute_map, object_materials,     \
            object_attributes, object_colors, object_normals                             \
    }

typedef struct {
    long x, y, z;
} FixedPoint;

// The object coordinates of the world point half_steps / 2.
static inline FixedPoint map_half_steps(const PlacedObject* object, int4 half_steps) {
    constant long* r = object->rows;
    FixedPoint p;
    p.x = r[3] + half_steps.x * (r[0] / 2) + half_steps.y * (r[1] / 2) + half_steps.z * (r[2] / 2);
    p.y = r[7] + half_steps.x * (r[4] / 2) + half_steps.y * (r[5] / 2) + half_steps.z * (r[6] / 2);
    p.z =
        r[11] + half_steps.x * (r[8] / 2) + half_steps.y * (r[9] / 2) + half_steps.z * (r[10] / 2);
    return p;
}

// The cell that holds a coordinate, clamped to far outside every grid.
static inline int cell_of(long coordinate, int fraction_bits) {
    return (int)clamp(coordinate >> fraction_bits, (long)-0x20000000, (long)0x20000000);
}

static inline int4 cell_at(FixedPoint p, int fraction_bits) {
    return (int4)(cell_of(p.x, fraction_bits), cell_of(p.y, fraction_bits),
                  cell_of(p.z, fraction_bits), 0);
}

// A box of an object's cells, both ends included.
typedef struct {
    int4 first, last;
} CellBox;

// The cells of the object that hold the image of the world box [low, low + edge] (half steps),
// extended by the reach if `widened`.
static inline CellBox map_box(const PlacedObject* object, int4 low, int edge, bool widened) {
    const FixedPoint p = map_half_steps(object, low);
    const long origin[3] = {p.x, p.y, p.z};
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis) {
        constant long* r = object->rows + 4 * axis;
        const long below = min(r[0], 0l) + min(r[1], 0l) + min(r[2], 0l);
        const long above = max(r[0], 0l) + max(r[1], 0l) + max(r[2], 0l);
        const long reach = widened ? object->rows[12 + axis] : 0;
        first[axis] = cell_of(origin[axis] + below / 2 * edge - reach, object->fraction_bits);
        last[axis] = cell_of(origin[axis] + above / 2 * edge + reach, object->fraction_bits);
    }
    const CellBox box = {(int4)(first[0], first[1], first[2], 0),
                         (int4)(last[0], last[1], last[2], 0)};
    return box;
}

// What an object has in a box of the world.
#define VXL_NOTHING 0u  // it is outside
#define VXL_FULL 1u     // its inside, without a surface
#define VXL_SURFACE 2u  // possibly its surface

// What the object has in a box, as far as its brick table alone tells: one of the three values
// above.
static inline uint state_of_bricks(const PlacedObject* object, CellBox box) {
    const int4 first = max(box.first >> 4, (int4)(-1)), last = min(box.last >> 4, object->bricks);
    bool inside = false, outside = false;
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const uint slot = brick_slot(object->slots, object->bricks, (int4)(x, y, z, 0));
                if (brick_is_stored(slot)) return VXL_SURFACE;
                inside |= slot == VXL_BRICK_INSIDE;
                outside |= slot == VXL_BRICK_OUTSIDE;
            }
    return inside ? (outside ? VXL_SURFACE : VXL_FULL) : VXL_NOTHING;
}

// True if one of the box's leaves is marked in `near`, which has 64 bits for each slot.
static inline bool touches_near_leaf(const PlacedObject* object, global const ulong* near,
                                     CellBox box) {
    const int4 first = max(box.first >> 2, (int4)(0)),
               last = min(box.last >> 2, object->bricks * 4 - 1);
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const uint slot =
                    brick_slot(object->slots, object->bricks, (int4)(x >> 2, y >> 2, z >> 2, 0));
                if (!brick_is_stored(slot)) {
                    x |= 3;  // continue in the next brick
                    continue;
                }
                if (near[slot] >> ((x & 3) | (y & 3) << 2 | (z & 3) << 4) & 1) return true;
            }
    return false;
}

// True if a position away from the surface is inside, by the sign of its nearest node.
static inline bool is_inside_field(const PlacedObject* object, global const short* distance,
                                   int4 node) {
    const uint slot = brick_slot(object->slots, object->bricks, node >> 4);
    if (!brick_is_stored(slot)) return slot == VXL_BRICK_INSIDE;
    return distance[(size_t)slot * VXL_BRICK_VOXELS + (node.x & 15) + ((node.y & 15) << 4) +
                    ((node.z & 15) << 8)] < 0;
}

// True if voxel `v` of the object is set. Sets `index` to its index in the bricks' values, or to -1
// for a voxel of a brick that isn't stored.
static inline bool is_occupied(const PlacedObject* object, global const ulong* occupancy, int4 v,
                               long* index) {
    const uint slot = brick_slot(object->slots, object->bricks, v >> 4);
    *index = -1;
    if (!brick_is_stored(slot)) return slot == VXL_BRICK_INSIDE;
    const int4 in = v & 15;
    *index = (long)slot * VXL_BRICK_VOXELS + (in.x | in.y << 4 | in.z << 8);
    const ulong mask =
        occupancy[(size_t)slot * 64 + ((in.x >> 2) | (in.y & 12) | (in.z & 12) << 2)];
    return mask >> ((in.x & 3) | (in.y & 3) << 2 | (in.z & 3) << 4) & 1;
}

static inline bool touches_full_brick(const PlacedObject* object, CellBox box) {
    const int4 first = max(box.first >> 4, (int4)(0)),
               last = min(box.last >> 4, object->bricks - 1);
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x)
                if (brick_slot(object->slots, object->bricks, (int4)(x, y, z, 0)) ==
                    VXL_BRICK_INSIDE)
                    return true;
    return false;
}

// The cells within the reach of p.
static inline CellBox cells_around(const PlacedObject* object, FixedPoint p) {
    constant long* reach = object->rows + 12;
    const FixedPoint first = {p.x - reach[0], p.y - reach[1], p.z - reach[2]};
    const FixedPoint last = {p.x + reach[0], p.y + reach[1], p.z + reach[2]};
    const CellBox box = {cell_at(first, object->fraction_bits),
                         cell_at(last, object->fraction_bits)};
    return box;
}

// Finds the first occupied voxel in the box, x fastest, and its index as in is_occupied. Skips
// empty bricks and leaves.
static inline bool find_in_box(const PlacedObject* object, global const ulong* occupancy,
                               global const ulong* near, CellBox box, long* index) {
    const int4 first = max(box.first, (int4)(0)), last = min(box.last, object->bricks * 16 - 1);
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const int4 v = (int4)(x, y, z, 0);
                const uint slot = brick_slot(object->slots, object->bricks, v >> 4);
                if (slot == VXL_BRICK_OUTSIDE) {
                    x |= 15;
                    continue;
                }
                if (is_occupied(object, occupancy, v, index)) return true;
                const int leaf = (x >> 2 & 3) | (y & 12) | (z & 12) << 2;
                if (!(near[slot] >> leaf & 1)) x |= 3;
            }
    return false;
}

#endif
