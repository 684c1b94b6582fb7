// SPDX-License-Identifier: Apache-2.0
// surface points of light paths -> the light that they add, and the next rays of the paths.
//
// Global light: an unbiased estimate of the light along each sight ray (Kajiya 1986). Lights are
// sampled at every surface that a path meets; the sky and the background are what its rays run
// into. Emission is found in both ways, by rays sent to it and by paths that run into it, and the
// two share it (lib/light/emission_share.h). Physically based surfaces find lights with an area in
// both ways, too; mirrors and glass find them only by paths that run into them (area_light.cl).
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/light/layer.h"
#include "lib/light/light_rays.h"
#include "lib/light/lobes.h"
#include "lib/light/next_rays.h"
#include "lib/light/path_samples.h"
#include "lib/light/paths.h"
#include "lib/light/sent_rays.h"
#include "lib/traverse/segment.h"

/// Adds the light at the paths' surfaces to the light of their sight rays, whose sums the first
/// surfaces start. Multiplies `throughput` by what the medium and objects on the way let through.
static inline void add_path_light(const RayBatch* batch, uint first, lane_int valid, uint is_first,
                                  const NodeLight* nodes, lane_uint target,
                                  lane_float* throughput) {
    const uint stride = batch->stride;
    for (uint c = 0; c < 3; ++c) {
        const lane_float light = throughput[c] * LANES_LOAD(batch->radiance, c * stride + first);
        add_to_nodes(nodes, c, valid, target, light, is_first);
        if (VXL_ABSORBS) throughput[c] *= LANES_LOAD(batch->transmittance, c * stride + first);
    }
}

/// Notes the coverage of paths that nothing has scattered yet: 1 where a surface is met, and
/// otherwise what the surfaces on the straight way behind a path have covered. With VXL_OWN_LIGHT
/// it is the opacity of the first surfaces.
static inline void note_coverage(const NodeLight* nodes, lane_int valid, lane_int met,
                                 lane_uint target, lane_float clear, lane_float opacity) {
    int add[VXL_LANES];
    uint node[VXL_LANES];
    float covered[VXL_LANES];
    LANES_STORE(valid, add, 0);
    LANES_STORE(target, node, 0);
    if (VXL_OWN_LIGHT)
        LANES_STORE(LANES_SELECT(met, opacity, (lane_float)0.0f), covered, 0);
    else
        LANES_STORE(LANES_SELECT(met, (lane_float)1.0f, 1.0f - clear), covered, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane)
        if (add[lane]) nodes->coverage[node[lane]] = covered[lane];
}

/// For paths on physically based surfaces, sets how `likely` they go along a direction, and which
/// share of the light that they return comes from there, per solid angle.
static inline void return_physically(const ScatterPoint* p, const PhysicalView* view,
                                     Vector direction, lane_float* likely, lane_float* returned,
                                     lane_int* above) {
    lane_float value[3], density;
    const lane_int reached = physical_value(view, direction, value, &density) &
                             LANE_MASK(dot_product(p->normal, direction) > min_cosine(p));
    *above = LANES_SELECT(view->is, reached, *above);
    *likely = LANES_SELECT(view->is, density, *likely);
    for (int c = 0; c < 3; ++c) {
        const lane_int some = view->is & LANE_MASK(view->albedo[c] > 0.0f);
        const lane_float share = exact_divide(
            value[c] * 0.318309886f, LANES_SELECT(some, view->albedo[c], (lane_float)1.0f));
        returned[c] =
            LANES_SELECT(view->is, LANES_SELECT(some, share, (lane_float)0.0f), returned[c]);
    }
}

