// SPDX-License-Identifier: Apache-2.0
// Packets of incoherent rays, whose lanes take further rays as theirs end.
#ifndef VXL_LANE_REFILL_H
#define VXL_LANE_REFILL_H

#include "lib/packets/sight_rays.h"
#include "lib/traverse/ray_queue.h"

/// Stores the hits of the `landing` lanes' rays.
static inline void store_hits(const Packet* f, lane_int landing, const RayBatch* batch) {
    const Hit hit = hit_of(f, is_hit(&f->found, f->t_end));
    const Slots stored = slots_from(0, landing);
    uint rays[VXL_LANES], values[VXL_LANES];
    LANES_STORE(f->ray, rays, 0);
    for (uint i = 0; i < VXL_STORED_COMPONENTS; ++i) {
        LANES_STORE(hit.values[i], values, 0);
        for (uint k = 0; k < stored.count; ++k)
            batch->hits[i * batch->stride + rays[stored.lane[k]]] = values[stored.lane[k]];
    }
}

/// Incoherent rays. Those from `next` to `end` - 1 still wait for a lane.
typedef struct {
    SightRays rays;
    uint next, end;
} ScatteredRays;

/// A packet whose lanes take further rays as theirs end.
typedef struct {
    Packet packet;
    lane_int held, walking, waiting;
} LaneRefill;

/// The minimum number of lanes that a packet keeps walking.
static inline int min_walking(const ScatteredRays* q) {
    return q->next < q->end ? VXL_LANES - VXL_REFILL : 0;
}

/// True while more lanes can take a step than wait in occupied voxels, and both together are more
/// than `minimum`.
static inline bool walks(const LaneRefill* r, int minimum) {
    const int steps = lanes_count(r->walking), tests = lanes_count(r->waiting);
    return steps > tests && steps + tests > minimum;
}

static inline void step_refill(const PyramidView* p, LaneRefill* r) {
    Packet* f = &r->packet;
    walk_on(p, &f->walk, f->t_end, &f->found, &r->walking, &r->waiting);
}

/// Gives the lanes that hold no ray the next ones.
static inline void take_on(const WorldView* world, ScatteredRays* q, LaneRefill* r) {
    const SightRays* s = &q->rays;
    Packet* f = &r->packet;
    const Progress before = progress_of(f);
    const lane_int fresh = take_rays(~r->held, q->end, &q->next, &f->ray);
    set_out(world, &s->batch, s->count, f);
    keep_progress(&before, fresh, f);
    r->held |= fresh;
    r->walking |= fresh & are_rays(s, f) & in_grid(&world->pyramid, &f->walk);
}

static inline LaneRefill begin_refill(const WorldView* world, ScatteredRays* q) {
    LaneRefill r;
    const SightRays* s = &q->rays;
    Packet* f = &r.packet;
    f->ray = (lane_uint)(q->end - 1u);
    r.held = take_rays((lane_int)-1, q->end, &q->next, &f->ray);
    set_out(world, &s->batch, s->count, f);
    r.walking = r.held & are_rays(s, f) & in_grid(&world->pyramid, &f->walk);
    r.waiting = (lane_int)0;
    return r;
}

/// Tests the surfaces at which lanes wait. If too few lanes walk on, stores the hits of the others
/// and gives them further rays.
static inline void serve(const WorldView* world, ScatteredRays* q, LaneRefill* r) {
    Packet* f = &r->packet;
    if (lanes_any(r->waiting))
        meet_surfaces(&world->pyramid, &world->surface, &f->walk, f->t_end, &f->ray_state,
                      &f->found, &r->walking, &r->waiting);
    if (lanes_count(r->walking) > min_walking(q)) return;
    store_hits(f, r->held & ~r->walking, &q->rays.batch);
    r->held &= r->walking;
    if (q->next < q->end) take_on(world, q, r);
}

#endif
