// SPDX-License-Identifier: Apache-2.0
// surface points of paths + a light with an area -> a queue of shadow rays to points of it, and the
// light that paths which physically based surfaces scatter find where they run into it.
#include "lib/lanes/work_item.h"
#include "lib/light/area_points.h"
#include "lib/light/direct_light.h"
#include "lib/light/paths.h"

/// Adds light number `number`: each surface point sends a shadow ray to a point of the light that
/// the path's sample chooses, all of which are equally probable.
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

/// Adds the light that paths find where they run into a light, before anything else, to that of
/// the sight rays that they began as: the share that rays sent to the light leave to them.
kernel void meet_area_light(PyramidShape shape, LightRecord light, LightAreaRecord area,
                            VXL_BATCH_PARAMETERS, uint count, VXL_NODE_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const lane_float zero = (lane_float)0.0f;
    const lane_float density = path_float(paths, VXL_PATH_DENSITY, stride, first);
    lane_int met = below(first, count) & LANE_MASK(density > 0.0f);
    if (!lanes_any(met)) return;
    lane_float start = zero, travelled = zero;
    if (VXL_TRANSMISSION) start = LANES_LOAD(batch.starts, first);
    if (VXL_TRAVELS) travelled = path_float(paths, VXL_PATH_TRAVELLED, stride, first);
    const AreaMeeting m =
        meet_area(light, area, shape.edge, load_vector(rays, stride, first),
                  load_vector(rays + VXL_RAY_DX * stride, stride, first), travelled);
    const lane_int open =
        LANE_MASK(LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first) == VXL_NO_VOXEL);
    const lane_float t_hit = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    met &= m.met & LANE_MASK(m.t >= start) & (open | LANE_MASK(m.t < t_hit));
    const lane_float likelier = fmin(density * m.falloff, (lane_float)1e30f);
    const lane_float share = exact_divide(likelier, fma(likelier, (lane_float)area.axis_y.w, 1.0f));
    const float intensity[3] = {light.intensity.x, light.intensity.y, light.intensity.z};
    const lane_uint target = LANES_LOAD(paths, VXL_PATH_TARGET * stride + first);
    for (uint c = 0; c < 3; ++c) {
        const lane_float throughput = path_float(paths, VXL_PATH_THROUGHPUT + c, stride, first);
        add_to_nodes(&nodes, c, met, target, throughput * share * (intensity[c] * 3.14159265f), 0);
    }
}
