// The set of transmitting objects that a ray is inside of.
//
// What counts of them is the one whose object comes first in the order of priorities, so nothing
// depends on the order in which their surfaces were crossed.
#ifndef VXL_INTERIOR_H
#define VXL_INTERIOR_H

#include "lib/lanes/lanes.h"
#include "shared/trace.h"
#include "shared/voxel.h"

// The build constant says how many others a scene needs.
#define VXL_INTERIOR_MEMBERS (1 + VXL_OTHER_MEMBERS)

/// Attribute words, VXL_NO_MEMBER for none: the smooth body's, then the others'.
typedef struct {
    lane_uint members[VXL_INTERIOR_MEMBERS];
} Interior;

static inline Interior empty_interior(void) {
    Interior interior;
    for (int i = 0; i < VXL_INTERIOR_MEMBERS; ++i) interior.members[i] = (lane_uint)VXL_NO_MEMBER;
    return interior;
}

/// The sets of the paths from `first` on. Lanes that are not of `some` are inside of nothing:
/// beyond a queue's end there may be anything, and no object's number.
static inline Interior load_interior(global const uint* paths, uint stride, uint first,
                                     lane_int some) {
    global const uint* p = paths + VXL_PATH_INSIDE * (size_t)stride;
    Interior interior;
    for (int i = 0; i < VXL_INTERIOR_MEMBERS; ++i)
        interior.members[i] =
            LANES_SELECT(some, LANES_LOAD(p, (size_t)i * stride + first), (lane_uint)VXL_NO_MEMBER);
    return interior;
}

static inline void store_interior(const Interior* in, global uint* paths, uint stride, uint first) {
    global uint* p = paths + VXL_PATH_INSIDE * (size_t)stride;
    for (int i = 0; i < VXL_INTERIOR_MEMBERS; ++i)
        LANES_STORE(in->members[i], p, (size_t)i * stride + first);
}

/// load_interior of the paths numbered `path`.
static inline Interior gather_interior(global const uint* paths, uint stride, lane_uint path,
                                       lane_int some) {
    global const uint* p = paths + VXL_PATH_INSIDE * (size_t)stride;
    Interior interior;
    for (int i = 0; i < VXL_INTERIOR_MEMBERS; ++i)
        interior.members[i] = LANES_SELECT(some, LANES_GATHER_UINT(p + (size_t)i * stride, path),
                                           (lane_uint)VXL_NO_MEMBER);
    return interior;
}

static inline lane_int is_member(lane_uint member, lane_uint word) {
    return LANE_MASK(((member ^ word) & VXL_OBJECT_MASK) == 0u) &
           LANE_MASK(member != VXL_NO_MEMBER);
}

/// Mask: the set holds the object of an attribute word, which shows the smooth body or not.
static inline lane_int interior_holds(const Interior* in, lane_uint word, lane_int smooth) {
    lane_int other = (lane_int)0;
    for (int i = 1; i < VXL_INTERIOR_MEMBERS; ++i) other |= is_member(in->members[i], word);
    return (smooth & LANE_MASK(in->members[0] != VXL_NO_MEMBER)) | (~smooth & other);
}

/// cross_interior; `lost` is the mask of lanes whose sets had no room for what they came into.
static inline Interior cross_interior_or_lose(Interior in, lane_uint word, lane_int smooth,
                                              lane_int leaving, lane_int crossing, lane_int* lost) {
    const lane_uint none = (lane_uint)VXL_NO_MEMBER;
    in.members[0] =
        LANES_SELECT(crossing & smooth, LANES_SELECT(leaving, none, word), in.members[0]);
    const lane_int other = crossing & ~smooth;
    const lane_int out = other & leaving;
    lane_int into = other & ~leaving & ~interior_holds(&in, word, (lane_int)0);
    for (int i = 1; i < VXL_INTERIOR_MEMBERS; ++i) {
        const lane_uint member =
            LANES_SELECT(out & is_member(in.members[i], word), none, in.members[i]);
        const lane_int here = into & LANE_MASK(member == VXL_NO_MEMBER);
        in.members[i] = LANES_SELECT(here, word, member);
        into &= ~here;
    }
    *lost = into;
    return in;
}

/// The set behind a surface of the object of `word`, in the lanes that cross it.
static inline Interior cross_interior(Interior in, lane_uint word, lane_int smooth,
                                      lane_int leaving, lane_int crossing) {
    lane_int lost;
    return cross_interior_or_lose(in, word, smooth, leaving, crossing, &lost);
}

/// `ranks[object]` is the object's place in the order of priorities.
static inline lane_uint rank_of(global const uint* ranks, lane_uint word) {
    const lane_int some = LANE_MASK(word != VXL_NO_MEMBER);
    const lane_uint object = word & VXL_OBJECT_MASK & LANES_AS_UINT(some);
    return LANES_SELECT(some, LANES_GATHER_UINT(ranks, object), (lane_uint)VXL_NO_MEMBER);
}

static inline lane_uint first_in_rank(lane_uint word, lane_uint* rank, lane_uint other,
                                      global const uint* ranks) {
    const lane_uint other_rank = rank_of(ranks, other);
    const lane_int before = LANE_MASK(other_rank < *rank);
    *rank = LANES_SELECT(before, other_rank, *rank);
    return LANES_SELECT(before, other, word);
}

/// The attribute word of the object that counts, VXL_NO_MEMBER in open space.
static inline lane_uint effective_member(const Interior* in, global const uint* ranks) {
    lane_uint word = in->members[0], rank = rank_of(ranks, word);
    for (int i = 1; i < VXL_INTERIOR_MEMBERS; ++i)
        word = first_in_rank(word, &rank, in->members[i], ranks);
    return word;
}

/// Mask: two attribute words, or VXL_NO_MEMBER, stand for the same object or for none.
static inline lane_int same_member(lane_uint a, lane_uint b) {
    return LANE_MASK(a == b) | (is_member(a, b) & LANE_MASK(b != VXL_NO_MEMBER));
}

/// Mask: a surface is hidden, for the object that counts is the same before and behind it. Who
/// leaves an object that the set doesn't hold began inside of it.
static inline lane_int hides_surface(const Interior* in, lane_uint word, lane_int smooth,
                                     lane_int leaving, global const uint* ranks) {
    const Interior before =
        cross_interior(*in, word, smooth, (lane_int)0, leaving & ~interior_holds(in, word, smooth));
    const Interior behind = cross_interior(before, word, smooth, leaving, (lane_int)-1);
    return same_member(effective_member(&before, ranks), effective_member(&behind, ranks));
}

/// RayBatch::inside of a ray inside of the object that counts.
static inline lane_uint medium_inside(const Interior* in, global const uint* ranks) {
    const lane_uint word = effective_member(in, ranks);
    const lane_uint material = (word >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK;
    return LANES_SELECT(LANE_MASK(word != VXL_NO_MEMBER), material + 1u, (lane_uint)0);
}

#endif
