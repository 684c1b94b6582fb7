// SPDX-License-Identifier: Apache-2.0
// paths on their way through a scattering medium -> the points where the medium scatters them, the
// light there, and the next rays of the paths.
//
// Scattering happens by chance (lib/medium/free_path.h); absorption is a weight, as on all rays.
#include "lib/lanes/exact_exp.h"
#include "lib/lanes/work_item.h"
#include "lib/light/area_points.h"
#include "lib/light/child_rays.h"
#include "lib/light/light_rays.h"
#include "lib/light/sent_rays.h"
#include "lib/medium/free_path.h"
#include "lib/medium/medium_light.h"
#include "lib/traverse/segment.h"

/// Among entries 0 .. count-1, finds the paths that the medium scatters before their rays come to
/// the surfaces that they have met. Puts the points, with the throughput of the light from there,
/// into a queue, and marks the entries; transmittance[0] holds where they end. Paths inside objects
/// are not scattered.
kernel void scatter_in_medium(PyramidShape shape, float4 absorption,
                              VXL_SCATTERING_PARAMETER VXL_DENSITY_PARAMETERS,
                              PathSampling sampling, VXL_BATCH_PARAMETERS, uint count,
                              VXL_MEDIUM_POINTS_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const RayQueue points = VXL_QUEUE;
    const DensityView density = VXL_DENSITY;
    const MediumScattering medium = VXL_MEDIUM_SCATTERING;
    const lane_int active = in_the_open(&batch, first, count);
    const lane_uint target = LANES_LOAD(paths, VXL_PATH_TARGET * stride + first);
    const lane_uint state = LANES_LOAD(paths, VXL_PATH_STATE * stride + first);
    const PathSamples samples = path_samples(&sampling, target, state);
    const Segment segment = sight_segment(&batch, first);
    const lane_float metres = metres_per_t(shape.edge, segment.direction);
    const lane_float sought = sought_depth(&medium, path_point(&samples, VXL_DECISION_FLIGHT));
    const lane_int is_finite = active & LANE_MASK(sought < INFINITY);
    const lane_float per_t = exact_divide(LANES_SELECT(is_finite, sought, (lane_float)0.0f),
                                          LANES_SELECT(active, metres, (lane_float)1.0f));
    const FreePath path = travel_until(
        shape, &density, &segment, LANES_SELECT(is_finite, per_t, (lane_float)INFINITY), active);

    const lane_float depth = path.depth * metres;
    lane_float throughput[3];
    load_throughput(paths, stride, first, throughput);
    weigh_colors(&medium, depth, path.ends, active, throughput);
    NewRays point = point_of(shape, &segment, path.t, target, state);
    const float absorbed[3] = {absorption.x, absorption.y, absorption.z};
    for (uint c = 0; c < 3; ++c) {
        point.throughput[c] = throughput[c] * exact_exp(-absorbed[c] * depth);
        // The stored throughput also applies to the medium's own light on the way.
        LANES_STORE(LANES_AS_UINT(throughput[c]), paths,
                    (VXL_PATH_THROUGHPUT + c) * stride + first);
    }
    LANES_STORE(LANES_SELECT(path.ends, state | VXL_STATE_IN_MEDIUM, state), paths,
                VXL_PATH_STATE * stride + first);
    if (!lanes_any(path.ends)) return;
    LANES_STORE(path.t, transmittance, first);
    const Slots slots = reserve_slots(path.ends, counters + VXL_COUNT_CHILDREN);
    put_points(&points, &point, &slots, point_hits, point_radiance);
    if (!VXL_NEAR_LIGHT) return;
    const Segment part = part_in_world(shape, segment);
    const lane_float thick = density_at(shape, &density, &segment, path.t, path.ends);
    put_ways(point_hits, points.stride, (path.t - part.t_first) * metres,
             (part.t_last - path.t) * metres, chance_density(&medium, depth, thick), &slots);
}

/// Adds a light that shines from one point or direction to points in the medium.
kernel void add_light_to_medium(PyramidShape shape, LightRecord light,
                                VXL_SCATTERING_PARAMETER VXL_SHADOW_QUEUE_PARAMETERS,
                                VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const ShadowQueue queue = VXL_SHADOW_QUEUE;
    const MediumScattering medium = VXL_MEDIUM_SCATTERING;
    const Vector from = vector_of(light.position);
    const Light source = light_of(light);
    shine_into_medium(shape, &source, from, from, medium.anisotropy, &queue, &batch, first,
                      below(first, count));
}

#if VXL_AREA_SAMPLES
/// Adds light number `number`, which has an area, to points in the medium: each sends a shadow ray
/// to a point of the light, which the path's sample chooses.
kernel void add_area_light_to_medium(PyramidShape shape, LightRecord light, LightAreaRecord area,
                                     PathSampling sampling, uint number,
                                     VXL_SCATTERING_PARAMETER VXL_SHADOW_QUEUE_PARAMETERS,
                                     VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const ShadowQueue queue = VXL_SHADOW_QUEUE;
    const MediumScattering medium = VXL_MEDIUM_SCATTERING;
    const PathSamples samples = samples_of_paths(&sampling, &batch, first);
    const Vector from = area_point(light, area, &samples, number);
    const Light source = light_of(light);
    shine_into_medium(shape, &source, vector_of(light.position), from, medium.anisotropy, &queue,
                      &batch, first, below(first, count));
}
#endif

