// SPDX-License-Identifier: Apache-2.0
// rays of paths through a scattering medium -> points of the medium near a light, and the light
// that comes from there. See lib/medium/near_light.h.
#include "lib/lanes/work_item.h"
#include "lib/light/path_samples.h"
#include "lib/light/paths.h"
#include "lib/medium/free_path.h"
#include "lib/medium/medium_point.h"

/// Chooses a point in the medium for each of the rays 0 .. count-1 that the light shines on before
/// the surfaces that the rays have met. Puts the point, with the throughput of the light from
/// there, into a queue. Rays that begin their paths (`is_first`) have throughput 1, whatever has
/// been stored for them since.
kernel void find_near_points(PyramidShape shape, LightRecord light, float4 absorption,
                             VXL_SCATTERING_PARAMETER VXL_DENSITY_PARAMETERS, PathSampling sampling,
                             uint is_first, VXL_BATCH_PARAMETERS, uint count,
                             VXL_MEDIUM_POINTS_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const RayQueue points = VXL_QUEUE;
    const DensityView density = VXL_DENSITY;
    const MediumScattering medium = VXL_MEDIUM_SCATTERING;
    lane_int active = in_the_open(&batch, first, count);
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const lane_uint target = LANES_LOAD(paths, VXL_PATH_TARGET * stride + first);
    // The state of these paths is that of rays that the medium doesn't scatter.
    const lane_uint state =
        LANES_LOAD(paths, VXL_PATH_STATE * stride + first) & (lane_uint)~VXL_STATE_IN_MEDIUM;
    Segment segment = part_in_world(shape, whole_segment(&batch, first));
    active &= LANE_MASK(segment.t_first < segment.t_last);
    const lane_float metres =
        LANES_SELECT(active, metres_per_t(shape.edge, segment.direction), one);
    const Vector middle = {(lane_float)light.position.x, (lane_float)light.position.y,
                           (lane_float)light.position.z};
    const Vector way = unit(scaled(segment.direction, shape.edge));
    const Vector to_light = scaled(difference(middle, segment.origin), shape.edge);
    const NearPart part = near_part(light, shape.edge, to_light, way, segment.t_first * metres,
                                    segment.t_last * metres, active);
    active &= part.some;
    if (!lanes_any(active)) return;
    const PathSamples samples = path_samples(&sampling, target, state);
    const lane_float x = near_point(&part, path_point(&samples, VXL_DECISION_NEAR).x);
    const lane_float wanted = exact_divide(dot_product(to_light, way) + x, metres);
    const lane_float t =
        LANES_SELECT(active, clamp(wanted, segment.t_first, segment.t_last), segment.t_first);
    segment.t_last = t;
    const lane_float depth =
        travel_until(shape, &density, &segment, (lane_float)INFINITY, active).depth * metres;
    const lane_float thick = density_at(shape, &density, &segment, t, active);
    const lane_float found = near_density(&part, x) + chance_density(&medium, depth, thick);
    active &= LANE_MASK(thick > 0.0f) & LANE_MASK(found > 0.0f);
    const lane_float weight = exact_divide(thick, LANES_SELECT(active, found, one));
    NewRays point = point_of(shape, &segment, t, target, state);
    const float absorbed[3] = {absorption.x, absorption.y, absorption.z};
    for (uint c = 0; c < 3; ++c) {
        lane_float before = one;
        if (!is_first) before = path_float(paths, VXL_PATH_THROUGHPUT + c, stride, first);
        point.throughput[c] = before * weight * medium.per_metre[c] *
                              exact_exp(-(absorbed[c] + medium.per_metre[c]) * depth);
    }
    const Slots slots = reserve_slots(active, counters + VXL_COUNT_CHILDREN);
    put_points(&points, &point, &slots, point_hits, point_radiance);
    put_ways(point_hits, points.stride, zero, zero, zero, &slots);
}

/// Adds the light at points 0 .. count-1 to the light of the sight rays whose paths they belong to.
kernel void add_near_light(global const uint* restrict paths, global const float* restrict radiance,
                           uint stride, uint count, VXL_NODE_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const NodeLight nodes = VXL_NODES;
    const lane_uint target = LANES_LOAD(paths, VXL_PATH_TARGET * stride + first);
    for (uint c = 0; c < 3; ++c)
        add_to_nodes(&nodes, c, below(first, count), target,
                     path_float(paths, VXL_PATH_THROUGHPUT + c, stride, first) *
                         LANES_LOAD(radiance, c * stride + first),
                     0);
}
