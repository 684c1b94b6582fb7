// SPDX-License-Identifier: Apache-2.0
// Packets of coherent rays, and where their hits are stored.
#ifndef VXL_SIGHT_RAYS_H
#define VXL_SIGHT_RAYS_H

#include "lib/packets/packet.h"

/// What a ray met, as shared/trace.h describes it.
typedef struct {
    lane_uint values[VXL_HIT_COMPONENTS];
} Hit;

static inline Hit hit_of(const Packet* f, lane_int hit) {
    Hit h;
    Walk walk = f->walk;
    lane_uint face = hit_face(&walk, f->found.exit & hit);
    if (VXL_SMOOTH) face |= LANES_AS_UINT(f->found.within) & VXL_FACE_WITHIN;
    h.values[VXL_HIT_T] = LANES_AS_UINT(f->found.t);
    h.values[VXL_HIT_VOXEL] = LANES_SELECT(hit, f->found.voxel, (lane_uint)VXL_NO_VOXEL);
    h.values[VXL_HIT_CELL] = LANES_AS_UINT(walk.x | (walk.y << 16));
    h.values[VXL_HIT_FACE] = face;
    h.values[VXL_HIT_PRIMITIVE] = f->found.primitive;
    h.values[VXL_HIT_INSTANCE] = f->found.instance;
    return h;
}

#define VXL_STORED_COMPONENTS \
    (VXL_INSTANCES ? VXL_HIT_COMPONENTS : (VXL_EXACT ? VXL_HIT_INSTANCE : VXL_HIT_PRIMITIVE))

/// Stores that a packet has met nothing.
static inline void store_misses(const RayBatch* batch, uint first) {
    Hit miss;
    miss.values[VXL_HIT_T] = LANES_AS_UINT((lane_float)INFINITY);
    miss.values[VXL_HIT_VOXEL] = (lane_uint)VXL_NO_VOXEL;
    miss.values[VXL_HIT_CELL] = miss.values[VXL_HIT_FACE] = (lane_uint)0;
    miss.values[VXL_HIT_PRIMITIVE] = (lane_uint)VXL_NO_PRIMITIVE;
    miss.values[VXL_HIT_INSTANCE] = (lane_uint)VXL_NO_INSTANCE;
    for (uint i = 0; i < VXL_STORED_COMPONENTS; ++i)
        LANES_STORE(miss.values[i], batch->hits, i * batch->stride + first);
}

static inline bool beam_is_clear(const RayBatch* batch, uint first) {
    const uint beam = first / VXL_BEAM_RAYS;
    return batch->beams[VXL_BEAM_AXIS * VXL_BEAM_SLOTS(batch->stride) + beam] == VXL_BEAM_CLEAR;
}

/// Moves walks to where the beam of their rays ended, since all space before that is empty.
/// Rounding may make the cell wrong; the next one is the walk's own again.
static inline void ride_beam(const RayBatch* batch, uint first, Walk* w) {
    global const uint* beams = batch->beams;
    const uint beam = first / VXL_BEAM_RAYS, slots = VXL_BEAM_SLOTS(batch->stride);
    const uint towards = beams[VXL_BEAM_AXIS * slots + beam];
    if (towards == VXL_BEAM_NONE) return;
    const float s = as_float(beams[VXL_BEAM_START * slots + beam]);
    const float plane = (towards & VXL_BEAM_DOWN) != 0u ? -s : s;
    const uint axis = towards & 3u;
    const lane_float o = axis == 0u ? w->ox : axis == 1u ? w->oy : w->oz;
    const lane_float i = axis == 0u ? w->ix : axis == 1u ? w->iy : w->iz;
    const lane_float t = (plane - o) * i;
    const lane_int later = LANE_MASK(t > w->t) & LANE_MASK(t < INFINITY);
    const lane_float at = LANES_SELECT(later, t, (lane_float)0.0f);
    const lane_float x = fma(w->dx, at, w->ox), y = fma(w->dy, at, w->oy),
                     z = fma(w->dz, at, w->oz);
    w->x = LANES_SELECT(later, LANES_INT(x) + LANE_MASK(x < 0.0f), w->x);
    w->y = LANES_SELECT(later, LANES_INT(y) + LANE_MASK(y < 0.0f), w->y);
    w->z = LANES_SELECT(later, LANES_INT(z) + LANE_MASK(z < 0.0f), w->z);
    w->t = LANES_SELECT(later, t, w->t);
}

/// The first `count` rays of a batch; the batch may have no beams.
typedef struct {
    RayBatch batch;
    uint count;
} SightRays;

/// Begins the packet of rays from `first` on. Returns false if there is none, or if its beam is
/// clear; in the latter case its misses are stored.
static inline bool send_packet(const WorldView* world, const SightRays* q, uint first, Packet* f) {
    if (first >= q->count) return false;
    if (q->batch.beams && beam_is_clear(&q->batch, first)) {
        store_misses(&q->batch, first);
        return false;
    }
    f->ray = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    set_out(world, &q->batch, q->count, f);
    if (q->batch.beams) ride_beam(&q->batch, first, &f->walk);
    return true;
}

static inline lane_int are_rays(const SightRays* q, const Packet* f) {
    return LANE_MASK(f->t_end >= 0.0f) & LANE_MASK(f->ray < q->count);
}

static inline void store_packet(const SightRays* q, const Packet* f) {
    const Hit hit = hit_of(f, f->found.hit);
    for (uint i = 0; i < VXL_STORED_COMPONENTS; ++i)
        LANES_STORE(hit.values[i], q->batch.hits, i * q->batch.stride + LANES_FIRST(f->ray));
}

#endif
