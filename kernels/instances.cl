// SPDX-License-Identifier: Apache-2.0
// pyramids of models -> the world's pyramid with the models' data appended; instances read it.
#include "lib/lanes/work_item.h"
#include "shared/texture.h"
#include "shared/trace.h"
#include "shared/voxel.h"

// Copies one word per work-item.
kernel void append_instance_words(const uint count, const uint start,
                                  global const uint* restrict from, global uint* restrict to) {
    const uint i = work_item();
    if (i < count) to[start + i] = from[i];
}

// Writes one copy of `word` per work-item.
kernel void append_copies(const uint count, const uint start, const uint word,
                          global uint* restrict to) {
    const uint i = work_item();
    if (i < count) to[start + i] = word;
}

// Copies one number, increased by `first`, the number of entries that now precede it. Numbers with
// a bit of `kept` stay as they are.
kernel void append_numbers(const uint count, const uint start, const uint first, const uint kept,
                           global const uint* restrict from, global uint* restrict to) {
    const uint i = work_item();
    if (i < count) to[start + i] = from[i] & kept ? from[i] : from[i] + first;
}

// Copies the record of a field, or of a list of fields, behind `first` other records. The number of
// a list's first record grows by `first`, too. A list of zeros is empty.
kernel void append_fields(const uint count, const uint first,
                          global const uint* restrict attributes, global const uint* restrict from,
                          global uint* restrict to) {
    const uint i = work_item();
    if (i >= count) return;
    uint8 record = vload8(i, from);
    if (attributes[i] >> VXL_KIND_SHIFT >= VXL_KIND_EXACT && record.s1 != 0) record.s0 += first;
    vstore8(record, first + i, to);
}

// Copies one brick record. Increases the first leaves of its two halves, unless the brick is empty.
kernel void append_bricks(const uint count, const uint start, const uint first_leaf,
                          global const uint* restrict from, global uint* restrict to) {
    const uint i = work_item();
    if (i >= count) return;
    uint4 record = vload4(i, from);
    if (!(record.z >> 31)) record.zw += first_leaf;
    vstore4(record, start + i, to);
}

// Copies one entry of the lists of primitives and turns it into a number in the whole scene.
kernel void append_instance_primitives(const uint count, const uint start,
                                       const uint first_triangle, const uint first_solid,
                                       global const uint* restrict from, global uint* restrict to) {
    const uint i = work_item();
    if (i >= count) return;
    to[start + i] = from[i] + (from[i] & VXL_SOLID_PRIMITIVE ? first_solid : first_triangle);
}

// Copies one word of what triangles wear. Their textures now begin `first` words later.
kernel void append_instance_worn(const uint count, const uint start, const uint first,
                                 global const uint* restrict from, global uint* restrict to) {
    const uint i = work_item();
    if (i >= count) return;
    const bool is_texture_index =
        i % VXL_WORN_WORDS == VXL_WORN_TEXTURE && from[i] != VXL_NO_TEXTURE;
    to[start + i] = is_texture_index ? from[i] + first : from[i];
}
