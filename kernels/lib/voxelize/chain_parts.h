// SPDX-License-Identifier: Apache-2.0
// Parts of a solid in a brick, which are joined one after another.
#ifndef VXL_CHAIN_PARTS_H
#define VXL_CHAIN_PARTS_H

#include "lib/surface/brick_field.h"
#include "lib/voxelize/brick_grid.h"
#include "shared/field_place.h"

// The parts in a brick; the entries are those of join_parts.
typedef struct {
    global const uint* restrict entries;
    global ulong* masks;
    int leaf;
} ChainParts;

// Keeps only `cells` in the masks of parts `begin` to `end` - 1.
static inline void keep_cells(const ChainParts* parts, uint begin, uint end, ulong cells) {
    for (uint e = begin; e < end && ~cells != 0; ++e)
        if (brick_is_stored(parts->entries[3 * e]))
            parts->masks[(size_t)parts->entries[3 * e] * 64 + parts->leaf] &= cells;
}

// Joined parts, from number `begin` on: the cells inside them and on their surface, and the link
// that will join them to those before them.
typedef struct {
    ulong within, crossed;
    uint begin, link;
} Joined;

// Joins parts, up to number `end` - 1, to the ones before them. Removes from the masks of both the
// cells in which the other one decides.
static inline void join(const ChainParts* parts, Joined* all, const Joined* next, uint end) {
    ulong before = 0, behind = ~0ul;  // the cells in which each of the two matters
    ulong within = next->within;
    if (next->link == VXL_LINK_UNION) {
        before = ~next->within;
        behind = ~all->within;
        within |= all->within;
    } else if (next->link == VXL_LINK_INTERSECTION) {
        before = next->crossed | next->within;
        behind = all->crossed | all->within;
        within &= all->within;
    }
    if (next->link != 0) {
        keep_cells(parts, all->begin, next->begin, before);
        keep_cells(parts, next->begin, end, behind);
    }
    all->crossed = (all->crossed & before) | (next->crossed & behind);
    all->within = within;
}

#endif
