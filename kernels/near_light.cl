// SPDX-License-Identifier: Apache-2.0
// rays of paths through a scattering medium -> points of the medium near a light, and the light
// that comes from there. See lib/medium/near_light.h.
#include "lib/lanes/work_item.h"
#include "lib/medium/near_points.h"

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
    const Ways ways = ways_of(shape, &batch, first, count);
    if (!lanes_any(ways.active)) return;
    const Light source = light_of(light);
    const NearPoints near = {absorption, &medium,  &density,   &batch,        is_first,
                             &points,    counters, point_hits, point_radiance};
    put_near_points(shape, &near, &ways, &source, vector_of(light.position), (lane_float)1.0f,
                    (lane_uint)0, &sampling, first);
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
