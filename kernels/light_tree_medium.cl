// SPDX-License-Identifier: Apache-2.0
// paths in a scattering medium + many lights -> points near one of them for each ray, and a queue
// of shadow rays to one light for each point in the medium.
#include "lib/lanes/work_item.h"
#include "lib/light/light_tree.h"
#include "lib/medium/medium_light.h"
#include "lib/medium/near_points.h"

/// Chooses a light for each of the rays 0 .. count-1, and a point in the medium on which this light
/// shines, as find_near_points does for one light. Stores the light's number with the point.
kernel void find_points_near_chosen(PyramidShape shape, VXL_LIGHT_TREE_PARAMETERS,
                                    float4 absorption,
                                    VXL_SCATTERING_PARAMETER VXL_DENSITY_PARAMETERS,
                                    PathSampling sampling, uint is_first, VXL_BATCH_PARAMETERS,
                                    uint count, VXL_MEDIUM_POINTS_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const RayQueue points = VXL_QUEUE;
    const DensityView density = VXL_DENSITY;
    const MediumScattering medium = VXL_MEDIUM_SCATTERING;
    const LightTree tree = VXL_LIGHT_TREE;
    Ways ways = ways_of(shape, &batch, first, count);
    if (!lanes_any(ways.active)) return;
    const PathSamples samples = path_samples(&sampling, ways.target, ways.state);
    const float extinction = (absorption.x + absorption.y + absorption.z + medium.per_metre[0] +
                              medium.per_metre[1] + medium.per_metre[2]) *
                             (1.0f / 3.0f);
    const Receivers receivers = receivers_on_way(ways.segment.origin, shape.edge, ways.direction,
                                                 ways.segment.t_first * ways.metres,
                                                 ways.segment.t_last * ways.metres, extinction);
    const uint decision = tree.has_areas ? VXL_DECISION_NEAR_AREA : VXL_DECISION_NEAR_CHOICE;
    ChosenLights chosen =
        choose_lights(&tree, &receivers, path_point(&samples, decision), ways.active);
    Vector middle;
    const Light light = chosen_light(&tree, &chosen, &middle);
    ways.active = chosen.found;
    if (!lanes_any(ways.active)) return;
    const NearPoints near = {absorption, &medium,  &density,   &batch,        is_first,
                             &points,    counters, point_hits, point_radiance};
    put_near_points(shape, &near, &ways, &light, middle, exact_reciprocal(chosen.probability),
                    chosen.number, &sampling, first);
}

/// Adds the light of all lights of the tree to points in the medium: each sends a shadow ray to one
/// of them. `are_near`: the points store which, and otherwise they choose.
kernel void add_chosen_light_to_medium(PyramidShape shape, VXL_LIGHT_TREE_PARAMETERS,
                                       PathSampling sampling, uint are_near,
                                       VXL_SCATTERING_PARAMETER VXL_SHADOW_QUEUE_PARAMETERS,
                                       VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const ShadowQueue queue = VXL_SHADOW_QUEUE;
    const MediumScattering medium = VXL_MEDIUM_SCATTERING;
    const LightTree tree = VXL_LIGHT_TREE;
    const PathSamples samples = samples_of_paths(&sampling, &batch, first);
    ChosenLights chosen = {below(first, count), LANES_LOAD(hits, VXL_POINT_LIGHT * stride + first),
                           (lane_float)1.0f};
    if (!are_near) {
        const Vector way = load_vector(rays + VXL_RAY_DX * stride, stride, first);
        const Receivers receivers =
            receivers_in_medium(load_vector(rays, stride, first), shape.edge,
                                unit(scaled(way, shape.edge)), medium.anisotropy);
        chosen = choose_by_path(&tree, &receivers, &samples, chosen.found);
    }
    Vector middle;
    const Light light = chosen_light(&tree, &chosen, &middle);
    if (!lanes_any(chosen.found)) return;
    const Vector from = chosen_points(&tree, &chosen, middle, &samples);
    shine_into_medium(shape, &light, middle, from, medium.anisotropy, &queue, &batch, first,
                      chosen.found);
}
