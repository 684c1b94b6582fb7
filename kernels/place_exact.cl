// SPDX-License-Identifier: Apache-2.0
// object grids -> S, for exact surfaces: the primitive lists of all objects, joined voxel by voxel.
//
// All grids are in the world's frame here. Objects are counted and appended one after another in
// the scene's order, so a list has the first object's primitives first.
#include "lib/lanes/work_item.h"
#include "lib/voxelize/placed_attributes.h"
#include "shared/solid.h"
#include "shared/texture.h"
#include "shared/trace.h"

// One work-item takes one brick of the world. It adds the lengths of the object's lists to the
// brick's counts, one per voxel.
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

// One work-item takes one brick of the world. It adds up the brick's counts.
kernel void sum_counts(const uint count, global const uint* restrict counts,
                       global uint* restrict sums) {
    const uint slot = work_item();
    if (slot >= count) return;
    uint sum = 0;
    for (int voxel = 0; voxel < VXL_BRICK_VOXELS; ++voxel)
        sum += counts[(size_t)slot * VXL_BRICK_VOXELS + voxel];
    sums[slot] = sum;
}

// One work-item takes one brick of the world. It computes where its voxels' lists start. `ends`
// holds the counts before, and after it the end of what has been written so far.
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

// One work-item takes one brick of the world. It appends the object's lists, with the primitives'
// new numbers.
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

// Copies one word of a buffer that is appended to others.
kernel void append_words(const uint count, const uint start, global const uint* restrict from,
                         global uint* restrict to) {
    const uint i = work_item();
    if (i < count) to[start + i] = from[i];
}

// Copies one word of what triangles wear. Their textures now begin `first` words later.
kernel void append_worn(const uint count, const uint start, const uint first,
                        global const uint* restrict from, global uint* restrict to) {
    const uint i = work_item();
    if (i >= count) return;
    const bool is_texture_index =
        i % VXL_WORN_WORDS == VXL_WORN_TEXTURE && from[i] != VXL_NO_TEXTURE;
    to[start + i] = is_texture_index ? from[i] + first : from[i];
}

// Writes one triangle's packed attributes.
kernel void append_triangle_attributes(const uint count, const uint start, const AttributeMap map,
                                       global const uint* restrict materials,
                                       global const uint* restrict attributes,
                                       global uint* restrict to) {
    const uint i = work_item();
    if (i >= count) return;
    to[start + i] = attributes_of(map, materials, attributes, i);
}

// Writes one shape's packed attributes into its record in the world.
kernel void set_solid_attributes(const uint count, const uint start, const AttributeMap map,
                                 global const uint* restrict materials,
                                 global SolidShape* restrict solids) {
    const uint i = work_item();
    if (i >= count) return;
    global SolidShape* shape = solids + start + i;
    shape->attribute = attributes_in_world(map, materials, shape->attribute);
}