/// Fills rays from surfaces to emitters or the sky, except for their state and target. Their
/// throughput is the path's throughput for light from there, times the share of that light that
/// falls to these rays. Returns the mask of rays to send.
static inline lane_int look_for_emitters(PyramidShape shape, const Surroundings* around,
                                         const ScatterPoint* p, const RayBatch* batch, uint first,
                                         const Lobes* lobes, const lane_float* throughput,
                                         lane_float chance, const PathSamples* samples,
                                         const Emitters* emitters, const SkyMap* sky,
                                         const PhysicalView* view, NewRays* r) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    Choice way;
    way.diffuse = p->hit & LANE_MASK(largest(lobes->diffuse) > 0.0f);
    way.reflected = way.refracted = way.straight = (lane_int)0;
    for (int c = 0; c < 3; ++c) way.throughput[c] = zero;
    way.chance = zero;
    const ScatteredWay nowhere = no_scattered_way(p);
    *r = next_rays_of(shape, around, p, batch, first, &way, &nowhere);
    const EmitterRays s = choose_light(emitters, sky, samples, r->origin, shape.edge);
    lane_int above;
    const lane_float cosine = cosine_at(p, batch, first, s.direction, &above) * 0.318309886f;
    lane_float likely = cosine, returned[3] = {cosine, cosine, cosine};
    if (VXL_PHYSICAL && lanes_any(view->is))
        return_physically(p, view, s.direction, &likely, returned, &above);
    const lane_int wanted = way.diffuse & s.found & above;
    lane_float density = s.density;
    if ((VXL_EMITTERS == VXL_EMITTERS_BOTH) | (VXL_SKY_RAYS == VXL_EMITTERS_BOTH))
        density += chance * likely;
    const lane_float safe = LANES_SELECT(wanted, density, one);
    for (int c = 0; c < 3; ++c)
        r->throughput[c] = LANES_SELECT(
            wanted, throughput[c] * lobes->diffuse[c] * exact_divide(returned[c], safe), zero);
    const Vector ahead = select_vector(wanted, s.direction, p->normal);
    set_out_child(r, shape,
                  offset_origin(shape, p->position, p->normal, batch->hits, batch->stride, first),
                  p->normal, ahead);
    const lane_int ends = wanted & LANE_MASK(s.number != VXL_EMITTER_IS_SKY);
    const lane_float metres = LANES_SELECT(ends, s.metres, one);
    r->t_end = LANES_SELECT(ends, t_after(metres, r->direction, shape.edge), r->t_end);
    r->emitter = s.number;
    r->clear = zero;
    return wanted;
}

/// The states of paths that the surfaces have scattered or let pass straight.
static inline lane_uint state_after(const Choice* way, lane_int scattered, lane_uint state) {
    const lane_uint bounces = (state >> VXL_STATE_BOUNCE_SHIFT) & VXL_STATE_BOUNCES;
    const lane_uint next = ((bounces + 1u) << VXL_STATE_BOUNCE_SHIFT) |
                           (LANES_AS_UINT(way->diffuse) & VXL_STATE_DIFFUSE);
    return met_after(state) | LANES_SELECT(scattered, next, state & ~(lane_uint)VXL_STATE_MET);
}

/// Chooses directions for paths that matt and physically based surfaces scatter. Clears `diffuse`
/// of `way` for paths that a surface absorbs, and sets `refracted` instead for those that go
/// through glass.
static inline ScatteredWay scatter_diffusely(const ScatterPoint* p, const RayBatch* batch,
                                             uint first, const PhysicalView* view,
                                             const PathSamples* samples, Choice* way) {
    ScatteredWay matt = no_scattered_way(p);
    if (!lanes_any(way->diffuse)) return matt;
    lane_float layer = (lane_float)0.0f;
    if (VXL_PHYSICAL) layer = path_point(samples, VXL_DECISION_LAYER).x;
    matt = scatter_by(p, batch, first, view, path_point(samples, VXL_DECISION_DIRECTION), layer);
    if (VXL_PHYSICAL) way->diffuse &= ~matt.is | matt.lives;
    if (VXL_ROUGH_GLASS) {
        matt.through &= way->diffuse;
        way->refracted |= matt.through;
        way->diffuse &= ~matt.through;
    }
    return matt;
}

/// Puts the next rays of the paths that scatter or go straight into the queue.
static inline void send_on(PyramidShape shape, const Surroundings* around, const ScatterPoint* p,
                           const RayBatch* batch, uint first, const Choice* way,
                           const ScatteredWay* matt, lane_uint target, lane_uint state,
                           lane_float clear, const RayQueue* queue, global uint* counters) {
    const lane_int scattered = way->diffuse | way->reflected | way->refracted;
    const lane_int goes_on = scattered | way->straight;
    if (!lanes_any(goes_on)) return;
    NewRays ray = next_rays_of(shape, around, p, batch, first, way, matt);
    ray.target = target;
    ray.clear = LANES_SELECT(way->straight, clear * way->clear, (lane_float)0.0f);
    ray.state = state_after(way, scattered, state);
    if (VXL_LOOKS)
        ray.emitter =
            LANES_SELECT(scattered, ray.emitter,
                         LANES_LOAD(batch->paths, VXL_PATH_EMITTER * batch->stride + first));
    if (VXL_AREA_SHARES)
        ray.density =
            LANES_SELECT(scattered, ray.density,
                         path_float(batch->paths, VXL_PATH_DENSITY, batch->stride, first));
    const Slots slots = reserve_slots(goes_on, counters + VXL_COUNT_CHILDREN);
    put_rays(queue, &ray, &slots);
}

