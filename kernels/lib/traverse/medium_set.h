// SPDX-License-Identifier: Apache-2.0
// The set of transmitting objects that a ray is inside of.
//
// The effective medium is the object that comes first in the order of priorities, so it doesn't
// depend on the order in which surfaces were crossed.
#ifndef VXL_MEDIUM_SET_H
#define VXL_MEDIUM_SET_H

#include "lib/lanes/lanes.h"
#include "shared/trace.h"
#include "shared/voxel.h"

// The build constant VXL_MEDIA is the number of objects that a scene needs room for.
#define VXL_MEDIUM_SET_SIZE (VXL_MEDIA > 0 ? VXL_MEDIA : 1)

/// Component VXL_PATH_EMITTER of a path, if the scene has it (VXL_LOOKS).
#define VXL_PATH_EMITTER (VXL_PATH_INSIDE + (VXL_TRANSMISSION ? VXL_MEDIUM_SET_SIZE : 0))
/// Component VXL_PATH_TRAVELLED of a path, if the scene has it (VXL_TRAVELS).
#define VXL_PATH_TRAVELLED (VXL_PATH_EMITTER + (VXL_LOOKS ? 1 : 0))
#define VXL_TRAVELS ((VXL_EMITTERS || VXL_AREA_SHARES) && VXL_INSTANCES && VXL_TRANSMISSION)
/// Component VXL_PATH_DENSITY of a path, if the scene has VXL_AREA_SHARES.
#define VXL_PATH_DENSITY (VXL_PATH_TRAVELLED + (VXL_TRAVELS ? 1 : 0))
/// Component VXL_PATH_WIDTH of a path, the last one, if the scene has it (VXL_WIDENS).
#define VXL_PATH_WIDTH (VXL_PATH_DENSITY + (VXL_AREA_SHARES ? 1 : 0))
#define VXL_WIDENS (VXL_TEXTURES && VXL_PATHS && VXL_RADIANCE)

/// The objects' packed attributes; VXL_NO_MEDIUM marks a free slot.
typedef struct {
    lane_uint members[VXL_MEDIUM_SET_SIZE];
} MediumSet;

static inline MediumSet empty_medium_set(void) {
    MediumSet media;
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i) media.members[i] = (lane_uint)VXL_NO_MEDIUM;
    return media;
}

/// The sets of the paths from `first` on. Lanes outside `some` get empty sets, since memory beyond
/// a queue's end may hold anything.
static inline MediumSet load_medium_set(global const uint* paths, uint stride, uint first,
                                        lane_int some) {
    global const uint* p = paths + VXL_PATH_INSIDE * (size_t)stride;
    MediumSet media;
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i)
        media.members[i] =
            LANES_SELECT(some, LANES_LOAD(p, (size_t)i * stride + first), (lane_uint)VXL_NO_MEDIUM);
    return media;
}

static inline void store_medium_set(const MediumSet* in, global uint* paths, uint stride,
                                    uint first) {
    global uint* p = paths + VXL_PATH_INSIDE * (size_t)stride;
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i)
        LANES_STORE(in->members[i], p, (size_t)i * stride + first);
}

/// load_medium_set for the paths numbered `path`.
static inline MediumSet gather_medium_set(global const uint* paths, uint stride, lane_uint path,
                                          lane_int some) {
    global const uint* p = paths + VXL_PATH_INSIDE * (size_t)stride;
    MediumSet media;
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i)
        media.members[i] = LANES_SELECT(some, LANES_GATHER_UINT(p + (size_t)i * stride, path),
                                        (lane_uint)VXL_NO_MEDIUM);
    return media;
}

static inline lane_int is_medium(lane_uint member, lane_uint packed) {
    return LANE_MASK(((member ^ packed) & VXL_OBJECT_MASK) == 0u) &
           LANE_MASK(member != VXL_NO_MEDIUM);
}

