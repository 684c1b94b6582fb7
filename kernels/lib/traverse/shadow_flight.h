// Packets of shadow rays on their way to their light.
//
// Where rays run anywhere, lanes take on further rays as theirs end: a ray that has met a
// transmitting surface goes on behind it while others walk, and lanes whose rays have ended wait
// until several have. Else a packet would wait for the ray that meets most surfaces.
#ifndef VXL_SHADOW_FLIGHT_H
#define VXL_SHADOW_FLIGHT_H

#include "lib/light/filter.h"
#include "lib/light/light_beams.h"
#include "lib/traverse/ray_queue.h"

#define VXL_SHADOWS_FLY VXL_SHADOW_RAYS_FLY(VXL_PATHS, VXL_SMOOTH, VXL_EXACT, VXL_INSTANCES)
#define VXL_SHADOW_PACKETS \
    (VXL_SHADOWS_FLY ? VXL_PACKETS(VXL_LANES) : VXL_FILTER ? 1u : VXL_PACKET_TURNS)

/// A queue of shadow rays, and the paths and hits of the rays that met the surfaces where they
/// begin.
typedef struct {
    global const float* restrict rays;
    global const uint* restrict targets;
    global const uint* restrict sources;
    global const uint* restrict paths;
    global const uint* restrict hits;
    global const float* restrict shares;
    uint stride;
    BeamGrid beam_grid;  // of the light that they run to
    global const float* restrict beam_ends;
} ShadowRays;

/// Shadow rays on their way.
typedef struct {
    Flight flight;
    Filter filter;
} ShadowFlight;

/// Sets the rays that the lanes hold on their way; `fresh` lanes hold new ones.
static inline void send_shadows(const SurfaceView* s, const FilterView* v, PyramidShape shape,
                                const ShadowRays* q, lane_int fresh, ShadowFlight* f) {
    Flight* flight = &f->flight;
    Walk* w = &flight->walk;
    *w = walk_of(q->rays, q->stride, flight->ray, VXL_SHADOWS_FLY);
    flight->t_end = VXL_RAY_FLOATS(q->rays + VXL_RAY_END * q->stride, flight->ray, VXL_SHADOWS_FLY);
    if (!VXL_FILTER && q->beam_grid.columns > 0)
        flight->t_end = fmin(flight->t_end, clear_from(&q->beam_grid, q->beam_ends, w));
    Travel* travel = &flight->travel;
    *travel = sight_travel();
    travel->on_surface = (lane_int)-1;
    const lane_uint target =
        VXL_RAY_UINTS(q->targets, flight->ray, VXL_SHADOWS_FLY) & LANES_AS_UINT(fresh);
    if (VXL_EXACT) travel->source = VXL_RAY_UINTS(q->sources, flight->ray, VXL_SHADOWS_FLY);
    if (VXL_INSTANCES)
        travel->instance = LANES_GATHER_UINT(q->hits + VXL_HIT_INSTANCE * q->stride, target);
    if (VXL_SOLIDS) {
        const SolidRay ray = {w->ox, w->oy, w->oz, w->dx, w->dy, w->dz};
        const lane_int solid = LANE_MASK((travel->source & VXL_SOLID_PRIMITIVE) != 0u) &
                               LANE_MASK(travel->source != VXL_NO_PRIMITIVE) & fresh;
        travel->asks_side = solid & LANE_MASK(travel->instance != VXL_NO_INSTANCE);
        const lane_int asked = solid & ~travel->asks_side;
        if (lanes_any(asked))
            travel->within_source =
                go_inside(s->solids, travel->source & ~VXL_SOLID_PRIMITIVE & LANES_AS_UINT(asked),
                          &ray, asked);
    }
    flight->found = found_nothing(travel);
    if (!VXL_FILTER) return;
    // The paths are those of the rays that met the surface: on its same side light arrives.
    travel->interior = gather_interior(q->paths, q->stride, target, fresh);
    if (VXL_CUBE_BODIES) find_body(travel, v->materials);
    f->filter = begin_filter(shape, w, flight->t_end);
}

/// Puts lanes that are not `fresh` back to what their rays have come to on their way.
static inline void keep_way(const ShadowFlight* before, lane_int fresh, ShadowFlight* f) {
    const Travel* was = &before->flight.travel;
    Travel* travel = &f->flight.travel;
    if (VXL_EXACT)
        travel->within_source = LANES_SELECT(fresh, travel->within_source, was->within_source);
    if (!VXL_FILTER) return;
    travel->goes_on = LANES_SELECT(fresh, travel->goes_on, was->goes_on);
    if (VXL_EXACT) travel->source = LANES_SELECT(fresh, travel->source, was->source);
    travel->t_first = LANES_SELECT(fresh, travel->t_first, was->t_first);
    for (int i = 0; i < VXL_INTERIOR_MEMBERS; ++i)
        travel->interior.members[i] =
            LANES_SELECT(fresh, travel->interior.members[i], was->interior.members[i]);
    if (VXL_CUBE_BODIES) {
        travel->body = LANES_SELECT(fresh, travel->body, was->body);
        travel->joined = LANES_SELECT(fresh, travel->joined, was->joined);
    }
    const Filter* old = &before->filter;
    for (int channel = 0; channel < 3; ++channel) {
        f->filter.passed[channel] =
            LANES_SELECT(fresh, f->filter.passed[channel], old->passed[channel]);
        f->filter.depth[channel] =
            LANES_SELECT(fresh, f->filter.depth[channel], old->depth[channel]);
    }
    f->filter.t_last = LANES_SELECT(fresh, f->filter.t_last, old->t_last);
    f->filter.layers = LANES_SELECT(fresh, f->filter.layers, old->layers);
}

