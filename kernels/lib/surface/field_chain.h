// SPDX-License-Identifier: Apache-2.0
// The surface of a solid's parts that pass through one voxel: several fields, whose minimum or
// maximum counts at each point by a formula with or without brackets (shared/voxel.h), so that
// edges between parts stay sharp.
#ifndef VXL_FIELD_CHAIN_H
#define VXL_FIELD_CHAIN_H

#include "lib/surface/smooth.h"

// The maximum number of zeros of a chain's records that a ray passes in search of the chain's own
// zero.
#define VXL_CHAIN_ZEROS 64

#define VXL_NO_RECORD 0xFFFFFFFFu

/// A voxel's chain of records, for each lane: records `begin` to `end` - 1.
typedef struct {
    global const uint* restrict fields;
    lane_uint begin, end;
} FieldChain;

/// Chains that begin with record `begin` of lists that end at `list_end`: it and the records linked
/// to it.
static inline FieldChain chain_from(global const uint* restrict fields, lane_uint begin,
                                    lane_uint list_end, lane_int tested) {
    FieldChain c = {fields, begin, begin + 1u};
    lane_int open = tested & LANE_MASK(c.end < list_end);
    while (lanes_any(open)) {
        const lane_uint word = (c.end & LANES_AS_UINT(open)) * VXL_FIELD_WORDS + VXL_LINK_WORD;
        open &= LANE_MASK((LANES_GATHER_UINT(fields, word) >> VXL_LINK_SHIFT) != 0u);
        c.end += LANES_AS_UINT(open) & 1u;
        open &= LANE_MASK(c.end < list_end);
    }
    return c;
}

/// A chain's value at a point, and the record that the value belongs to.
typedef struct {
    lane_float value;
    lane_uint record;
} ChainValue;

/// Records that have been joined to one another, and the link that will join them to those before
/// them.
typedef struct {
    ChainValue sum;
    lane_uint link;
} JoinedRecords;

/// The open brackets of a chain, the outermost first; the chain itself is number 0.
typedef struct {
    JoinedRecords open[VXL_CHAIN_DEPTH + 1];
    lane_int depth;  // the number of the innermost
} OpenBrackets;

static inline void join_records(ChainValue* all, const JoinedRecords* next, lane_int lanes) {
    const lane_int takes =
        lanes &
        (LANE_MASK(next->link == 0u) |
         (LANE_MASK(next->link == VXL_LINK_UNION) & LANE_MASK(next->sum.value < all->value)) |
         (LANE_MASK(next->link == VXL_LINK_INTERSECTION) &
          LANE_MASK(next->sum.value > all->value)));
    all->value = LANES_SELECT(takes, next->sum.value, all->value);
    all->record = LANES_SELECT(takes, next->sum.record, all->record);
}

/// Closes the brackets above `depth`.
static inline void close_brackets(OpenBrackets* b, lane_int depth, lane_int lanes) {
    for (int i = VXL_CHAIN_DEPTH; i > 0; --i)
        join_records(&b->open[i - 1].sum, &b->open[i],
                     lanes & LANE_MASK(b->depth >= i) & LANE_MASK(depth < i));
    b->depth = LANES_SELECT(lanes, depth, b->depth);
}

/// Closes and opens the brackets in front of a record. The outermost bracket that opens takes over
/// the record's link.
static inline void pass_brackets(const FieldChain* c, OpenBrackets* b, lane_uint record,
                                 lane_uint* link, lane_int lanes) {
    const lane_uint word = (record & LANES_AS_UINT(lanes)) * VXL_FIELD_WORDS;
    const lane_int opens =
        LANES_AS_INT(LANES_GATHER_UINT(c->fields, word + VXL_OPENS_WORD) >> VXL_LINK_SHIFT);
    const lane_int closes =
        LANES_AS_INT(LANES_GATHER_UINT(c->fields, word + VXL_CLOSES_WORD) >> VXL_LINK_SHIFT);
    const lane_int depth = b->depth - closes;
    close_brackets(b, depth, lanes);
    b->depth += opens & lanes;
    for (int i = 1; i <= VXL_CHAIN_DEPTH; ++i) {
        const lane_int opened = lanes & LANE_MASK(b->depth >= i) & LANE_MASK(depth < i);
        b->open[i].link = LANES_SELECT(opened, *link, b->open[i].link);
        *link = LANES_SELECT(opened, (lane_uint)0u, *link);
    }
}

/// A position on a ray's way through a chain's fields, from one record's zero to the next.
typedef struct {
    lane_float u;       // the position along the ray
    lane_uint record;   // the record whose zero lies there; VXL_NO_RECORD at the start
    lane_float beyond;  // that record's sign from there on
} ChainWay;

static inline ChainWay chain_way(void) {
    const ChainWay way = {(lane_float)0.0f, (lane_uint)VXL_NO_RECORD, (lane_float)1.0f};
    return way;
}

