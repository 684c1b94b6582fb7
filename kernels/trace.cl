// rays -> hits: the discrete walk of every ray through the world to the first surface it meets.
#include "lib/lanes/work_item.h"
#include "lib/surface/begin_inside.h"
#include "lib/traverse/lane_refill.h"
#include "lib/traverse/shadow_packet.h"
#include "lib/traverse/sight_rays.h"
#include "shared/scene.h"

#define VXL_WORLD_ARGUMENTS                                                                      \
    PyramidShape shape, global const uint *restrict sectors, global const uint *restrict bricks, \
        global const uint *restrict leaves, global const uint *restrict leaf_voxels,             \
        global const uint *restrict attributes, global const uint *restrict fields,              \
        global const uint *restrict primitive_first, global const uint *restrict primitives,     \
        global const float *restrict triangles, global const uint *restrict triangle_attributes, \
        global const SolidShape *restrict solids,                                                \
        global const InstanceRecord *restrict instance_records,                                  \
        global const InstanceNode *restrict instance_nodes,                                      \
        global const uint *restrict group_materials

#define VXL_WORLD_VIEWS                                                                           \
    const PyramidView pyramid = pyramid_view(shape, sectors, bricks, leaves, leaf_voxels);        \
    const SurfaceView surface = {                                                                 \
        attributes, fields, primitive_first, primitives, triangles, triangle_attributes, solids}; \
    const InstanceView instances = {instance_records, instance_nodes, group_materials}

/// The closest hit of rays 0 .. count-1 that run beside each other. Arrays hold a multiple of 16
/// rays. Hits don't depend on whether there are `beams`.
kernel void trace_closest(VXL_WORLD_ARGUMENTS, global const float* restrict rays, uint count,
                          uint stride, global const uint* restrict paths,
                          global const float* restrict starts, global const uint* restrict beams,
                          global uint* restrict hits) {
    const uint first = work_item() * (VXL_LANES * VXL_PACKETS_INTERLEAVED);
    if (first >= count) return;
    VXL_WORLD_VIEWS;
    const SightRays q = {rays, paths, starts, beams, count, stride};
    Packet f;
    bool sent = send_packet(&pyramid, &q, first, &f, hits);
    if (VXL_PACKETS_INTERLEAVED > 1) {
        Packet g;
        const bool also = send_packet(&pyramid, &q, first + VXL_LANES, &g, hits);
        if (sent && also) {
            find_interleaved(&pyramid, &surface, &f, are_rays(&q, &f), &g, are_rays(&q, &g));
            store_packet(&q, &f, hits);
            store_packet(&q, &g, hits);
            return;
        }
        if (also) f = g;
        sent |= also;
    }
    if (!sent) return;
    f.found = find_nearest(&pyramid, &surface, &instances, &f.walk, f.t_end, are_rays(&q, &f),
                           false, &f.ray_state);
    store_packet(&q, &f, hits);
}

#if VXL_PATHS
/// The closest hit of rays 0 .. count-1 that run anywhere: reflected and refracted ones.
///
/// A work-item carries VXL_PACKETS(VXL_LANES) packets' rays in two packets whose steps take turns.
/// Lanes whose rays have ended wait until several have; then their hits are stored, and they go on
/// with the next rays. The hits' bits are those of trace_closest.
kernel void trace_scattered(VXL_WORLD_ARGUMENTS, global const float* restrict rays, uint count,
                            uint stride, global const uint* restrict paths,
                            global const float* restrict starts, global uint* restrict hits) {
    const uint first = work_item() * (VXL_LANES * VXL_PACKETS(VXL_LANES));
    if (first >= count) return;
    VXL_WORLD_VIEWS;
    (void)instances;
    ScatteredRays q = {
        {rays, paths, starts, 0, count, stride},
        first,
        min(first + VXL_LANES * VXL_PACKETS(VXL_LANES), (count + VXL_LANES - 1u) & -VXL_LANES)};
    LaneRefill a = begin_refill(&pyramid, &q);
    if (VXL_LANES > 1 && q.next < q.end) {
        LaneRefill b = begin_refill(&pyramid, &q);
        while (lanes_any(a.held) && lanes_any(b.held)) {
            const int minimum = min_walking(&q);
            bool on_a = walks(&a, minimum), on_b = walks(&b, minimum);
            while (on_a && on_b) {
                step_refill(&pyramid, &a);
                step_refill(&pyramid, &b);
                on_a = walks(&a, minimum);
                on_b = walks(&b, minimum);
            }
            if (!on_a) serve(&pyramid, &surface, &q, &a, hits);
            if (!on_b) serve(&pyramid, &surface, &q, &b, hits);
        }
        if (lanes_any(b.held)) a = b;
    }
    while (lanes_any(a.held)) {
        const int minimum = min_walking(&q);
        while (walks(&a, minimum)) step_refill(&pyramid, &a);
        serve(&pyramid, &surface, &q, &a, hits);
    }
}
#endif

