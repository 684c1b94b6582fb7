// Packets of rays that run beside each other, and where their hits are stored.
#ifndef VXL_SIGHT_RAYS_H
#define VXL_SIGHT_RAYS_H

#include "lib/traverse/packet.h"

/// What a ray met, as shared/trace.h describes it.
typedef struct {
    lane_uint values[VXL_HIT_COMPONENTS];
} Hit;

static inline Hit hit_of(const Packet* f, lane_int hit) {
    Hit h;
    Walk walk = f->walk;
    lane_uint face = hit_face(&walk, f->found.exit & hit);
    if (VXL_SMOOTH)
        face |= LANES_AS_UINT(within_smooth(&f->found, &f->ray_state)) & VXL_FACE_WITHIN;
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
static inline void store_misses(uint stride, uint first, global uint* restrict hits) {
    Hit miss;
    miss.values[VXL_HIT_T] = LANES_AS_UINT((lane_float)INFINITY);
    miss.values[VXL_HIT_VOXEL] = (lane_uint)VXL_NO_VOXEL;
    miss.values[VXL_HIT_CELL] = miss.values[VXL_HIT_FACE] = (lane_uint)0;
    miss.values[VXL_HIT_PRIMITIVE] = (lane_uint)VXL_NO_PRIMITIVE;
    miss.values[VXL_HIT_INSTANCE] = (lane_uint)VXL_NO_INSTANCE;
    for (uint i = 0; i < VXL_STORED_COMPONENTS; ++i)
        LANES_STORE(miss.values[i], hits, i * stride + first);
}

/// Rays that run beside each other; `beams` may be none.
typedef struct {
    global const float* restrict rays;
    global const uint* restrict paths;
    global const float* restrict starts;
    global const uint* restrict beams;
    uint count, stride;
} SightRays;

/// Sets the packet of rays from `first` on on their way. False where there is none, or its beam is
/// clear, which is stored.
static inline bool send_packet(const PyramidView* p, const SightRays* q, uint first, Packet* f,
                               global uint* restrict hits) {
    if (first >= q->count) return false;
    if (q->beams && beam_is_clear(q->beams, q->stride, first)) {
        store_misses(q->stride, first, hits);
        return false;
    }
    f->ray = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    set_out(p, q->rays, q->count, q->stride, q->paths, q->starts, f);
    if (q->beams) ride_beam(q->beams, q->stride, first, &f->walk);
    return true;
}

static inline lane_int are_rays(const SightRays* q, const Packet* f) {
    return LANE_MASK(f->t_end >= 0.0f) & LANE_MASK(f->ray < q->count);
}

static inline void store_packet(const SightRays* q, const Packet* f, global uint* restrict hits) {
    const Hit hit = hit_of(f, f->found.hit);
    for (uint i = 0; i < VXL_STORED_COMPONENTS; ++i)
        LANES_STORE(hit.values[i], hits, i * q->stride + LANES_FIRST(f->ray));
}

#endif
