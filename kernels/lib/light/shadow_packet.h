// SPDX-License-Identifier: Apache-2.0
// Packets of shadow rays on their way to their light.
//
// Where rays are incoherent and walk, lanes take further rays as theirs end: a ray that has met a
// transmitting surface continues behind it while others walk, and lanes whose rays have ended wait
// until several have ended. Otherwise a packet would wait for the ray that meets the most surfaces.
#ifndef VXL_SHADOW_PACKET_H
#define VXL_SHADOW_PACKET_H

#include "lib/light/filter.h"
#include "lib/light/light_beams.h"
#include "lib/traverse/ray_queue.h"

#define VXL_REFILLS_SHADOWS \
    VXL_REFILLS_SHADOW_LANES(VXL_PATHS, VXL_SMOOTH, VXL_EXACT, VXL_INSTANCES, VXL_SOLIDS_AHEAD)
#define VXL_SHADOW_PACKETS \
    (VXL_REFILLS_SHADOWS ? VXL_PACKETS(VXL_LANES) : VXL_FILTER ? 1u : VXL_PACKETS_INTERLEAVED)

/// A queue of shadow rays, and the batch of the rays that met the surfaces where they begin.
typedef struct {
    ShadowQueue queue;
    RayBatch batch;
} ShadowRays;

/// Shadow rays on their way.
typedef struct {
    Packet packet;
    Filter filter;
} ShadowPacket;

/// Starts the rays that the lanes hold; `fresh` lanes hold new ones.
static inline void send_shadows(const WorldView* world, const Surroundings* around,
                                const ShadowRays* s, lane_int fresh, ShadowPacket* f) {
    const ShadowQueue* q = &s->queue;
    const RayBatch* batch = &s->batch;
    const uint stride = batch->stride;
    Packet* packet = &f->packet;
    Walk* w = &packet->walk;
    *w = walk_of(q->rays, stride, packet->ray, VXL_REFILLS_SHADOWS);
    packet->t_end =
        VXL_RAY_FLOATS(q->rays + VXL_RAY_END * stride, packet->ray, VXL_REFILLS_SHADOWS);
    if (!VXL_FILTER && q->beam_grid.columns > 0)
        packet->t_end = fmin(packet->t_end, clear_from(&q->beam_grid, q->beam_ends, w));
    RayState* ray_state = &packet->ray_state;
    *ray_state = sight_ray_state();
    ray_state->on_surface = (lane_int)-1;
    const lane_uint target =
        VXL_RAY_UINTS(q->targets, packet->ray, VXL_REFILLS_SHADOWS) & LANES_AS_UINT(fresh);
    if (VXL_SCATTERING)  // points in the medium have met nothing
        ray_state->on_surface = LANE_MASK(
            LANES_GATHER_UINT(batch->hits + VXL_HIT_VOXEL * stride, target) != VXL_NO_VOXEL);
    if (VXL_SOURCES)
        ray_state->source = VXL_RAY_UINTS(q->sources, packet->ray, VXL_REFILLS_SHADOWS);
    if (VXL_INSTANCES)
        ray_state->instance = LANES_GATHER_UINT(batch->hits + VXL_HIT_INSTANCE * stride, target);
    if (VXL_MIXED) find_mixed_mesh(world, LANE_MASK(packet->ray < *q->count), ray_state);
    if (VXL_SOLIDS) {
        const SolidRay ray = {w->ox, w->oy, w->oz, w->dx, w->dy, w->dz};
        const lane_int solid = LANE_MASK((ray_state->source & VXL_SOLID_PRIMITIVE) != 0u) &
                               LANE_MASK(ray_state->source != VXL_NO_PRIMITIVE) & fresh;
        ray_state->asks_side = solid & LANE_MASK(ray_state->instance != VXL_NO_INSTANCE);
        const lane_int asked = solid & ~ray_state->asks_side;
        if (lanes_any(asked))
            ray_state->within_source = go_inside(
                world->surface.solids,
                ray_state->source & ~VXL_SOLID_PRIMITIVE & LANES_AS_UINT(asked), &ray, asked);
    }
    packet->found = no_hit_yet();
    if (!VXL_FILTER) return;
    // The medium sets are those of the rays that met the surface: light arrives on the side that
    // these rays came from.
    ray_state->media = gather_medium_set(batch->paths, stride, target, fresh);
    if (VXL_CUBE_BODIES) find_body(ray_state, around->materials);
    f->filter = begin_filter(world->shape, w, packet->t_end);
}

/// Restores the state that the rays of lanes which are not `fresh` had reached.
static inline void keep_way(const ShadowPacket* before, lane_int fresh, ShadowPacket* f) {
    const RayState* was = &before->packet.ray_state;
    RayState* ray_state = &f->packet.ray_state;
    if (VXL_EXACT)
        ray_state->within_source =
            LANES_SELECT(fresh, ray_state->within_source, was->within_source);
    if (VXL_SCATTERING)
        ray_state->on_surface = LANES_SELECT(fresh, ray_state->on_surface, was->on_surface);
    if (!VXL_FILTER) return;
    ray_state->goes_on = LANES_SELECT(fresh, ray_state->goes_on, was->goes_on);
    if (VXL_SOURCES) ray_state->source = LANES_SELECT(fresh, ray_state->source, was->source);
    ray_state->t_first = LANES_SELECT(fresh, ray_state->t_first, was->t_first);
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i)
        ray_state->media.members[i] =
            LANES_SELECT(fresh, ray_state->media.members[i], was->media.members[i]);
    if (VXL_CUBE_BODIES) {
        ray_state->body = LANES_SELECT(fresh, ray_state->body, was->body);
        ray_state->joined = LANES_SELECT(fresh, ray_state->joined, was->joined);
    }
    const Filter* old = &before->filter;
    for (int channel = 0; channel < 3; ++channel) {
        f->filter.throughput[channel] =
            LANES_SELECT(fresh, f->filter.throughput[channel], old->throughput[channel]);
        f->filter.depth[channel] =
            LANES_SELECT(fresh, f->filter.depth[channel], old->depth[channel]);
    }
    f->filter.t_last = LANES_SELECT(fresh, f->filter.t_last, old->t_last);
    f->filter.layers = LANES_SELECT(fresh, f->filter.layers, old->layers);
}

