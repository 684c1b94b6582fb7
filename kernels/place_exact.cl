// SPDX-License-Identifier: Apache-2.0
// object grids -> S, exact surfaces: the primitive lists of all objects, joined voxel by voxel.
//
// All grids are in the world's frame here. Objects are counted and appended one after another in
// the scene's order, so a list has the first object's primitives first.
#include "lib/lanes/work_item.h"
#include "lib/voxelize/placed_attributes.h"
#include "shared/solid.h"
#include "shared/texture.h"
#include "shared/trace.h"

// One brick of the world: adds the lengths of the object's lists to its voxels' counts.
kernel void count_primitives(const uint count, global const uint* restrict coordinates,
                             global const uint* restrict slots, global const uint* restrict first,
                             global uint* restrict counts) {
    const uint slot = work_item();
    if (slot >= count) return;
    const uint from = slots[coordinates[slot]];
    if (!brick_is_stored(from)) return;
    global const uint* list = first + (size_t)from * VXL_BRICK_VOXELS;
    global uint* sums = counts + (size_t)slot * VXL_BRICK_VOXELS;
    for (int voxel = 0; voxel < VXL_BRICK_VOXELS; ++voxel)
        sums[voxel] += list[voxel + 1] - list[voxel];
}

// One brick of the world: the sum of its counts.
kernel void sum_counts(const uint count, global const uint* restrict counts,
                       global uint* restrict sums) {
    const uint slot = work_item();
    if (slot >= count) return;
    uint sum = 0;
    for (int voxel = 0; voxel < VXL_BRICK_VOXELS; ++voxel)
        sum += counts[(size_t)slot * VXL_BRICK_VOXELS + voxel];
    sums[slot] = sum;
}

// One brick of the world: where its voxels' lists start. `ends` takes the place of the counts, and
// holds the end of what is written so far.
kernel void start_lists(const uint count, global const uint* restrict starts,
                        global uint* restrict ends, global uint* restrict first) {
    const uint slot = work_item();
    if (slot >= count) return;
    uint start = starts[slot];
    for (int voxel = 0; voxel < VXL_BRICK_VOXELS; ++voxel) {
        const size_t number = (size_t)slot * VXL_BRICK_VOXELS + voxel;
        const uint length = ends[number];
        first[number] = ends[number] = start;
        start += length;
    }
}

// One brick of the world: appends the object's lists, with its primitives' new numbers.
kernel void append_primitives(const uint count, const uint first_triangle, const uint first_solid,
                              global const uint* restrict coordinates,
                              global const uint* restrict slots, global const uint* restrict first,
                              global const uint* restrict primitives, global uint* restrict ends,
                              global uint* restrict world_primitives) {
    const uint slot = work_item();
    if (slot >= count) return;
    const uint from = slots[coordinates[slot]];
    if (!brick_is_stored(from)) return;
    global const uint* list = first + (size_t)from * VXL_BRICK_VOXELS;
    for (int voxel = 0; voxel < VXL_BRICK_VOXELS; ++voxel) {
        if (list[voxel] == list[voxel + 1]) continue;
        uint end = ends[(size_t)slot * VXL_BRICK_VOXELS + voxel];
        for (uint i = list[voxel]; i < list[voxel + 1]; ++i)
            world_primitives[end++] =
                primitives[i] +
                (primitives[i] & VXL_SOLID_PRIMITIVE ? first_solid : first_triangle);
        ends[(size_t)slot * VXL_BRICK_VOXELS + voxel] = end;
    }
}

// One word of a buffer that is joined to others.
kernel void append_words(const uint count, const uint start, global const uint* restrict from,
                         global uint* restrict to) {
    const uint i = work_item();
    if (i < count) to[start + i] = from[i];
}

// One word of what triangles wear; their textures begin by `first` later now.
kernel void append_worn(const uint count, const uint start, const uint first,
                        global const uint* restrict from, global uint* restrict to) {
    const uint i = work_item();
    if (i >= count) return;
    const bool is_place = i % VXL_WORN_WORDS == VXL_WORN_TEXTURE && from[i] != VXL_NO_TEXTURE;
    to[start + i] = is_place ? from[i] + first : from[i];
}

// One triangle's packed attributes.
kernel void append_triangle_attributes(const uint count, const uint start, const AttributeMap map,
                                       global const uint* restrict materials,
                                       global const uint* restrict attributes,
                                       global uint* restrict to) {
    const uint i = work_item();
    if (i >= count) return;
    to[start + i] = attributes_of(map, materials, attributes, i);
}

// One shape's packed attributes, in its record in the world.
kernel void set_solid_attributes(const uint count, const uint start, const AttributeMap map,
                                 global const uint* restrict materials,
                                 global SolidShape* restrict solids) {
    const uint i = work_item();
    if (i >= count) return;
    global SolidShape* shape = solids + start + i;
    shape->attribute = attributes_in_world(map, materials, shape->attribute);
}
