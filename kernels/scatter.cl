// SPDX-License-Identifier: Apache-2.0
// surface points -> the rays that continue from them (straight, reflected, refracted); and those
// rays' light -> the light of the points.
//
// Every ray is an entry of a batch and belongs to a node: the light along one ray of the tree that
// Whitted 1980 describes. Surfaces that transmit light straight add further entries of the same
// node, layer by layer; reflection and refraction make nodes of the next depth. Each entry gathers
// light from its own children, so that no sum depends on the order of the queues.
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/light/child_rays.h"
#include "lib/light/layer.h"
#include "lib/light/paths.h"
#include "lib/light/scatter_point.h"
#include "lib/solid/solid_hit.h"
#include "lib/surface/surface_color.h"
#include "lib/traverse/bounds_slack.h"
#include "lib/traverse/hit_attributes.h"
#include "lib/traverse/ray_batch.h"
#include "lib/traverse/ray_queue.h"
#include "shared/scene.h"

/// Makes each ray from an observer the entry of its own node. `bodies` are the solids that transmit
/// light, in which a ray may begin. A ray that enters the world where a solid's face lies on the
/// world's side begins in front of this face.
kernel void begin_paths(PyramidShape shape, global const SolidShape* restrict solids,
                        uint body_count, global const uint* restrict bodies,
                        VXL_SURROUNDINGS_PARAMETERS, VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const Surroundings around = VXL_SURROUNDINGS;
    const RayBatch batch = VXL_BATCH;
    const lane_uint one = LANES_AS_UINT((lane_float)1.0f);
    LANES_STORE((lane_uint)VXL_NO_PRIMITIVE, batch.paths, VXL_PATH_SOURCE * batch.stride + first);
    LANES_STORE((lane_uint)0, batch.paths, VXL_PATH_FLAGS * batch.stride + first);
    LANES_STORE(VXL_GLOBAL ? (lane_uint)0 : one, batch.paths,
                VXL_PATH_WEIGHT * batch.stride + first);
    if (VXL_INSTANCES)
        LANES_STORE((lane_uint)VXL_NO_INSTANCE, batch.paths,
                    VXL_PATH_INSTANCE * batch.stride + first);
    if (VXL_WIDENS) LANES_STORE((lane_uint)0, batch.paths, VXL_PATH_WIDTH * batch.stride + first);
    if (!(VXL_TRANSMISSION | VXL_GLOBAL)) return;
    LANES_STORE(LANES_AS_UINT(LANES_NUMBERS + (int)first), batch.paths,
                VXL_PATH_TARGET * batch.stride + first);
    for (uint c = 0; c < 3; ++c)
        LANES_STORE(one, batch.paths, (VXL_PATH_THROUGHPUT + c) * batch.stride + first);
    if (VXL_LOOKS) LANES_STORE((lane_uint)0, batch.paths, VXL_PATH_EMITTER * batch.stride + first);
    if (VXL_TRAVELS)
        LANES_STORE((lane_uint)0, batch.paths, VXL_PATH_TRAVELLED * batch.stride + first);
    if (VXL_AREA_SHARES)
        LANES_STORE((lane_uint)0, batch.paths, VXL_PATH_DENSITY * batch.stride + first);
    if (!VXL_TRANSMISSION) return;
    LANES_STORE((lane_uint)0, batch.paths, VXL_PATH_CELL * batch.stride + first);
    LANES_STORE((lane_uint)0, batch.paths, VXL_PATH_CELL_Z * batch.stride + first);
    LANES_STORE(one, batch.paths, VXL_PATH_CLEAR * batch.stride + first);
    LANES_STORE((lane_float)0.0f, batch.starts, first);
    MediumSet in = empty_medium_set();
    if (VXL_SOLIDS) {
        const Vector o = load_vector(batch.rays, batch.stride, first);
        const Vector d = load_vector(batch.rays + VXL_RAY_DX * batch.stride, batch.stride, first);
        const SolidRay ray = {o.x, o.y, o.z, d.x, d.y, d.z};
        const lane_int valid =
            below(first, count) &
            LANE_MASK(LANES_LOAD(batch.rays, VXL_RAY_END * batch.stride + first) >= 0.0f);
        const lane_float t_first =
            -slack_of_entry(o, d, shape.size_x, shape.size_y, shape.size_z) * shape.plane_bound;
        for (uint i = 0; i < body_count; ++i) {
            const SolidEvent event = event_at(solids, bodies[i], &ray, t_first);
            in = cross_counted(in, (lane_uint)solids[bodies[i]].attribute, (lane_int)0,
                               event.after & valid, around.medium_overflows);
        }
    }
    store_medium_set(&in, batch.paths, batch.stride, first);
    LANES_STORE(medium_inside(&in, around.ranks), batch.inside, first);
}