/// Adds the light of the `arrived` rays among those `held` to the radiance of the rays that they
/// were sent for. Neighbours in memory are added all at once.
static inline void bring_light(const ShadowRays* s, const ShadowPacket* f, lane_int held,
                               lane_int arrived) {
    const uint stride = s->batch.stride;
    const lane_uint target = VXL_RAY_UINTS(s->queue.targets, f->packet.ray, VXL_REFILLS_SHADOWS);
    const uint first = LANES_FIRST(target);
    const lane_int neighbours = LANE_MASK(target - first == LANES_AS_UINT(LANES_NUMBERS));
    const bool in_a_row = VXL_LANES > 1 && !lanes_any(~(held & neighbours));
    const Slots slots = slots_from(0, in_a_row ? (lane_int)0 : arrived);
    uint targets[VXL_LANES];
    LANES_STORE(target, targets, 0);
    for (int channel = 0; channel < 3; ++channel) {
        lane_float contribution = VXL_RAY_FLOATS(s->queue.contributions + channel * stride,
                                                 f->packet.ray, VXL_REFILLS_SHADOWS);
        if (VXL_FILTER)
            contribution *= f->filter.throughput[channel] * exact_exp(-f->filter.depth[channel]);
        global float* restrict sums = s->batch.radiance + channel * stride;
        if (in_a_row) {
            const lane_float sum = LANES_LOAD(sums, first);
            LANES_STORE(LANES_SELECT(arrived, sum + contribution, sum), sums, first);
            continue;
        }
        float contributions[VXL_LANES];
        LANES_STORE(contribution, contributions, 0);
        for (uint i = 0; i < slots.count; ++i)
            sums[targets[slots.lane[i]]] += contributions[slots.lane[i]];
    }
}

#if VXL_REFILLS_SHADOWS
/// Traces the queue's rays `next` .. `end` - 1, of which there is at least one.
static inline void trace_refilled_shadows(const WorldView* world, const Surroundings* around,
                                          const ShadowRays* q, uint next, uint end) {
    const PyramidView* p = &world->pyramid;
    ShadowPacket f;
    Packet* packet = &f.packet;
    packet->ray = (lane_uint)next;
    lane_int held = take_rays((lane_int)-1, end, &next, &packet->ray);
    send_shadows(world, around, q, held, &f);
    lane_int walking = held & in_grid(p, &packet->walk), waiting = (lane_int)0;
    while (lanes_any(held)) {
        int steps = lanes_count(walking), tests = 0;
        const int minimum = max(lanes_count(held) - VXL_REFILL, 0);
        while (steps > tests && steps + tests > minimum) {
            walk_on(p, &packet->walk, packet->t_end, &packet->found, &walking, &waiting);
            steps = lanes_count(walking), tests = lanes_count(waiting);
        }
        if (tests > 0)
            meet_surfaces(p, &world->surface, &packet->walk, packet->t_end, &packet->ray_state,
                          &packet->found, &walking, &waiting);
        if (lanes_count(walking) > minimum) continue;
        const lane_int ended = held & ~walking;
        const lane_int hit = is_hit(&packet->found, packet->t_end) & ended;
        lane_int passing = (lane_int)0;
        if (VXL_FILTER) passing = pass_surface(world, around, packet, ended, hit, &f.filter);
        if (lanes_any(ended & ~hit)) bring_light(q, &f, held, ended & ~hit);
        held &= walking | passing;
        if (VXL_FILTER) {
            const SurfaceHit nothing = no_hit_yet();
            take_hit(&nothing, passing, &packet->found);
            walking |= passing & in_grid(p, &packet->walk);
        }
        if (next >= end) continue;
        const Progress before = progress_of(packet);
        const ShadowPacket old = f;
        const lane_int fresh = take_rays(~held, end, &next, &packet->ray);
        send_shadows(world, around, q, fresh, &f);
        keep_progress(&before, fresh, packet);
        keep_way(&old, fresh, &f);
        held |= fresh;
        walking |= fresh & in_grid(p, &packet->walk);
    }
}

#else

/// The mask of the `active` rays that reach their light.
static INLINED lane_int find_lights(const WorldView* world, const Surroundings* around,
                                    lane_int active, ShadowPacket* f) {
    Packet* packet = &f->packet;
    lane_int passing = active, arrived = (lane_int)0;
    while (lanes_any(passing)) {
        if (VXL_SOLIDS_AHEAD)  // the cell of the hit doesn't matter
            packet->found = find_solid(&world->pyramid, &world->surface, &packet->walk,
                                       packet->t_end, passing, &packet->ray_state);
        else
            packet->found = find_nearest(world, &packet->walk, packet->t_end, passing, !VXL_FILTER,
                                         &packet->ray_state);
        const lane_int hit = packet->found.hit & passing;
        arrived |= passing & ~hit;
        if (!VXL_FILTER) break;
        passing = pass_surface(world, around, packet, passing, hit, &f->filter);
    }
    return arrived;
}

#endif
#endif
