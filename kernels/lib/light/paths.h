// SPDX-License-Identifier: Apache-2.0
// The state that a path's rays pass on, and the nodes that collect their light.
#ifndef VXL_PATHS_H
#define VXL_PATHS_H

#include "lib/surface/cube_body.h"
#include "lib/surface/shading_normal.h"
#include "lib/traverse/medium_set.h"
#include "lib/traverse/ray_batch.h"
#include "lib/traverse/surroundings.h"
#include "shared/paths.h"

/// Marks an entry that sends no ray and so has no node.
#define VXL_NO_CHILD 0xFFFFFFFFu

/// Indices into `counters`.
#define VXL_COUNT_LAYER 0u        // entries of the next layer
#define VXL_COUNT_CHILDREN 1u     // nodes of the next depth
#define VXL_COUNT_TO_EMITTERS 0u  // in global light: rays to emitters
#define VXL_COUNT_ENDED 2u        // paths that ended because of their small weight

/// The parameters that `bind` of NodeLight sets, in its order.
#define VXL_NODE_PARAMETERS \
    global float* restrict node_radiance, global float* restrict node_coverage, uint node_stride

/// The light that nodes sum up; `coverage` may be null.
typedef struct {
    global float* restrict radiance;
    global float* restrict coverage;
    uint stride;
} NodeLight;

/// The value of NodeLight in a kernel with these parameters.
#define VXL_NODES \
    { node_radiance, node_coverage, node_stride }

/// The parameters that `bind` of Children sets, in its order.
#define VXL_CHILDREN_PARAMETERS                                              \
    global uint *restrict child_nodes, global float *restrict child_weights, \
        global float *restrict node_weights

/// The reflected and refracted rays of a batch: runtime/stages/trace/scatter.hpp.
typedef struct {
    global uint* restrict nodes;
    global float* restrict child_weights;
    global float* restrict node_weights;
} Children;

/// The value of Children in a kernel with these parameters.
#define VXL_CHILDREN \
    { child_nodes, child_weights, node_weights }

static inline lane_float path_float(global const uint* paths, uint component, uint stride,
                                    uint first) {
    return LANES_AS_FLOAT(LANES_LOAD(paths, component * stride + first));
}

/// What is left of the light on its way to the nodes of a packet's paths.
static inline void load_throughput(global const uint* paths, uint stride, uint first,
                                   lane_float throughput[3]) {
    for (uint c = 0; c < 3; ++c)
        throughput[c] = path_float(paths, VXL_PATH_THROUGHPUT + c, stride, first);
}

static inline lane_float largest(const lane_float* value) {
    return fmax(value[0], fmax(value[1], value[2]));
}

/// The probability that a path continues that can still bring this share of a light. The square
/// root balances the time that a path takes against the noise of ending it.
static inline lane_float chance_to_go_on(lane_float brings) {
    return exact_sqrt(fmin(brings, 1.0f));
}

static inline lane_int below(uint first, uint count) {
    return LANE_MASK(LANES_AS_INT(LANES_NUMBERS + (int)first) < (int)count);
}

/// VXL_PATH_JOINED for rays inside a set of objects.
static inline lane_uint joined_flag(const MediumSet* in, global const float* restrict materials) {
    return LANES_AS_UINT(is_joined(body_inside(in), materials)) & VXL_PATH_JOINED;
}

/// The index of refraction of a medium as in RayBatch::inside.
static inline lane_float medium_ior(global const float* restrict materials, lane_uint medium) {
    const lane_int some = LANE_MASK(medium != 0u);
    const lane_uint material = ((medium - 1u) & LANES_AS_UINT(some)) * VXL_MATERIAL_FLOATS;
    return LANES_SELECT(some, LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_IOR),
                        (lane_float)1.0f);
}

/// Mask: hits whose paths may share light with rays that are sent to lights with an area. Hits
/// inside transmitting objects don't, nor do cubes with normals: rays to lights begin above their
/// steps, but paths don't.
static inline lane_int shares_light(const RayBatch* batch, uint first) {
    lane_int shares = LANE_MASK(LANES_NUMBERS >= 0);
    if (VXL_TRANSMISSION) shares &= LANE_MASK(LANES_LOAD(batch->inside, first) == 0u);
    if (VXL_VOXEL_NORMALS) {
        const Vector offset =
            load_vector(batch->shading + VXL_SHADING_OFFSET * batch->stride, batch->stride, first);
        const lane_uint packed = LANES_LOAD(batch->hit_attributes, first);
        shares &= ~(has_length(offset) & LANE_MASK((packed >> VXL_KIND_SHIFT) == VXL_KIND_CUBES));
    }
    return shares;
}

/// The part of lights' `area` that paths from hits may run into; 0 where the paths end.
static inline lane_float area_met_too(const RayBatch* batch, uint first, uint most_bounces,
                                      lane_float area) {
    const lane_uint state = LANES_LOAD(batch->paths, VXL_PATH_STATE * batch->stride + first);
    const lane_uint bounces = (state >> VXL_STATE_BOUNCE_SHIFT) & VXL_STATE_BOUNCES;
    const lane_int goes_on = LANE_MASK(bounces < most_bounces);
    return LANES_SELECT(goes_on & shares_light(batch, first), area, (lane_float)0.0f);
}

/// Adds a channel's light to the nodes that the `valid` lanes name, at most one lane per node. With
/// `begins`, the light starts their sums.
static inline void add_to_nodes(const NodeLight* nodes, uint channel, lane_int valid,
                                lane_uint target, lane_float light, uint begins) {
    int add[VXL_LANES];
    uint node[VXL_LANES];
    float added[VXL_LANES];
    LANES_STORE(valid, add, 0);
    LANES_STORE(target, node, 0);
    LANES_STORE(light, added, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane) {
        if (!add[lane]) continue;
        global float* sum = nodes->radiance + channel * nodes->stride + node[lane];
        *sum = begins ? added[lane] : *sum + added[lane];
    }
}

static inline void count_lanes(lane_int mask, global uint* counter) {
    if (lanes_any(mask)) atomic_add(counter, (uint)lanes_count(mask));
}

/// Does what cross_medium does, and counts sets that were full in `overflows`.
static inline MediumSet cross_counted(MediumSet in, lane_uint packed, lane_int leaving,
                                      lane_int crossing, global uint* overflows) {
    lane_int full;
    const MediumSet crossed = cross_medium_or_overflow(in, packed, leaving, crossing, &full);
    if (VXL_MEDIUM_SET_CAPPED) count_lanes(full, overflows);
    return crossed;
}

#endif
