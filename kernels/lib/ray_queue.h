// Rays that are born on surfaces, and the left-packed queues that they wait in.
#ifndef VXL_RAY_QUEUE_H
#define VXL_RAY_QUEUE_H

#include "lib/interior.h"
#include "lib/vector.h"
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

/// Reserves a place behind `count` for every lane of a mask, all at once. Where the places are does
/// not matter to any result.
static inline void reserve_places(lane_int wanted, global uint* count, uint* places) {
    int lanes[VXL_LANES];
    LANES_STORE(wanted, lanes, 0);
    uint sum = 0;
    for (int lane = 0; lane < VXL_LANES; ++lane) sum += (uint)(lanes[lane] & 1);
    uint place = sum == 0 ? 0 : atomic_add(count, sum);
    for (int lane = 0; lane < VXL_LANES; ++lane) {
        places[lane] = place;
        place += (uint)(lanes[lane] & 1);
    }
}

static inline void put_float(global float* to, lane_float value, const int* wanted,
                             const uint* places) {
    float values[VXL_LANES];
    LANES_STORE(value, values, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane)
        if (wanted[lane]) to[places[lane]] = values[lane];
}

static inline void put_uint(global uint* to, lane_uint value, const int* wanted,
                            const uint* places) {
    uint values[VXL_LANES];
    LANES_STORE(value, values, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane)
        if (wanted[lane]) to[places[lane]] = values[lane];
}

static inline void put_rays(const RayQueue* q, const NewRays* r, lane_int wanted,
                            const uint* places) {
    int put[VXL_LANES];
    LANES_STORE(wanted, put, 0);
    const size_t n = q->stride;
    put_float(q->rays + VXL_RAY_OX * n, r->origin.x, put, places);
    put_float(q->rays + VXL_RAY_OY * n, r->origin.y, put, places);
    put_float(q->rays + VXL_RAY_OZ * n, r->origin.z, put, places);
    put_float(q->rays + VXL_RAY_DX * n, r->direction.x, put, places);
    put_float(q->rays + VXL_RAY_DY * n, r->direction.y, put, places);
    put_float(q->rays + VXL_RAY_DZ * n, r->direction.z, put, places);
    put_float(q->rays + VXL_RAY_END * n, r->t_end, put, places);
    put_uint(q->paths + VXL_PATH_SOURCE * n, r->source, put, places);
    put_uint(q->paths + VXL_PATH_FLAGS * n, r->flags, put, places);
    put_uint(q->paths + VXL_PATH_WEIGHT * n, LANES_AS_UINT(r->weight), put, places);
    if (VXL_INSTANCES) put_uint(q->paths + VXL_PATH_INSTANCE * n, r->instance, put, places);
    if (!VXL_TRANSMISSION) return;
    put_uint(q->paths + VXL_PATH_CELL * n, r->cell_xy, put, places);
    put_uint(q->paths + VXL_PATH_CELL_Z * n, r->cell_z, put, places);
    put_uint(q->paths + VXL_PATH_TARGET * n, r->target, put, places);
    put_uint(q->paths + VXL_PATH_CLEAR * n, LANES_AS_UINT(r->clear), put, places);
    for (uint c = 0; c < 3; ++c)
        put_uint(q->paths + (VXL_PATH_PASSED + c) * n, LANES_AS_UINT(r->passed[c]), put, places);
    for (uint i = 0; i < VXL_INTERIOR_MEMBERS; ++i)
        put_uint(q->paths + (VXL_PATH_INSIDE + i) * n, r->interior.members[i], put, places);
    put_float(q->starts, r->start, put, places);
    put_uint(q->inside, r->medium, put, places);
}

#endif