/// Ends some of the paths that bring little light (Russian roulette). Returns the mask of the
/// others, and raises their throughput so that they stand for all.
static inline lane_int keep_some(lane_float chance, lane_uint bounces, lane_float* throughput) {
    const lane_float one = (lane_float)1.0f;
    const lane_float brings = largest(throughput);
    const lane_int asked = LANE_MASK(bounces >= VXL_ROULETTE_BOUNCES) & LANE_MASK(brings < 1.0f);
    const lane_float stay = chance_to_go_on(brings);
    const lane_int stays = LANE_MASK(brings > 0.0f) & (LANE_MASK(chance < stay) | ~asked);
    const lane_float scale = exact_reciprocal(LANES_SELECT(stays & asked, stay, one));
    for (int c = 0; c < 3; ++c) throughput[c] *= scale;
    return stays;
}

/// Fills rays from points in the medium to emitters or the sky. Returns the mask of rays to send.
static inline lane_int look_from_medium(PyramidShape shape, const MediumScattering* medium,
                                        Vector way, lane_int wanted, const PathSamples* samples,
                                        const Emitters* emitters, const SkyMap* sky, NewRays* r) {
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    const Vector nowhere = {zero, zero, zero};
    const EmitterRays s = choose_light(emitters, sky, samples, r->origin, shape.edge);
    const lane_float scattered = phase_density(medium->anisotropy, dot_product(way, s.direction));
    wanted &= s.found;
    lane_float density = s.density;
    if ((VXL_EMITTERS == VXL_EMITTERS_BOTH) | (VXL_SKY_RAYS == VXL_EMITTERS_BOTH))
        density += scattered;
    const lane_float share = exact_divide(scattered, LANES_SELECT(wanted, density, one));
    for (int c = 0; c < 3; ++c) r->throughput[c] *= share;
    const Vector origin = r->origin;
    set_out_child(r, shape, origin, nowhere, select_vector(wanted, s.direction, way));
    const lane_int ends = wanted & LANE_MASK(s.number != VXL_EMITTER_IS_SKY);
    const lane_float metres = LANES_SELECT(ends, s.metres, one);
    r->t_end = LANES_SELECT(ends, t_after(metres, r->direction, shape.edge), r->t_end);
    r->emitter = s.number;
    return wanted;
}

/// Adds the light at points 0 .. count-1 in the medium to the light of the sight rays that their
/// paths began as. Sends each path on, behind the first `taken` rays of the queue, unless it ends,
/// and sends a ray to an emitter.
kernel void extend_in_medium(PyramidShape shape, VXL_SCATTERING_PARAMETER PathSampling sampling,
                             VXL_BATCH_PARAMETERS, uint count, VXL_NODE_PARAMETERS, uint taken,
                             VXL_COUNTED_QUEUE_PARAMETERS, VXL_SOUGHT_LIGHT_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const RayQueue queue = VXL_QUEUE;
    const MediumScattering medium = VXL_MEDIUM_SCATTERING;
    const lane_int valid = below(first, count);
    const lane_uint target = LANES_LOAD(paths, VXL_PATH_TARGET * stride + first);
    const lane_uint state = LANES_LOAD(paths, VXL_PATH_STATE * stride + first);
    const Segment came = {load_vector(batch.rays, stride, first),
                          load_vector(batch.rays + VXL_RAY_DX * stride, stride, first),
                          (lane_float)0.0f, (lane_float)0.0f};
    NewRays ray = point_of(shape, &came, (lane_float)0.0f, target, state);
    for (uint c = 0; c < 3; ++c) {
        ray.throughput[c] = path_float(paths, VXL_PATH_THROUGHPUT + c, stride, first);
        add_to_nodes(&nodes, c, valid, target,
                     ray.throughput[c] * LANES_LOAD(radiance, c * stride + first), 0);
    }
    const lane_uint bounces = (state >> VXL_STATE_BOUNCE_SHIFT) & VXL_STATE_BOUNCES;
    lane_int goes_on = valid & LANE_MASK(bounces < sampling.bounces);
    if (!lanes_any(goes_on)) return;
    const PathSamples samples = path_samples(&sampling, target, state);
    const Vector way = unit(scaled(came.direction, shape.edge));

    const Emitters table = VXL_EMITTER_TABLE;
    const SkyMap sky = VXL_SOUGHT_SKY;
    const bool finds_light = VXL_SKY_RAYS ? true : table.count > 0u;
    if (VXL_LOOKS && finds_light) {
        const RayQueue sent = VXL_SENT_QUEUE;
        NewRays to = ray;
        const lane_int wanted =
            look_from_medium(shape, &medium, way, goes_on, &samples, &table, &sky, &to);
        send_to_emitters(&sent, wanted, target, state, sampling.bounces, &to, counters);
    }
    goes_on &= keep_some(path_point(&samples, VXL_DECISION_LOBE).y, bounces, ray.throughput);
    const Vector ahead =
        phase_direction(medium.anisotropy, way, path_point(&samples, VXL_DECISION_DIRECTION));
    const Vector nowhere = {(lane_float)0.0f, (lane_float)0.0f, (lane_float)0.0f};
    const Vector origin = ray.origin;
    set_out_child(&ray, shape, origin, nowhere, ahead);
    if (VXL_LOOKS) {
        const Vector direction = unit(scaled(ray.direction, shape.edge));
        ray.emitter = LANES_AS_UINT(phase_density(medium.anisotropy, dot_product(way, direction)));
    }
    ray.state = met_after(state) | ((bounces + 1u) << VXL_STATE_BOUNCE_SHIFT) | VXL_STATE_DIFFUSE;
    Slots slots = reserve_slots(goes_on, counters + VXL_COUNT_CHILDREN);
    slots.first += taken;
    put_rays(&queue, &ray, &slots);
}