/// True if paths can send rays to light, which is the sky's or an emitter's.
static inline bool finds_light(const Emitters* table) {
    return VXL_SKY_RAYS ? true : table->count > 0u;
}

/// Adds the light at a packet's surfaces to the light of the sight rays that their paths began as.
/// Sends each path on along one way, unless it ends, and sends a ray to an emitter. `entries` of
/// the batch name their sight ray in VXL_PATH_TARGET, whose light is kept in the nodes; rays to
/// emitters may be entries, too.
kernel void extend_paths(PyramidShape shape, VXL_SURROUNDINGS_PARAMETERS,
                         global const uint* restrict colors, PathSampling sampling, uint is_first,
                         VXL_BATCH_PARAMETERS, uint count, VXL_NODE_PARAMETERS,
                         VXL_COUNTED_QUEUE_PARAMETERS, VXL_SOUGHT_LIGHT_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const Surroundings around = VXL_SURROUNDINGS;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const RayQueue queue = VXL_QUEUE;
    const lane_int valid = below(first, count);
    const lane_uint target = LANES_LOAD(paths, VXL_PATH_TARGET * stride + first);
    const lane_uint state = LANES_LOAD(paths, VXL_PATH_STATE * stride + first);
    lane_float throughput[3];
    load_throughput(paths, stride, first, throughput);
    const lane_uint bounces = (state >> VXL_STATE_BOUNCE_SHIFT) & VXL_STATE_BOUNCES;
    add_path_light(&batch, first, valid, is_first, &nodes, target, throughput);

    ScatterPoint p = load_point(&batch, shape.edge, first, count);
    const lane_int in_medium = VXL_SCATTERING ? scatters_before(&batch, first) : (lane_int)0;
    p.hit &= ~in_medium;
    lane_int met_any = p.hit;
    lane_float opacity = (lane_float)1.0f, clear = (lane_float)0.0f;
    if (VXL_TRANSMISSION) {
        const Layer layer = load_layer(&around, colors, &batch, first, count);
        opacity = LANES_SELECT(in_medium, opacity, layer.opacity);
        met_any = layer.hit;
        clear = path_float(paths, VXL_PATH_CLEAR, stride, first);
        if (nodes.coverage)
            note_coverage(&nodes, valid & LANE_MASK(bounces == 0u), met_any, target, clear,
                          opacity);
    }
    PhysicalView view;
    if (VXL_PHYSICAL) view = view_of_paths(&around, colors, &batch, first, &p);
    Lobes lobes = lobes_of(&around, colors, &batch, first, &p, &view, opacity,
                           LANE_MASK(bounces < sampling.bounces));
    if (VXL_OWN_LIGHT) met_any &= LANE_MASK(bounces != 0u);
    if (VXL_TRANSMISSION) lobes.straight = LANES_SELECT(met_any, 1.0f - opacity, (lane_float)0.0f);
    const PathSamples samples = path_samples(&sampling, target, state);
    Choice way = choose_way(&lobes, throughput, path_point(&samples, VXL_DECISION_LOBE),
                            LANE_MASK(bounces >= VXL_ROULETTE_BOUNCES));

    // Misses, paths at their last bounce and rays sent to emitters scatter nothing.
    const Emitters table = VXL_EMITTER_TABLE;
    const SkyMap sky = VXL_SOUGHT_SKY;
    if (VXL_LOOKS && finds_light(&table) && lanes_any(LANE_MASK(largest(lobes.diffuse) > 0.0f))) {
        const RayQueue sent = VXL_SENT_QUEUE;
        NewRays ray;
        const lane_int wanted =
            look_for_emitters(shape, &around, &p, &batch, first, &lobes, throughput, way.chance,
                              &samples, &table, &sky, &view, &ray);
        send_to_emitters(&sent, wanted, target, state, sampling.bounces, &ray, counters);
    }

    const ScatteredWay matt = scatter_diffusely(&p, &batch, first, &view, &samples, &way);
    send_on(shape, &around, &p, &batch, first, &way, &matt, target, state, clear, &queue, counters);
}