/// Adds what the `arrived` ones of the `held` rays bring to the radiance of the rays that they were
/// sent for: all at once where these are in a row.
static inline void bring_light(const ShadowRays* q, const ShadowFlight* f, lane_int held,
                               lane_int arrived, global float* restrict radiance) {
    const lane_uint target = VXL_RAY_UINTS(q->targets, f->flight.ray, VXL_SHADOWS_FLY);
    const uint first = LANES_FIRST(target);
    const lane_int beside = LANE_MASK(target - first == LANES_AS_UINT(LANES_NUMBERS));
    const bool in_a_row = VXL_LANES > 1 && !lanes_any(~(held & beside));
    const Places places = places_from(0, in_a_row ? (lane_int)0 : arrived);
    uint targets[VXL_LANES];
    LANES_STORE(target, targets, 0);
    for (int channel = 0; channel < 3; ++channel) {
        lane_float share =
            VXL_RAY_FLOATS(q->shares + channel * q->stride, f->flight.ray, VXL_SHADOWS_FLY);
        if (VXL_FILTER) share *= f->filter.passed[channel] * exact_exp(-f->filter.depth[channel]);
        global float* restrict sums = radiance + channel * q->stride;
        if (in_a_row) {
            const lane_float sum = LANES_LOAD(sums, first);
            LANES_STORE(LANES_SELECT(arrived, sum + share, sum), sums, first);
            continue;
        }
        float shares[VXL_LANES];
        LANES_STORE(share, shares, 0);
        for (uint i = 0; i < places.count; ++i)
            sums[targets[places.lane[i]]] += shares[places.lane[i]];
    }
}

#if VXL_SHADOWS_FLY
/// Traces the queue's rays `next` .. `end` - 1, at least one.
static inline void fly_shadows(const PyramidView* p, const SurfaceView* s, const FilterView* v,
                               PyramidShape shape, const ShadowRays* q, uint next, uint end,
                               global float* restrict radiance) {
    ShadowFlight f;
    Flight* flight = &f.flight;
    flight->ray = (lane_uint)next;
    lane_int held = take_rays((lane_int)-1, end, &next, &flight->ray);
    send_shadows(s, v, shape, q, held, &f);
    lane_int walking = held & in_grid(p, &flight->walk), waiting = (lane_int)0;
    while (lanes_any(held)) {
        int steps = lanes_count(walking), tests = 0;
        const int least = max(lanes_count(held) - VXL_REFILL, 0);
        while (steps > tests && steps + tests > least) {
            walk_on(p, &flight->walk, flight->t_end, &flight->found, &walking, &waiting);
            steps = lanes_count(walking), tests = lanes_count(waiting);
        }
        if (tests > 0)
            meet_surfaces(p, s, &flight->walk, flight->t_end, &flight->travel, &flight->found,
                          &walking, &waiting);
        if (lanes_count(walking) > least) continue;
        const lane_int ended = held & ~walking;
        const lane_int hit = is_hit(&flight->found, flight->t_end) & ended;
        lane_int passing = (lane_int)0;
        if (VXL_FILTER)
            passing = pass_surface(p, s, v, &flight->walk, &flight->found, ended, hit,
                                   &flight->travel, &f.filter);
        if (lanes_any(ended & ~hit)) bring_light(q, &f, held, ended & ~hit, radiance);
        held &= walking | passing;
        if (VXL_FILTER) {
            const Found nothing = found_nothing(&flight->travel);
            take_found(&nothing, passing, &flight->found);
            walking |= passing & in_grid(p, &flight->walk);
        }
        if (next >= end) continue;
        const Progress before = progress_of(flight);
        const ShadowFlight old = f;
        const lane_int fresh = take_rays(~held, end, &next, &flight->ray);
        send_shadows(s, v, shape, q, fresh, &f);
        keep_progress(&before, fresh, flight);
        keep_way(&old, fresh, &f);
        held |= fresh;
        walking |= fresh & in_grid(p, &flight->walk);
    }
}

#else

/// The mask of the `active` rays that reach their light.
static inline lane_int find_lights(const PyramidView* p, const SurfaceView* s, const FilterView* v,
                                   lane_int active, ShadowFlight* f) {
    Flight* flight = &f->flight;
    lane_int passing = active, arrived = (lane_int)0;
    while (lanes_any(passing)) {
        flight->found = find_nearest(p, s, &v->instances, &flight->walk, flight->t_end, passing,
                                     !VXL_FILTER, &flight->travel);
        const lane_int hit = flight->found.hit & passing;
        arrived |= passing & ~hit;
        if (!VXL_FILTER) break;
        passing = pass_surface(p, s, v, &flight->walk, &flight->found, passing, hit,
                               &flight->travel, &f->filter);
    }
    return arrived;
}

#endif
#endif
