// SPDX-License-Identifier: Apache-2.0
// rays -> hits: the discrete walk of every ray through the world to the first surface that it
// meets.
#include "lib/lanes/work_item.h"
#include "lib/light/shadow_packet.h"
#include "lib/packets/begin_inside.h"
#include "lib/packets/lane_refill.h"
#include "lib/packets/sight_rays.h"
#include "shared/scene.h"

/// Finds the closest hits of the rays 0 .. count-1: coherent ones, and all where lanes aren't
/// refilled. Arrays hold a multiple of 16 rays. Hits don't depend on whether there are beams.
kernel void trace_closest(VXL_WORLD_PARAMETERS, VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * (VXL_LANES * VXL_PACKETS_INTERLEAVED);
    if (first >= count) return;
    const WorldView world = VXL_WORLD;
    const SightRays q = {VXL_BATCH, count};
    Packet f;
    bool sent = send_packet(&world, &q, first, &f);
    if (VXL_PACKETS_INTERLEAVED > 1) {
        Packet g;
        const bool also = send_packet(&world, &q, first + VXL_LANES, &g);
        if (sent && also) {
            find_interleaved(&world.pyramid, &world.surface, &f, are_rays(&q, &f), &g,
                             are_rays(&q, &g));
            store_packet(&q, &f);
            store_packet(&q, &g);
            return;
        }
        if (also) f = g;
        sent |= also;
    }
    if (!sent) return;
    f.found = find_nearest(&world, &f.walk, f.t_end, are_rays(&q, &f), false, &f.ray_state);
    store_packet(&q, &f);
}

#if VXL_REFILLS
/// Finds the closest hits of the incoherent rays 0 .. count-1, which are reflected or refracted.
///
/// A work-item traces the rays of VXL_PACKETS(VXL_LANES) packets in two interleaved packets. Lanes
/// whose rays have ended wait until several have ended; then the hits are stored, and the lanes
/// take the next rays. The hits are bit for bit those of trace_closest.
kernel void trace_scattered(VXL_WORLD_PARAMETERS, VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * (VXL_LANES * VXL_PACKETS(VXL_LANES));
    if (first >= count) return;
    const WorldView world = VXL_WORLD;
    const PyramidView* p = &world.pyramid;
    ScatteredRays q = {
        {VXL_BATCH, count},
        first,
        min(first + VXL_LANES * VXL_PACKETS(VXL_LANES), (count + VXL_LANES - 1u) & -VXL_LANES)};
    LaneRefill a = begin_refill(&world, &q);
    if (VXL_LANES > 1 && q.next < q.end) {
        LaneRefill b = begin_refill(&world, &q);
        while (lanes_any(a.held) && lanes_any(b.held)) {
            const int minimum = min_walking(&q);
            bool on_a = walks(&a, minimum), on_b = walks(&b, minimum);
            while (on_a && on_b) {
                step_refill(p, &a);
                step_refill(p, &b);
                on_a = walks(&a, minimum);
                on_b = walks(&b, minimum);
            }
            if (!on_a) serve(&world, &q, &a);
            if (!on_b) serve(&world, &q, &b);
        }
        if (lanes_any(b.held)) a = b;
    }
    while (lanes_any(a.held)) {
        const int minimum = min_walking(&q);
        while (walks(&a, minimum)) step_refill(p, &a);
        serve(&world, &q, &a);
    }
}
#endif

#if VXL_OBSERVER_IN_MEDIUM
/// Adds to the medium sets of rays 0 .. count-1, as begin_paths left them, the objects that only
/// tracing finds; see find_beginnings. `maximum` is the number of such objects in the scene, where
/// all smooth objects count as one.
kernel void begin_inside(VXL_WORLD_PARAMETERS, VXL_SURROUNDINGS_PARAMETERS,
                         global const uint* restrict hollow, uint maximum, VXL_BATCH_PARAMETERS,
                         uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    WorldView world = VXL_WORLD;
    // Shows the instances of `hollow` objects alone: opaque cubes of others would stop rays
    // repeatedly, which then have to be continued.
    world.instances.shown = hollow;
    const Surroundings around = VXL_SURROUNDINGS;
    const RayBatch batch = VXL_BATCH;
    Packet f;
    f.ray = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    set_out(&world, &batch, count, &f);
    MediumSet in = f.ray_state.media;
    const lane_int active = LANE_MASK(f.t_end >= 0.0f) & LANE_MASK(f.ray < count);
    const MediumSet began =
        find_beginnings(&world, &around, &f.walk, active, &f.ray_state, hollow, maximum);
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i) {
        lane_int full;
        in = cross_medium_or_overflow(in, began.members[i], (lane_int)0,
                                      LANE_MASK(began.members[i] != VXL_NO_MEDIUM), &full);
        if (VXL_MEDIUM_SET_CAPPED && lanes_any(full))
            atomic_add(medium_overflows, (uint)lanes_count(full));
    }
    store_medium_set(&in, paths, stride, first);
    LANES_STORE(medium_inside(&in, ranks), inside, first);
}
#endif

/// Traces a queue of shadow rays that begin on surfaces. A ray that reaches its light adds its
/// contribution to the radiance of the ray that it was sent for.
///
/// Every target stands in the queue at most once, so no two work-items add to the same value. Only
/// the first work-item adds the queue's length to `shadow_traced`, a low and a high word.
kernel void trace_shadows(VXL_WORLD_PARAMETERS, VXL_SURROUNDINGS_PARAMETERS,
                          VXL_SHADOW_QUEUE_PARAMETERS, VXL_BATCH_PARAMETERS) {
    const uint first = work_item() * (VXL_LANES * VXL_SHADOW_PACKETS);
    const ShadowRays q = {VXL_SHADOW_QUEUE, VXL_BATCH};
    const uint queued = *q.queue.count;
    if (first >= queued) return;
    if (first == 0) {
        q.queue.traced[0] += queued;
        q.queue.traced[1] += q.queue.traced[0] < queued;
    }
    const WorldView world = VXL_WORLD;
    const Surroundings around = VXL_SURROUNDINGS;
#if VXL_REFILLS_SHADOWS
    const uint end = min(first + VXL_LANES * VXL_SHADOW_PACKETS, queued);
    trace_refilled_shadows(&world, &around, &q, first, end);
#else
    ShadowPacket f;
    f.packet.ray = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    const lane_int active = LANE_MASK(f.packet.ray < queued);
    send_shadows(&world, &around, &q, active, &f);
    if (VXL_SHADOW_PACKETS > 1) {
        ShadowPacket g;
        g.packet.ray = f.packet.ray + VXL_LANES;
        const lane_int others = LANE_MASK(g.packet.ray < queued);
        if (lanes_any(others)) {
            send_shadows(&world, &around, &q, others, &g);
            find_interleaved(&world.pyramid, &world.surface, &f.packet, active, &g.packet, others);
            bring_light(&q, &f, active, active & ~f.packet.found.hit);
            bring_light(&q, &g, others, others & ~g.packet.found.hit);
            return;
        }
    }
    const lane_int arrived = find_lights(&world, &around, active, &f);
    bring_light(&q, &f, active, arrived);
#endif
}
