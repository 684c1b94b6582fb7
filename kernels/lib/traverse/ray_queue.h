// Rays that are born on surfaces, and the left-packed queues that they wait in.
#ifndef VXL_RAY_QUEUE_H
#define VXL_RAY_QUEUE_H

#include "lib/lanes/vector.h"
#include "lib/light/interior.h"
#include "shared/trace.h"

/// A packet of new rays; see shared/trace.h for the components.
typedef struct {
    Vector origin, direction;
    lane_float t_end;
    lane_uint source, flags;
    lane_uint instance;  // of scenes with instances
    lane_float weight;
    // of scenes with transmitting objects
    lane_uint cell_xy, cell_z, target, medium;  // medium: RayBatch::inside
    lane_float start, clear;
    lane_float passed[3];
    Interior interior;
} NewRays;

/// Where they go: `stride` places.
typedef struct {
    global float* rays;
    global uint* paths;
    global float* starts;
    global uint* inside;
    uint stride;
} RayQueue;

/// The wanted lanes of a packet beside each other, and where in a queue they are put.
typedef struct {
    uint first, count;
    uint lane[VXL_LANES];
} Places;

static inline Places places_from(uint first, lane_int wanted) {
    Places p;
    int lanes[VXL_LANES];
    LANES_STORE(wanted, lanes, 0);
    p.first = first, p.count = 0;
    for (int lane = 0; lane < VXL_LANES; ++lane) {
        p.lane[p.count] = (uint)lane;
        p.count += (uint)(lanes[lane] & 1);
    }
    return p;
}

/// Reserves a place behind `count` for every lane of a mask, all at once. Where the places are does
/// not matter to any result.
static inline Places reserve_places(lane_int wanted, global uint* count) {
    const uint sum = (uint)lanes_count(wanted);
    return places_from(sum == 0 ? 0 : atomic_add(count, sum), wanted);
}

static inline void put_uint(global uint* to, lane_uint value, const Places* places) {
    uint values[VXL_LANES];
    LANES_STORE(value, values, 0);
    for (uint i = 0; i < places->count; ++i) to[places->first + i] = values[places->lane[i]];
}

static inline void put_float(global float* to, lane_float value, const Places* places) {
    put_uint((global uint*)to, LANES_AS_UINT(value), places);
}

static inline void put_rays(const RayQueue* q, const NewRays* r, const Places* places) {
    const size_t n = q->stride;
    put_float(q->rays + VXL_RAY_OX * n, r->origin.x, places);
    put_float(q->rays + VXL_RAY_OY * n, r->origin.y, places);
    put_float(q->rays + VXL_RAY_OZ * n, r->origin.z, places);
    put_float(q->rays + VXL_RAY_DX * n, r->direction.x, places);
    put_float(q->rays + VXL_RAY_DY * n, r->direction.y, places);
    put_float(q->rays + VXL_RAY_DZ * n, r->direction.z, places);
    put_float(q->rays + VXL_RAY_END * n, r->t_end, places);
    put_uint(q->paths + VXL_PATH_SOURCE * n, r->source, places);
    put_uint(q->paths + VXL_PATH_FLAGS * n, r->flags, places);
    put_uint(q->paths + VXL_PATH_WEIGHT * n, LANES_AS_UINT(r->weight), places);
    if (VXL_INSTANCES) put_uint(q->paths + VXL_PATH_INSTANCE * n, r->instance, places);
    if (!VXL_TRANSMISSION) return;
    put_uint(q->paths + VXL_PATH_CELL * n, r->cell_xy, places);
    put_uint(q->paths + VXL_PATH_CELL_Z * n, r->cell_z, places);
    put_uint(q->paths + VXL_PATH_TARGET * n, r->target, places);
    put_uint(q->paths + VXL_PATH_CLEAR * n, LANES_AS_UINT(r->clear), places);
    for (uint c = 0; c < 3; ++c)
        put_uint(q->paths + (VXL_PATH_PASSED + c) * n, LANES_AS_UINT(r->passed[c]), places);
    for (uint i = 0; i < VXL_INTERIOR_MEMBERS; ++i)
        put_uint(q->paths + (VXL_PATH_INSIDE + i) * n, r->interior.members[i], places);
    put_float(q->starts, r->start, places);
    put_uint(q->inside, r->medium, places);
}

#endif
