// SPDX-License-Identifier: Apache-2.0
// surface points of paths + many lights -> a queue of shadow rays to one light for each point.
#include "lib/lanes/work_item.h"
#include "lib/light/direct_light.h"
#include "lib/light/light_tree.h"
#include "lib/light/paths.h"

/// Adds the light of all lights of the tree: each surface point sends a shadow ray to one of them,
/// whose light counts as many times as the choice was improbable.
kernel void add_chosen_light(VXL_WORLD_PARAMETERS, VXL_LIGHT_TREE_PARAMETERS, PathSampling sampling,
                             global const float* restrict materials, VXL_SHADOW_QUEUE_PARAMETERS,
                             VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const WorldView world = VXL_WORLD;
    const RayBatch batch = VXL_BATCH;
    const ShadowQueue queue = VXL_SHADOW_QUEUE;
    const LightTree tree = VXL_LIGHT_TREE;
    LitPoints p;
    if (!load_lit_points(&world, &batch, first, &p)) return;
    const PathSamples samples = samples_of_paths(&sampling, &batch, first);
    const Vector way = load_vector(rays + VXL_RAY_DX * stride, stride, first);
    const Receivers receivers = receivers_of(materials, &p, shape.edge, way);
    ChosenLights chosen = choose_by_path(&tree, &receivers, &samples, p.lit);
    Vector middle;
    const Light light = chosen_light(&tree, &chosen, &middle);
    p.lit = chosen.found;
    if (!lanes_any(p.lit)) return;
    const Vector from = chosen_points(&tree, &chosen, middle, &samples);
    lane_float met_too = (lane_float)0.0f;
    if (tree.has_areas)
        met_too = area_met_too(&batch, first, sampling.bounces, chosen_areas(&tree, &chosen));
    shine_on(&world, &light, from, met_too, materials, &queue, &batch, first, p);
}
