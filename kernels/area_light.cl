// SPDX-License-Identifier: Apache-2.0
// surface points of paths + a light with an area -> a queue of shadow rays to points of the light;
// and paths that run into the light -> the light that they find there. The latter paths come from
// mirrors, through glass and from physically based surfaces.
#include "lib/lanes/work_item.h"
#include "lib/light/area_points.h"
#include "lib/light/direct_light.h"
#include "lib/light/paths.h"
#include "lib/medium/sight_loss.h"

/// Adds light number `number`: each surface point sends a shadow ray to a point of the light. The
/// path's sample chooses the point; all points are equally probable.
kernel void add_area_light(VXL_WORLD_PARAMETERS, LightRecord light, LightAreaRecord area,
                           PathSampling sampling, uint number,
                           global const float* restrict materials, VXL_SHADOW_QUEUE_PARAMETERS,
                           VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const WorldView world = VXL_WORLD;
    const RayBatch batch = VXL_BATCH;
    const ShadowQueue queue = VXL_SHADOW_QUEUE;
    const PathSamples samples = samples_of_paths(&sampling, &batch, first);
    const Vector from = area_point(light, area, &samples, number);
    const lane_uint state = LANES_LOAD(paths, VXL_PATH_STATE * stride + first);
    const lane_uint bounces = (state >> VXL_STATE_BOUNCE_SHIFT) & VXL_STATE_BOUNCES;
    const lane_int goes_on = LANE_MASK(bounces < sampling.bounces);
    const lane_float met_too = LANES_SELECT(goes_on & shares_light(&batch, first),
                                            (lane_float)area.axis_y.w, (lane_float)0.0f);
    shine_from(&world, light, from, met_too, materials, &queue, &batch, first);
}

/// The weight, per square metre of the light's `area`, of the light that paths find by running into
/// it. Behind mirrors and glass this is the whole light; elsewhere it is what the rays sent to the
/// light leave to such paths.
static inline lane_float met_weight(const RayBatch* batch, uint first, lane_uint state,
                                    lane_float falloff, float area) {
    const lane_uint bounces = (state >> VXL_STATE_BOUNCE_SHIFT) & VXL_STATE_BOUNCES;
    const lane_int alone = LANE_MASK(bounces > 0u) & LANE_MASK((state & VXL_STATE_DIFFUSE) == 0u);
    lane_float weight = (lane_float)0.0f;
    if (VXL_AREA_SHARES) {
        const lane_float density = path_float(batch->paths, VXL_PATH_DENSITY, batch->stride, first);
        const lane_float likelier = fmin(density * falloff, (lane_float)1e30f);
        weight = exact_divide(likelier, fma(likelier, (lane_float)area, 1.0f));
    }
    return LANES_SELECT(alone, exact_reciprocal((lane_float)area), weight);
}

/// Adds the light of paths that run into a light before they meet anything else to the sight rays
/// that the paths began as. Weights it by met_weight.
kernel void meet_area_light(PyramidShape shape, LightRecord light, LightAreaRecord area,
                            VXL_SURROUNDINGS_PARAMETERS, VXL_BATCH_PARAMETERS, uint count,
                            VXL_NODE_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const lane_uint state = LANES_LOAD(paths, VXL_PATH_STATE * stride + first);
    Segment way = whole_segment(&batch, first);
    lane_float travelled = (lane_float)0.0f;
    if (VXL_TRAVELS) travelled = path_float(paths, VXL_PATH_TRAVELLED, stride, first);
    const AreaMeeting m = meet_area(light, area, shape.edge, way.origin, way.direction, travelled);
    const lane_float weight = met_weight(&batch, first, state, m.falloff, area.axis_y.w);
    const lane_int open =
        LANE_MASK(LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first) == VXL_NO_VOXEL);
    const lane_int met = below(first, count) & m.met & LANE_MASK(weight > 0.0f) &
                         LANE_MASK(m.t >= way.t_first) & (open | LANE_MASK(m.t < way.t_last));
    if (!lanes_any(met)) return;
    lane_float left[3] = {(lane_float)1.0f, (lane_float)1.0f, (lane_float)1.0f};
    if (VXL_ABSORBS) {
        const Surroundings around = VXL_SURROUNDINGS;
        lane_uint material = (lane_uint)0u;
        if (VXL_TRANSMISSION) material = LANES_LOAD(inside, first);
        way.t_last = LANES_SELECT(met, m.t, way.t_last);
        let_through(shape, &around, &way, material, met, left);
    }
    const float intensity[3] = {light.intensity.x, light.intensity.y, light.intensity.z};
    const lane_uint target = LANES_LOAD(paths, VXL_PATH_TARGET * stride + first);
    for (uint c = 0; c < 3; ++c) {
        const lane_float throughput = path_float(paths, VXL_PATH_THROUGHPUT + c, stride, first);
        add_to_nodes(&nodes, c, met, target,
                     throughput * left[c] * weight * (intensity[c] * 3.14159265f), 0);
    }
}