/// Mask: sets that hold the object with these packed attributes.
static inline lane_int medium_set_holds(const MediumSet* in, lane_uint packed) {
    lane_int holds = (lane_int)0;
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i) holds |= is_medium(in->members[i], packed);
    return holds;
}

/// Does what cross_medium does. Sets `overflowed` to the mask of lanes whose sets had no room for
/// the object that they entered.
static inline MediumSet cross_medium_or_overflow(MediumSet in, lane_uint packed, lane_int leaving,
                                                 lane_int crossing, lane_int* overflowed) {
    const lane_uint none = (lane_uint)VXL_NO_MEDIUM;
    const lane_int out = crossing & leaving;
    lane_int into = crossing & ~leaving & ~medium_set_holds(&in, packed);
    MediumSet crossed;
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i) {
        const lane_uint member =
            LANES_SELECT(out & is_medium(in.members[i], packed), none, in.members[i]);
        const lane_int here = into & LANE_MASK(member == VXL_NO_MEDIUM);
        crossed.members[i] = LANES_SELECT(here, packed, member);
        into &= ~here;
    }
    *overflowed = into;
    return crossed;
}

/// The sets behind a surface of the object of `packed`, in the `crossing` lanes.
static inline MediumSet cross_medium(MediumSet in, lane_uint packed, lane_int leaving,
                                     lane_int crossing) {
    lane_int overflowed;
    return cross_medium_or_overflow(in, packed, leaving, crossing, &overflowed);
}

/// The rank of an object: `ranks[object]` is its index in the order of priorities.
static inline lane_uint rank_of(global const uint* ranks, lane_uint packed) {
    const lane_int some = LANE_MASK(packed != VXL_NO_MEDIUM);
    const lane_uint object = packed & VXL_OBJECT_MASK & LANES_AS_UINT(some);
    return LANES_SELECT(some, LANES_GATHER_UINT(ranks, object), (lane_uint)VXL_NO_MEDIUM);
}

static inline lane_uint first_in_rank(lane_uint packed, lane_uint* rank, lane_uint other,
                                      global const uint* ranks) {
    const lane_uint other_rank = rank_of(ranks, other);
    const lane_int before = LANE_MASK(other_rank < *rank);
    *rank = LANES_SELECT(before, other_rank, *rank);
    return LANES_SELECT(before, other, packed);
}

/// The packed attributes of the effective medium; VXL_NO_MEDIUM outside all objects.
static inline lane_uint effective_medium(const MediumSet* in, global const uint* ranks) {
    lane_uint packed = in->members[0], rank = rank_of(ranks, packed);
    for (int i = 1; i < VXL_MEDIUM_SET_SIZE; ++i)
        packed = first_in_rank(packed, &rank, in->members[i], ranks);
    return packed;
}

/// Mask: pairs of packed attributes, or VXL_NO_MEDIUM, that stand for the same object or both for
/// none.
static inline lane_int same_medium(lane_uint a, lane_uint b) {
    return LANE_MASK(a == b) | (is_medium(a, b) & LANE_MASK(b != VXL_NO_MEDIUM));
}

/// Mask: surfaces that are hidden because the effective medium is the same before and behind them.
/// A ray that leaves an object that its set doesn't hold began inside that object.
static inline lane_int hides_surface(const MediumSet* in, lane_uint packed, lane_int leaving,
                                     global const uint* ranks) {
    const MediumSet before =
        cross_medium(*in, packed, (lane_int)0, leaving & ~medium_set_holds(in, packed));
    const MediumSet behind = cross_medium(before, packed, leaving, (lane_int)-1);
    return same_medium(effective_medium(&before, ranks), effective_medium(&behind, ranks));
}

/// The value of RayBatch::inside for a ray with this medium set.
static inline lane_uint medium_inside(const MediumSet* in, global const uint* ranks) {
    const lane_uint packed = effective_medium(in, ranks);
    const lane_uint material = (packed >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK;
    return LANES_SELECT(LANE_MASK(packed != VXL_NO_MEDIUM), material + 1u, (lane_uint)0);
}

#endif
