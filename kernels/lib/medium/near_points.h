// SPDX-License-Identifier: Apache-2.0
// Rays of paths through a scattering medium -> points of the medium near a light, and the
// throughput of the light from there. See near_light.h.
#ifndef VXL_NEAR_POINTS_H
#define VXL_NEAR_POINTS_H

#include "lib/light/path_samples.h"
#include "lib/light/paths.h"
#include "lib/medium/free_path.h"
#include "lib/medium/medium_point.h"

/// The ways of rays through the medium, up to the surfaces that they have met.
typedef struct {
    Segment segment;
    Vector direction;   // a unit vector
    lane_float metres;  // for each unit of t
    lane_uint target, state;
    lane_int active;  // mask: there is such a way
} Ways;

/// The ways of the rays first .. count-1.
static inline Ways ways_of(PyramidShape shape, const RayBatch* batch, uint first, uint count) {
    Ways w;
    w.active = in_the_open(batch, first, count);
    w.target = LANES_LOAD(batch->paths, VXL_PATH_TARGET * batch->stride + first);
    // The state of these paths is that of rays that the medium doesn't scatter.
    w.state = LANES_LOAD(batch->paths, VXL_PATH_STATE * batch->stride + first) &
              (lane_uint)~VXL_STATE_IN_MEDIUM;
    w.segment = part_in_world(shape, whole_segment(batch, first));
    w.active &= LANE_MASK(w.segment.t_first < w.segment.t_last);
    w.metres =
        LANES_SELECT(w.active, metres_per_t(shape.edge, w.segment.direction), (lane_float)1.0f);
    w.direction = unit(scaled(w.segment.direction, shape.edge));
    return w;
}

/// What the choice of points needs, and where they are put. Rays that begin their paths
/// (`is_first`) have throughput 1, whatever has been stored for them since.
typedef struct {
    float4 absorption;
    const MediumScattering* medium;
    const DensityView* density;
    const RayBatch* batch;
    uint is_first;
    const RayQueue* queue;
    global uint* counters;
    global uint* hits;
    global float* radiance;
} NearPoints;

/// Chooses a point for each way that the light around `middle` shines on, and puts it into the
/// queue, with the throughput of the light from there, multiplied by `scale`, and with the light's
/// `number`.
static inline void put_near_points(PyramidShape shape, const NearPoints* n, const Ways* w,
                                   const Light* light, Vector middle, lane_float scale,
                                   lane_uint number, const PathSampling* sampling, uint first) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    lane_int active = w->active;
    Segment segment = w->segment;
    const Vector to_light = scaled(difference(middle, segment.origin), shape.edge);
    const NearPart part =
        near_part(light, shape.edge, to_light, w->direction, segment.t_first * w->metres,
                  segment.t_last * w->metres, active);
    active &= part.some;
    if (!lanes_any(active)) return;
    const PathSamples samples = path_samples(sampling, w->target, w->state);
    const lane_float x = near_point(&part, path_point(&samples, VXL_DECISION_NEAR).x);
    const lane_float wanted = exact_divide(dot_product(to_light, w->direction) + x, w->metres);
    const lane_float t =
        LANES_SELECT(active, clamp(wanted, segment.t_first, segment.t_last), segment.t_first);
    segment.t_last = t;
    const lane_float depth =
        travel_until(shape, n->density, &segment, (lane_float)INFINITY, active).depth * w->metres;
    const lane_float thick = density_at(shape, n->density, &segment, t, active);
    const lane_float found = near_density(&part, x) + chance_density(n->medium, depth, thick);
    active &= LANE_MASK(thick > 0.0f) & LANE_MASK(found > 0.0f);
    const lane_float weight = exact_divide(thick, LANES_SELECT(active, found, one)) * scale;
    NewRays point = point_of(shape, &segment, t, w->target, w->state);
    const RayBatch* batch = n->batch;
    const float absorbed[3] = {n->absorption.x, n->absorption.y, n->absorption.z};
    for (uint c = 0; c < 3; ++c) {
        lane_float before = one;
        if (!n->is_first)
            before = path_float(batch->paths, VXL_PATH_THROUGHPUT + c, batch->stride, first);
        point.throughput[c] = before * weight * n->medium->per_metre[c] *
                              exact_exp(-(absorbed[c] + n->medium->per_metre[c]) * depth);
    }
    const Slots slots = reserve_slots(active, n->counters + VXL_COUNT_CHILDREN);
    put_points(n->queue, &point, &slots, n->hits, n->radiance);
    put_ways(n->hits, n->queue->stride, LANES_AS_FLOAT(number), zero, zero, &slots);
}

#endif