/// Adds a layer's light to its nodes, whose sums the first layer starts, unless VXL_OWN_LIGHT keeps
/// layers apart. Sends on the rays whose surfaces don't cover what lies behind completely. In local
/// light, writes to `node_weights` the weight that an entry's reflected and refracted light has in
/// its node.
kernel void pass_layer(PyramidShape shape, VXL_SURROUNDINGS_PARAMETERS,
                       global const uint* restrict colors, float min_weight, uint first_layer,
                       VXL_BATCH_PARAMETERS, uint count, global float* restrict node_weights,
                       VXL_NODE_PARAMETERS, VXL_COUNTED_QUEUE_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const Surroundings around = VXL_SURROUNDINGS;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const RayQueue queue = VXL_QUEUE;
    const Layer layer = load_layer(&around, colors, &batch, first, count);
    NewRays on;
    add_layer(&layer, &batch, first, first_layer, &nodes, node_weights, &on);
    const lane_int through = layer.hit & LANE_MASK(1.0f - layer.opacity > 0.0f);
    on.weight = VXL_GLOBAL ? (lane_float)1.0f : path_float(paths, VXL_PATH_WEIGHT, stride, first);
    const lane_int goes_on = through & LANE_MASK(on.weight * largest(on.throughput) >= min_weight);
    count_lanes(through & ~goes_on, counters + VXL_COUNT_ENDED);
    if (!lanes_any(goes_on)) return;
    go_straight(shape, &layer, &around, &batch, first, goes_on, &on);
    const Slots slots = reserve_slots(goes_on, counters + VXL_COUNT_LAYER);
    put_rays(&queue, &on, &slots);
}

/// Where the reflected or refracted rays of a packet's entries are written.
typedef struct {
    RayQueue queue;
    uint compact;  // 0: lane i writes to `slot` + i, even without a ray
    uint slot;
    global uint* counters;
    global uint* restrict nodes;           // of the entries' children
    global float* restrict child_weights;  // of the children
} Destination;

/// Puts the wanted lanes of `r` into the queue of children and notes their slots for gather_light.
/// Without compaction every entry has a slot, and unwanted slots hold idle rays.
static inline void put_children(const Destination* to, NewRays* r, Scattered s, lane_int valid) {
    Slots slots;
    lane_uint at;
    if (to->compact) {
        slots = reserve_slots(s.wanted, to->counters + VXL_COUNT_CHILDREN);
        at = slots.first + lanes_ranks(s.wanted);
    } else {
        slots = slots_from(to->slot, valid);
        at = to->slot + LANES_AS_UINT(LANES_NUMBERS);
        r->t_end = LANES_SELECT(s.wanted, r->t_end, (lane_float)-1.0f);
    }
    if (VXL_TRANSMISSION) r->target = at;
    if (slots.count > 0) put_rays(&to->queue, r, &slots);
    LANES_STORE(LANES_SELECT(s.wanted, at, (lane_uint)VXL_NO_CHILD), to->nodes, 0);
    LANES_STORE(s.returned, to->child_weights, 0);
}

/// Notes that a packet's entries have no children. True if compacted queues get none, either.
static inline int has_no_children(const Destination* to, lane_int wanted) {
    if (!to->compact | (lanes_any(wanted) != 0)) return 0;
    LANES_STORE((lane_uint)VXL_NO_CHILD, to->nodes, 0);
    return 1;
}

/// The weight in a pixel that the entries' reflected and refracted light may still have.
static inline lane_float weight_behind(const RayBatch* batch,
                                       global const float* restrict node_weights, uint first) {
    const lane_float one = (lane_float)1.0f;
    lane_float node_weight[3] = {one, one, one};
    for (uint c = 0; c < 3; ++c) {
        if (VXL_TRANSMISSION)
            node_weight[c] = LANES_LOAD(node_weights, c * batch->stride + first);
        else if (VXL_ABSORBS)
            node_weight[c] = LANES_LOAD(batch->transmittance, c * batch->stride + first);
    }
    return path_float(batch->paths, VXL_PATH_WEIGHT, batch->stride, first) * largest(node_weight);
}

/// The index, in `child_weights`, of the tint that a surface gives to what it mirrors.
static inline uint tint_of(uint channel, uint stride, uint entry) {
    return ((VXL_REFRACTS ? 2u : 1u) + channel) * stride + entry;
}