/// The chain's value just behind a position, with `shift` added to all records.
static INLINED ChainValue chain_behind(const FieldChain* c, const LocalRay* ray,
                                       const ChainWay* way, lane_float shift, lane_int tested) {
    OpenBrackets b;
    for (int i = 0; i <= VXL_CHAIN_DEPTH; ++i) {
        const JoinedRecords none = {{(lane_float)0.0f, c->begin}, (lane_uint)0u};
        b.open[i] = none;
    }
    b.depth = (lane_int)0;
    lane_uint number = c->begin;
    for (lane_int left = tested; lanes_any(left); left &= LANE_MASK(number < c->end)) {
        const lane_uint here = number & LANES_AS_UINT(left);
        const Field field = read_field(c->fields, here);
        lane_uint link =
            LANES_GATHER_UINT(c->fields, here * VXL_FIELD_WORDS + VXL_LINK_WORD) >> VXL_LINK_SHIFT;
        const lane_float along = field_along(&field, ray, (lane_float)1.0f, way->u) + shift;
        const lane_float value =
            LANES_SELECT(LANE_MASK(number == way->record), way->beyond * FLT_MIN, along);
        if (VXL_CHAIN_DEPTH > 0) pass_brackets(c, &b, here, &link, left);
        const JoinedRecords next = {{value, number}, link};
        for (int i = 0; i <= VXL_CHAIN_DEPTH; ++i)
            join_records(&b.open[i].sum, &next,
                         VXL_CHAIN_DEPTH > 0 ? left & LANE_MASK(b.depth == i) : left);
        number += 1u;
    }
    if (VXL_CHAIN_DEPTH > 0) close_brackets(&b, (lane_int)0, tested);
    return b.open[0].sum;
}

/// Moves to the next zero of any record plus `shift`, up to `u_exit`. Returns the mask of lanes
/// that have one.
static INLINED lane_int next_zero(const FieldChain* c, const LocalRay* ray, lane_float shift,
                                  lane_float u_exit, lane_int tested, ChainWay* way) {
    const lane_float start = way->u, beyond = way->beyond;
    const lane_uint last = way->record;
    lane_int found = (lane_int)0;
    lane_uint number = c->begin;
    for (lane_int left = tested; lanes_any(left); left &= LANE_MASK(number < c->end)) {
        const Field field = read_field(c->fields, number & LANES_AS_UINT(left));
        const lane_float value = field_along(&field, ray, (lane_float)1.0f, start) + shift;
        lane_float side =
            LANES_SELECT(LANE_MASK(value < 0.0f), (lane_float)-1.0f, (lane_float)1.0f);
        side = LANES_SELECT(LANE_MASK(number == last), beyond, side);
        lane_float at;
        const lane_int crossed = first_zero(&field, ray, side, side * shift, start, u_exit,
                                            fmax(side * value, 0.0f), left, &at);
        const lane_int nearer = crossed & (~found | LANE_MASK(at < way->u));
        way->u = LANES_SELECT(nearer, at, way->u);
        way->record = LANES_SELECT(nearer, number, way->record);
        way->beyond = LANES_SELECT(nearer, -side, way->beyond);
        found |= nearer;
        number += 1u;
    }
    return found;
}

/// What hit_smooth does, for chains. Sets `record` to the records that are hit.
static INLINED lane_int hit_chain(const FieldChain* c, const Walk* w, float plane_bound,
                                  lane_int tested, FieldApproach* from, lane_float* level,
                                  lane_float* t_hit, lane_uint* record) {
    const LocalRay ray = local_ray(w);
    const lane_float u_exit = fmax(exit_time(w) - w->t, 0.0f);
    ChainWay way = chain_way();
    const ChainValue entry = chain_behind(c, &ray, &way, (lane_float)0.0f, tested);
    const FieldEntry e = enter_field(entry.value, plane_bound, tested, from, level);
    lane_int met = tested & ~e.beginning & LANE_MASK(e.value + *level < 0.0f);
    *t_hit = LANES_SELECT(met, w->t, *t_hit);
    *record = LANES_SELECT(met, entry.record, *record);
    const lane_float shift = e.side * *level;
    // Where surfaces of parts coincide, rounding must not decide which of them is met first.
    const lane_float met_at_once = shift - e.side * (2.0f * VXL_FIELD_ROUNDING);
    lane_int searching = tested & ~met;
    for (int zero = 0; zero < VXL_CHAIN_ZEROS && lanes_any(searching); ++zero) {
        searching = next_zero(c, &ray, shift, u_exit, searching, &way);
        if (!lanes_any(searching)) break;
        const ChainValue behind = chain_behind(c, &ray, &way, met_at_once, searching);
        const lane_int ends = searching & LANE_MASK(e.side * behind.value < 0.0f);
        *t_hit = LANES_SELECT(ends, w->t + way.u, *t_hit);
        *record = LANES_SELECT(ends, way.record, *record);
        met |= ends;
        searching &= ~ends;
    }
    return met;
}

#endif