#if VXL_OBSERVER_IN_MEDIUM
/// Adds to the objects that rays 0 .. count-1 are inside of, as begin_paths left them, those that
/// only tracing finds; see find_beginnings. `maximum` is their number in the scene, smooth ones as
/// one.
kernel void begin_inside(VXL_WORLD_ARGUMENTS, uint constant_attribute,
                         global const float* restrict materials, global const uint* restrict ranks,
                         global uint* medium_overflows, global const uint* restrict hollow,
                         uint maximum, global const float* restrict rays, uint count, uint stride,
                         global uint* restrict paths, global const float* restrict starts,
                         global uint* restrict inside) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    VXL_WORLD_VIEWS;
    (void)instances;
    Packet f;
    f.ray = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    set_out(&pyramid, rays, count, stride, paths, starts, &f);
    MediumSet in = f.ray_state.media;
    const lane_int active = LANE_MASK(f.t_end >= 0.0f) & LANE_MASK(f.ray < count);
    const MediumSet began =
        find_beginnings(&pyramid, &surface, &f.walk, active, &f.ray_state, constant_attribute,
                        materials, hollow, maximum, medium_overflows);
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i) {
        lane_int full;
        in =
            cross_medium_or_overflow(in, began.members[i], (lane_int)(i == 0 ? -1 : 0), (lane_int)0,
                                     LANE_MASK(began.members[i] != VXL_NO_MEDIUM), &full);
        if (VXL_MEDIUM_SET_CAPPED && lanes_any(full))
            atomic_add(medium_overflows, (uint)lanes_count(full));
    }
    store_medium_set(&in, paths, stride, first);
    LANES_STORE(medium_inside(&in, ranks), inside, first);
}
#endif

/// Traces a queue of shadow rays that begin on surfaces; what reaches its light adds its share of
/// light, `contributions` (three components `stride` apart), to the radiance of the ray it was sent
/// for.
///
/// Every target stands in the queue at most once, so no two work-items add to the same place. The
/// first work-item alone adds the queue's length to `traced`, low word and high word. `beam_grid`
/// and `beam_ends` are those of the rays' light, if they are known.
kernel void trace_shadows(VXL_WORLD_ARGUMENTS, uint constant_attribute,
                          global const float* restrict materials,
                          global const uint* restrict colors, global const uint* restrict ranks,
                          global uint* medium_overflows, float4 absorption,
                          DensityShape density_shape, global const uint* restrict density_bricks,
                          global const float* restrict density_values,
                          global const float* restrict rays, global const uint* restrict count,
                          uint stride, global const uint* restrict targets,
                          global const uint* restrict sources, global const uint* restrict paths,
                          global const uint* restrict hits,
                          global const float* restrict contributions, BeamGrid beam_grid,
                          global const float* restrict beam_ends, global uint* restrict traced,
                          global float* restrict radiance) {
    const uint first = work_item() * (VXL_LANES * VXL_SHADOW_PACKETS);
    const uint queued = *count;
    if (first >= queued) return;
    if (first == 0) {
        traced[0] += queued;
        traced[1] += traced[0] < queued;
    }
    VXL_WORLD_VIEWS;
    const MediumView medium = {absorption, {density_shape, density_bricks, density_values}};
    const FilterView filter = {constant_attribute, materials, colors,   ranks,
                               medium_overflows,   medium,    instances};
    const ShadowRays queue = {rays,          targets, sources,   paths,    hits,
                              contributions, stride,  beam_grid, beam_ends};
#if VXL_REFILLS_SHADOWS
    const uint end = min(first + VXL_LANES * VXL_SHADOW_PACKETS, queued);
    trace_refilled_shadows(&pyramid, &surface, &filter, shape, &queue, first, end, radiance);
#else
    ShadowPacket f;
    f.packet.ray = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    const lane_int active = LANE_MASK(f.packet.ray < queued);
    send_shadows(&surface, &filter, shape, &queue, active, &f);
    if (VXL_SHADOW_PACKETS > 1) {
        ShadowPacket g;
        g.packet.ray = f.packet.ray + VXL_LANES;
        const lane_int others = LANE_MASK(g.packet.ray < queued);
        if (lanes_any(others)) {
            send_shadows(&surface, &filter, shape, &queue, others, &g);
            find_interleaved(&pyramid, &surface, &f.packet, active, &g.packet, others);
            bring_light(&queue, &f, active, active & ~f.packet.found.hit, radiance);
            bring_light(&queue, &g, others, others & ~g.packet.found.hit, radiance);
            return;
        }
    }
    const lane_int arrived = find_lights(&pyramid, &surface, &filter, active, &f);
    bring_light(&queue, &f, active, arrived, radiance);
#endif
}
