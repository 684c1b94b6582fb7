// SPDX-License-Identifier: Apache-2.0
// Rays that begin on surfaces, and the left-packed queues that they wait in.
#ifndef VXL_RAY_QUEUE_H
#define VXL_RAY_QUEUE_H

#include "lib/lanes/vector.h"
#include "lib/traverse/medium_set.h"
#include "shared/trace.h"

/// A packet of new rays; see shared/trace.h for the components.
typedef struct {
    Vector origin, direction;
    lane_float t_end;
    lane_uint source, flags;
    lane_uint instance;  // in scenes with instances
    lane_float weight;   // not in global light
    lane_uint state;     // of paths in global light: VXL_PATH_STATE
    // in scenes with transmitting objects or in global light
    lane_uint target;
    lane_float throughput[3];
    lane_uint emitter;     // where paths look for emitters: VXL_PATH_EMITTER
    lane_float travelled;  // where it exists: VXL_PATH_TRAVELLED
    lane_float density;    // where it exists: VXL_PATH_DENSITY
    lane_float width;      // where it exists: VXL_PATH_WIDTH
    // in scenes with transmitting objects
    lane_uint cell_xy, cell_z, medium;  // medium: RayBatch::inside
    lane_float start, clear;
    MediumSet media;
} NewRays;

/// The parameters that `bind` of a RayQueue sets, in its order.
#define VXL_QUEUE_PARAMETERS                                            \
    global float *restrict next_rays, global uint *restrict next_paths, \
        global float *restrict next_starts, global uint *restrict next_inside, uint next_stride

/// The counters of rays that are sent on, and their queue: what `bind` of a CountedQueue sets.
#define VXL_COUNTED_QUEUE_PARAMETERS global uint *restrict counters, VXL_QUEUE_PARAMETERS

/// A queue of new rays, with `stride` slots.
typedef struct {
    global float* rays;
    global uint* paths;
    global float* starts;
    global uint* inside;
    uint stride;
} RayQueue;

/// The value of a RayQueue in a kernel with these parameters.
#define VXL_QUEUE \
    { next_rays, next_paths, next_starts, next_inside, next_stride }

/// The wanted lanes of a packet, left-packed, and the index of the first one in a queue.
typedef struct {
    uint first, count;
    uint lane[VXL_LANES];
} Slots;

static inline Slots slots_from(uint first, lane_int wanted) {
    Slots p;
    int lanes[VXL_LANES];
    LANES_STORE(wanted, lanes, 0);
    p.first = first, p.count = 0;
    for (int lane = 0; lane < VXL_LANES; ++lane) {
        p.lane[p.count] = (uint)lane;
        p.count += (uint)(lanes[lane] & 1);
    }
    return p;
}

/// Reserves a slot behind the `count` reserved ones for every lane of a mask, all at once. No
/// result depends on which slots these are.
static inline Slots reserve_slots(lane_int wanted, global uint* count) {
    const uint sum = (uint)lanes_count(wanted);
    return slots_from(sum == 0 ? 0 : atomic_add(count, sum), wanted);
}

static inline void put_uint(global uint* to, lane_uint value, const Slots* slots) {
    if (slots->count == VXL_LANES) {
        LANES_STORE(value, to, slots->first);
        return;
    }
    uint values[VXL_LANES];
    LANES_STORE(value, values, 0);
    for (uint i = 0; i < slots->count; ++i) to[slots->first + i] = values[slots->lane[i]];
}

static inline void put_float(global float* to, lane_float value, const Slots* slots) {
    put_uint((global uint*)to, LANES_AS_UINT(value), slots);
}

static inline void put_rays(const RayQueue* q, const NewRays* r, const Slots* slots) {
    const size_t n = q->stride;
    put_float(q->rays + VXL_RAY_OX * n, r->origin.x, slots);
    put_float(q->rays + VXL_RAY_OY * n, r->origin.y, slots);
    put_float(q->rays + VXL_RAY_OZ * n, r->origin.z, slots);
    put_float(q->rays + VXL_RAY_DX * n, r->direction.x, slots);
    put_float(q->rays + VXL_RAY_DY * n, r->direction.y, slots);
    put_float(q->rays + VXL_RAY_DZ * n, r->direction.z, slots);
    put_float(q->rays + VXL_RAY_END * n, r->t_end, slots);
    put_uint(q->paths + VXL_PATH_SOURCE * n, r->source, slots);
    put_uint(q->paths + VXL_PATH_FLAGS * n, r->flags, slots);
    put_uint(q->paths + VXL_PATH_WEIGHT * n, VXL_GLOBAL ? r->state : LANES_AS_UINT(r->weight),
             slots);
    if (VXL_INSTANCES) put_uint(q->paths + VXL_PATH_INSTANCE * n, r->instance, slots);
    if (VXL_WIDENS) put_uint(q->paths + VXL_PATH_WIDTH * n, LANES_AS_UINT(r->width), slots);
    if (!(VXL_TRANSMISSION | VXL_GLOBAL)) return;
    put_uint(q->paths + VXL_PATH_TARGET * n, r->target, slots);
    for (uint c = 0; c < 3; ++c)
        put_uint(q->paths + (VXL_PATH_THROUGHPUT + c) * n, LANES_AS_UINT(r->throughput[c]), slots);
    if (VXL_LOOKS) put_uint(q->paths + VXL_PATH_EMITTER * n, r->emitter, slots);
    if (VXL_TRAVELS)
        put_uint(q->paths + VXL_PATH_TRAVELLED * n, LANES_AS_UINT(r->travelled), slots);
    if (VXL_AREA_SHARES)
        put_uint(q->paths + VXL_PATH_DENSITY * n, LANES_AS_UINT(r->density), slots);
    if (!VXL_TRANSMISSION) return;
    put_uint(q->paths + VXL_PATH_CELL * n, r->cell_xy, slots);
    put_uint(q->paths + VXL_PATH_CELL_Z * n, r->cell_z, slots);
    put_uint(q->paths + VXL_PATH_CLEAR * n, LANES_AS_UINT(r->clear), slots);
    for (uint i = 0; i < VXL_MEDIUM_SET_SIZE; ++i)
        put_uint(q->paths + (VXL_PATH_INSIDE + i) * n, r->media.members[i], slots);
    put_float(q->starts, r->start, slots);
    put_uint(q->inside, r->medium, slots);
}

#endif
