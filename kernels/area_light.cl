// SPDX-License-Identifier: Apache-2.0
// surface points of paths + a light with an area -> a queue of shadow rays to points of it.
#include "lib/lanes/work_item.h"
#include "lib/light/area_points.h"
#include "lib/light/direct_light.h"

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
    shine_from(&world, light, from, materials, &queue, &batch, first);
}
