// SPDX-License-Identifier: Apache-2.0
// surface points of paths + a light with an area -> a queue of shadow rays to points of the light;
// and paths that run into the light -> the light that they find there. The latter paths come from
// mirrors, through glass and from physically based surfaces.
#include "lib/lanes/work_item.h"
#include "lib/light/area_points.h"
#include "lib/light/direct_light.h"
#include "lib/light/paths.h"
#include "lib/medium/sight_loss.h"
#if VXL_CHOSEN_AREAS
#include "lib/light/light_tree.h"
#endif

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
    const lane_float met_too =
        area_met_too(&batch, first, sampling.bounces, (lane_float)area.axis_y.w);
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

/// What a packet of paths may run into lights with.
typedef struct {
    PyramidShape shape;
    const RayBatch* batch;
    const NodeLight* nodes;
    Surroundings around;
    Segment way;
    lane_float travelled;
    lane_uint state, target, material;
    lane_int valid, open;  // masks: rays; rays that meet nothing
} MeetingPaths;

static inline MeetingPaths meeting_paths(PyramidShape shape, const Surroundings* around,
                                         const RayBatch* batch, const NodeLight* nodes, uint first,
                                         uint count) {
    const uint stride = batch->stride;
    MeetingPaths m;
    m.shape = shape;
    m.batch = batch;
    m.nodes = nodes;
    m.around = *around;
    m.way = whole_segment(batch, first);
    m.travelled = (lane_float)0.0f;
    if (VXL_TRAVELS) m.travelled = path_float(batch->paths, VXL_PATH_TRAVELLED, stride, first);
    m.state = LANES_LOAD(batch->paths, VXL_PATH_STATE * stride + first);
    m.target = LANES_LOAD(batch->paths, VXL_PATH_TARGET * stride + first);
    m.material = (lane_uint)0u;
    if (VXL_ABSORBS && VXL_TRANSMISSION) m.material = LANES_LOAD(batch->inside, first);
    m.valid = below(first, count);
    m.open = LANE_MASK(LANES_LOAD(batch->hits, VXL_HIT_VOXEL * stride + first) == VXL_NO_VOXEL);
    return m;
}

/// Adds the light of paths that run into a light before they meet anything else to the sight rays
/// that the paths began as. Weights it by met_weight.
static inline void meet_light(const MeetingPaths* p, LightRecord light, LightAreaRecord area,
                              uint first) {
    const RayBatch* batch = p->batch;
    Segment way = p->way;
    const AreaMeeting m =
        meet_area(light, area, p->shape.edge, way.origin, way.direction, p->travelled);
    const lane_float weight = met_weight(batch, first, p->state, m.falloff, area.axis_y.w);
    const lane_int met = p->valid & m.met & LANE_MASK(weight > 0.0f) &
                         LANE_MASK(m.t >= way.t_first) & (p->open | LANE_MASK(m.t < way.t_last));
    if (!lanes_any(met)) return;
    lane_float left[3] = {(lane_float)1.0f, (lane_float)1.0f, (lane_float)1.0f};
    if (VXL_ABSORBS) {
        way.t_last = LANES_SELECT(met, m.t, way.t_last);
        let_through(p->shape, &p->around, &way, p->material, met, left);
    }
    const float intensity[3] = {light.intensity.x, light.intensity.y, light.intensity.z};
    for (uint c = 0; c < 3; ++c) {
        const lane_float throughput =
            path_float(batch->paths, VXL_PATH_THROUGHPUT + c, batch->stride, first);
        add_to_nodes(p->nodes, c, met, p->target,
                     throughput * left[c] * weight * (intensity[c] * 3.14159265f), 0);
    }
}

/// Adds the light of one light to paths that run into it.
kernel void meet_area_light(PyramidShape shape, LightRecord light, LightAreaRecord area,
                            VXL_SURROUNDINGS_PARAMETERS, VXL_BATCH_PARAMETERS, uint count,
                            VXL_NODE_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const Surroundings around = VXL_SURROUNDINGS;
    const MeetingPaths paths_here = meeting_paths(shape, &around, &batch, &nodes, first, count);
    meet_light(&paths_here, light, area, first);
}

#if VXL_CHOSEN_AREAS
/// True if some of the paths' lines come near the ball of a node: at most its radius r and, for
/// rounding, e = 1e-5 of the distance. The test is wider, since (r + e)^2 <= 2 (r^2 + e^2).
static inline bool comes_near(const MeetingPaths* p, Vector way, const Nodes* n) {
    const Vector to = scaled(difference(n->middle, p->way.origin), p->shape.edge);
    const lane_float ahead = dot_product(to, way), distance = dot_product(to, to);
    const Vector across = add_scaled(to, way, -ahead);
    const lane_float squared_radius = n->radius * n->radius;
    return lanes_any(p->valid & LANE_MASK(dot_product(across, across) <=
                                          2.0f * fma(distance, 1e-10f, squared_radius)));
}

/// Adds the light of all lights of a tree, whose nodes are met from left to right.
kernel void meet_area_lights(PyramidShape shape, VXL_LIGHT_TREE_PARAMETERS,
                             VXL_SURROUNDINGS_PARAMETERS, VXL_BATCH_PARAMETERS, uint count,
                             VXL_NODE_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const Surroundings around = VXL_SURROUNDINGS;
    const MeetingPaths paths_here = meeting_paths(shape, &around, &batch, &nodes, first, count);
    const Vector way = unit(scaled(paths_here.way.direction, shape.edge));
    const LightTree tree = VXL_LIGHT_TREE;
    const uint leaves = 1u << tree.levels;
    uint node = 1;
    do {
        const Nodes n = load_node(tree.nodes + node * VXL_NODE_WORDS);
        if (tree.nodes[node * VXL_NODE_WORDS + VXL_NODE_POWER] > 0.0f &&
            comes_near(&paths_here, way, &n)) {
            if (node < leaves) {
                node *= 2;
                continue;
            }
            const uint leaf = node - leaves;
            meet_light(&paths_here, ((global const LightRecord*)tree.lights)[leaf],
                       ((global const LightAreaRecord*)tree.areas)[leaf], first);
        }
        // The next node to the right, as high up as possible.
        for (++node; (node & 1) == 0; node /= 2) {
        }
    } while (node > 1);
}
#endif