/// Writes the tints that a packet's surfaces give to what they mirror.
static inline void store_tints(const Surroundings* around, const ScatterPoint* p,
                               global const uint* restrict colors, const RayBatch* batch,
                               global float* restrict child_weights, uint first) {
    global const float* materials = around->materials;
    const lane_uint voxel =
        LANES_LOAD(batch->hits, VXL_HIT_VOXEL * batch->stride + first) & LANES_AS_UINT(p->hit);
    const Colors own = colors_of_hits(colors, voxel, batch->paint, first);
    const lane_uint color_index =
        color_offset(materials, p->material, p->position.x, p->position.y, p->position.z);
    const lane_float tint =
        mapped_value(materials, p->material + VXL_MATERIAL_MIRROR_TINT, own, VXL_PAINT_MIRROR_TINT);
    for (uint c = 0; c < 3; ++c)
        LANES_STORE(tinted(surface_color(materials, color_index, own, (int)c), tint), child_weights,
                    tint_of(c, batch->stride, first));
}

/// Sends reflected and refracted rays from entries begin .. end-1 of the batch. For each entry, the
/// arrays of children hold the node and the weight of its reflected light and, `stride` values
/// later, of its refracted light.
kernel void scatter_rays(PyramidShape shape, VXL_SURROUNDINGS_PARAMETERS, float min_weight,
                         uint compact, global const uint* restrict colors, VXL_BATCH_PARAMETERS,
                         uint begin, uint end, VXL_CHILDREN_PARAMETERS,
                         VXL_COUNTED_QUEUE_PARAMETERS) {
    const uint first = begin + work_item() * VXL_LANES;
    if (first >= end) return;
    const Surroundings around = VXL_SURROUNDINGS;
    const RayBatch batch = VXL_BATCH;
    ScatterPoint p = load_point(&batch, shape.edge, first, end);
    Scattered reflected, refracted;
    scatter_light(&around, &p, &reflected, &refracted);
    const lane_float weight = weight_behind(&batch, node_weights, first);
    const lane_int mirror = LANE_MASK(reflected.returned > 0.0f) & p.hit;
    const lane_int glass = LANE_MASK(refracted.returned > 0.0f) & p.hit;
    reflected.wanted = mirror & LANE_MASK(weight * reflected.returned >= min_weight);
    refracted.wanted = glass & LANE_MASK(weight * refracted.returned >= min_weight);
    count_lanes(mirror & ~reflected.wanted, counters + VXL_COUNT_ENDED);
    if (VXL_REFRACTS) count_lanes(glass & ~refracted.wanted, counters + VXL_COUNT_ENDED);

    Destination to = {
        VXL_QUEUE, compact, first - begin, counters, child_nodes + first, child_weights + first};
    NewRays ray = begin_node(&p, &batch, first);
    if (!has_no_children(&to, reflected.wanted)) {
        ray.weight = weight * reflected.returned;
        reflect_rays(shape, &around, &p, &batch, first, &ray);
        put_children(&to, &ray, reflected, p.valid);
        if (VXL_TINTED) store_tints(&around, &p, colors, &batch, child_weights, first);
    }
    if (!VXL_REFRACTS) return;
    to.slot += end - begin;
    to.nodes += stride, to.child_weights += stride;
    if (has_no_children(&to, refracted.wanted)) return;
    ray.weight = weight * refracted.returned;
    refract_rays(shape, &around, &p, &batch, first, &ray);
    put_children(&to, &ray, refracted, p.valid);
}

/// Adds the light of each entry's children, which `light` holds, to the entry's node. One work-item
/// takes one entry.
kernel void gather_light(uint begin, uint end, VXL_CHILDREN_PARAMETERS,
                         global const float* restrict transmittance,
                         global const uint* restrict paths, uint stride,
                         global const float* restrict light, uint light_stride,
                         global float* restrict nodes, uint node_stride) {
    const uint entry = begin + work_item();
    if (entry >= end) return;
    const uint reflected = child_nodes[entry];
    const uint refracted = VXL_REFRACTS ? child_nodes[stride + entry] : VXL_NO_CHILD;
    if ((reflected == VXL_NO_CHILD) & (refracted == VXL_NO_CHILD)) return;
    const uint node = VXL_TRANSMISSION ? paths[VXL_PATH_TARGET * stride + entry] : entry;
    for (uint c = 0; c < 3; ++c) {
        float sum = 0.0f;
        if (reflected != VXL_NO_CHILD) {
            sum = child_weights[entry] * light[c * light_stride + reflected];
            if (VXL_TINTED) sum *= child_weights[tint_of(c, stride, entry)];
        }
        if (refracted != VXL_NO_CHILD)
            sum += child_weights[stride + entry] * light[c * light_stride + refracted];
        float node_weight = 1.0f;
        if (VXL_TRANSMISSION)
            node_weight = node_weights[c * stride + entry];
        else if (VXL_ABSORBS)
            node_weight = transmittance[c * stride + entry];
        nodes[c * node_stride + node] += node_weight * sum;
    }
}
