// SPDX-License-Identifier: Apache-2.0
// Puts the crossings of one probe line in order and removes those that other objects hide.
//
// Inside an object that lets light through, surfaces of objects with a lower priority are not seen.
// The rules are those of lib/traverse/medium_set.h, for a line that continues through everything.
#ifndef VXL_LINE_ORDER_H
#define VXL_LINE_ORDER_H

#include "shared/display.h"
#include "shared/voxel.h"

// A line's crossing names its object in packed attributes, whose kind is this value for cubes and
// otherwise 0.
#define VXL_LINE_CUBE (1u << VXL_KIND_SHIFT)

// The number of objects that a line may be inside of at once; further ones are ignored.
#define VXL_LINE_MEDIA 16

// Crossings of one object in the same sense that are closer together than this, in voxels, count as
// one: a line through the edge of two triangles, or through the side between two voxels of the
// world, meets the same surface twice.
#define VXL_SAME_POINT 0.0009765625f

#define VXL_NO_RANK 0xFFFFFFFFu

/// The crossings of one line, `stride` apart.
typedef struct {
    uint count, stride;
    global float* restrict coordinates;
    global uint* restrict surfaces;
    global const uint* restrict ranks;       // of each object, see medium_set.h
    global const float* restrict opacities;  // of each material: 1 opaque; 2 light passes, but
                                             // nothing behind is shown
} LineCrossings;

/// The ranks of the objects that a line is inside of.
typedef struct {
    uint ranks[VXL_LINE_MEDIA];
    uint count;
} LineMedia;

static inline uint sense_at(const LineCrossings* l, uint i) {
    return as_uint(l->coordinates[i * l->stride]) & VXL_CROSSES_SENSES;
}

static inline float opacity_of_surface(global const float* restrict opacities, uint surface) {
    return opacities[(surface >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK];
}

/// The rank of the object of crossing i, or VXL_NO_RANK if the surface there is opaque.
static inline uint rank_at(const LineCrossings* l, uint i) {
    const uint surface = l->surfaces[i * l->stride];
    if (opacity_of_surface(l->opacities, surface) == 1.0f) return VXL_NO_RANK;
    return l->ranks[surface & VXL_OBJECT_MASK];
}

static inline bool is_cube_at(const LineCrossings* l, uint i) {
    return (l->surfaces[i * l->stride] & VXL_LINE_CUBE) != 0u;
}

static inline void enter(LineMedia* m, uint rank) {
    if (m->count < VXL_LINE_MEDIA) m->ranks[m->count++] = rank;
}

static inline void leave(LineMedia* m, uint rank) {
    uint kept = 0;
    for (uint i = 0; i < m->count; ++i)
        if (m->ranks[i] != rank) m->ranks[kept++] = m->ranks[i];
    m->count = kept;
}

/// Insertion sort: the scan finds most crossings already in order.
static inline void sort_crossings(const LineCrossings* l) {
    for (uint i = 1; i < l->count; ++i) {
        const float coordinate = l->coordinates[i * l->stride];
        const uint surface = l->surfaces[i * l->stride];
        uint at = i;
        for (; at > 0u && l->coordinates[(at - 1u) * l->stride] > coordinate; --at) {
            l->coordinates[at * l->stride] = l->coordinates[(at - 1u) * l->stride];
            l->surfaces[at * l->stride] = l->surfaces[(at - 1u) * l->stride];
        }
        l->coordinates[at * l->stride] = coordinate;
        l->surfaces[at * l->stride] = surface;
    }
}

/// The objects inside which the line begins: those whose first crossing leaves them.
static inline LineMedia begin_line(const LineCrossings* l) {
    LineMedia media;
    media.count = 0;
    for (uint i = 0; i < l->count; ++i) {
        const uint rank = rank_at(l, i);
        if (rank == VXL_NO_RANK || is_cube_at(l, i) || sense_at(l, i) != VXL_CROSSES_OUT) continue;
        bool is_first = true;
        for (uint k = 0; k < i && is_first; ++k) is_first = rank_at(l, k) != rank;
        if (is_first) enter(&media, rank);
    }
    return media;
}

/// True if crossing i repeats one of the `kept` crossings before it.
static inline bool is_again(const LineCrossings* l, uint i, uint kept) {
    const uint sense = sense_at(l, i);
    if (sense == VXL_CROSSES_CUBE) return false;  // cubes have one crossing each
    const float coordinate = l->coordinates[i * l->stride];
    const uint object = l->surfaces[i * l->stride] & VXL_OBJECT_MASK;
    for (uint k = kept; k-- > 0u && coordinate - l->coordinates[k * l->stride] < VXL_SAME_POINT;)
        if (sense_at(l, k) == sense && (l->surfaces[k * l->stride] & VXL_OBJECT_MASK) == object)
            return true;
    return false;
}

/// Crosses surface i and updates `media`. Returns true if the object that the line is in, as rays
/// see it, changes there.
static inline bool cross_surface(const LineCrossings* l, uint i, LineMedia* media) {
    const uint rank = rank_at(l, i);
    if (rank == VXL_NO_RANK) return true;
    bool is_inside = false, is_first = true;
    for (uint k = 0; k < media->count; ++k) {
        is_inside |= media->ranks[k] == rank;
        is_first &= media->ranks[k] >= rank;
    }
    if (is_cube_at(l, i)) return is_first;
    if (sense_at(l, i) == VXL_CROSSES_OUT) {
        leave(media, rank);
        return is_first;
    }
    if (is_inside) return false;
    enter(media, rank);
    return is_first;
}

/// Sorts the line's crossings and removes those that are not seen. Returns the number of the
/// others.
static inline uint order_crossings(const LineCrossings* l) {
    sort_crossings(l);
    LineMedia media = begin_line(l);
    uint kept = 0;
    for (uint i = 0; i < l->count; ++i) {
        if (is_again(l, i, kept) || !cross_surface(l, i, &media)) continue;
        l->coordinates[kept * l->stride] = l->coordinates[i * l->stride];
        l->surfaces[kept * l->stride] = l->surfaces[i * l->stride];
        ++kept;
    }
    return kept;
}

#endif
