// SPDX-License-Identifier: Apache-2.0
// surface points + a light -> a queue of shadow rays, each with the light that it brings if nothing
// blocks it.
#include "lib/lanes/work_item.h"
#include "lib/light/direct_light.h"

/// Adds a light that shines from one point or direction.
kernel void add_light(VXL_WORLD_PARAMETERS, LightRecord light,
                      global const float* restrict materials, VXL_SHADOW_QUEUE_PARAMETERS,
                      VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const WorldView world = VXL_WORLD;
    const RayBatch batch = VXL_BATCH;
    const ShadowQueue queue = VXL_SHADOW_QUEUE;
    const Vector from = {(lane_float)light.position.x, (lane_float)light.position.y,
                         (lane_float)light.position.z};
    shine_from(&world, light, from, (lane_float)0.0f, materials, &queue, &batch, first);
}
