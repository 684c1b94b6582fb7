// SPDX-License-Identifier: Apache-2.0
// One layer of the surfaces on a ray's way: its light and coverage, and the rays that go straight
// on behind it.
#ifndef VXL_LAYER_H
#define VXL_LAYER_H

#include "lib/light/child_rays.h"
#include "lib/light/paths.h"
#include "lib/light/sent_rays.h"
#include "lib/traverse/hit_attributes.h"
#include "lib/traverse/ray_batch.h"
#include "lib/traverse/ray_queue.h"

/// The light that a packet's surfaces let through to the layer behind them.
typedef struct {
    lane_int valid, hit, leaving;  // masks
    lane_uint packed;
    lane_float opacity;
    lane_uint target;  // the nodes
} Layer;

static inline Layer load_layer(const Surroundings* around, global const uint* restrict colors,
                               const RayBatch* batch, uint first, uint count) {
    const uint stride = batch->stride;
    Layer l;
    l.valid = below(first, count);
    const lane_uint number = LANES_LOAD(batch->hits, VXL_HIT_VOXEL * stride + first);
    l.hit = LANE_MASK(number != VXL_NO_VOXEL) & l.valid;
    l.packed = LANES_LOAD(batch->hit_attributes, first);
    const lane_uint side = LANES_LOAD(batch->sides, first);
    const lane_int hidden = LANE_MASK((side & VXL_SIDE_HIDDEN) != 0u) & l.hit;
    l.leaving = LANE_MASK((side & VXL_SIDE_LEAVING) != 0u);
    const lane_uint material = material_offset(l.packed) & LANES_AS_UINT(l.hit);
    const Colors own = colors_of_hits(colors, number & LANES_AS_UINT(l.hit), batch->paint, first);
    const lane_float opacity = surface_opacity(around->materials, material, own);
    l.opacity = LANES_SELECT(l.hit, opacity, (lane_float)1.0f);
    l.opacity = LANES_SELECT(hidden, (lane_float)0.0f, l.opacity);
    l.target = LANES_LOAD(batch->paths, VXL_PATH_TARGET * stride + first);
    return l;
}

/// Adds the layer's light and coverage to its nodes. `on` gets what is left of both for the layers
/// behind. With VXL_OWN_LIGHT, which keeps layers apart, nothing is added.
static inline void add_layer(const Layer* l, const RayBatch* batch, uint first, uint first_layer,
                             const NodeLight* nodes, global float* restrict node_weights,
                             NewRays* on) {
    const uint stride = batch->stride;
    const lane_float left = 1.0f - l->opacity;
    for (uint c = 0; c < 3; ++c) {
        const lane_float before = path_float(batch->paths, VXL_PATH_THROUGHPUT + c, stride, first);
        if (!VXL_OWN_LIGHT)
            add_to_nodes(nodes, c, l->valid, l->target,
                         before * LANES_LOAD(batch->radiance, c * stride + first), first_layer);
        lane_float behind = before;
        if (VXL_ABSORBS) behind *= LANES_LOAD(batch->transmittance, c * stride + first);
        if (!VXL_GLOBAL) LANES_STORE(behind * l->opacity, node_weights, c * stride + first);
        on->throughput[c] = behind * left;
    }
    const lane_float clear = path_float(batch->paths, VXL_PATH_CLEAR, stride, first);
    on->clear = LANES_SELECT(l->hit, clear * left, clear);
    if (VXL_OWN_LIGHT || nodes->coverage == 0) return;
    int add[VXL_LANES];
    uint node[VXL_LANES];
    float covered[VXL_LANES];
    LANES_STORE(l->valid, add, 0);
    LANES_STORE(l->target, node, 0);
    LANES_STORE(1.0f - on->clear, covered, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane)
        if (add[lane]) nodes->coverage[node[lane]] = covered[lane];
}

/// Completes rays that go straight on through the layer's surfaces.
static inline void go_straight(PyramidShape shape, const Layer* l, const Surroundings* around,
                               const RayBatch* batch, uint first, lane_int goes_on, NewRays* on) {
    global const uint* hits = batch->hits;
    const uint stride = batch->stride;
    on->origin = load_vector(batch->rays, stride, first);
    on->direction = load_vector(batch->rays + VXL_RAY_DX * stride, stride, first);
    on->t_end = LANES_LOAD(batch->rays, VXL_RAY_END * stride + first);
    on->start = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    on->source = source_of_hits(hits, stride, first, l->packed);
    if (VXL_INSTANCES) on->instance = LANES_LOAD(hits, VXL_HIT_INSTANCE * stride + first);
    on->flags = LANES_SELECT(l->leaving, (lane_uint)0, (lane_uint)VXL_PATH_WITHIN_SOURCE) |
                (VXL_PATH_ON_SURFACE | VXL_PATH_GOES_ON);
    on->cell_xy = LANES_LOAD(hits, VXL_HIT_CELL * stride + first);
    on->cell_z = LANES_LOAD(hits, VXL_HIT_FACE * stride + first);
    on->target = l->target;
    if (VXL_GLOBAL) {  // nothing has scattered the path
        on->state = met_after(LANES_LOAD(batch->paths, VXL_PATH_STATE * stride + first));
        on->emitter = (lane_uint)0;
        on->travelled = on->density = (lane_float)0.0f;
    }
    on->media = cross_counted(
        load_medium_set(batch->paths, stride, first, l->valid), l->packed, l->leaving,
        goes_on & bodies_of(around, batch, first, l->packed, l->hit), around->medium_overflows);
    if (VXL_CUBE_BODIES) on->flags |= joined_flag(&on->media, around->materials);
    const lane_int restarted = goes_on & are_of_instances(batch, first);
    begin_behind(shape, batch, first, restarted, on);
    on->width = width_straight(batch, first, restarted);
    on->medium = medium_inside(&on->media, around->ranks);
}

#endif
