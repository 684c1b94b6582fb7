// SPDX-License-Identifier: Apache-2.0
// Packets of rays on their way to the first surface: their beginning, steps and end.
//
// A packet has VXL_LANES rays. Lanes that reach an occupied voxel wait for others; then the
// surfaces inside those voxels are tested together, and lanes that missed them walk on.
#ifndef VXL_PACKET_H
#define VXL_PACKET_H

#include "lib/lanes/work_item.h"
#include "lib/surface/all_solids.h"
#include "lib/traverse/ray_batch.h"

// The number of idle lanes at which a packet takes further rays.
#define VXL_REFILL ((VXL_LANES + 3) / 4)

#define VXL_REFILLS VXL_REFILLS_LANES(VXL_PATHS, VXL_INSTANCES, VXL_SOLIDS_AHEAD)

// Loads values of the rays that a packet's lanes hold. These are neighbours in memory, unless the
// lanes were given their rays one by one.
#define VXL_RAY_FLOATS(p, ray, one_by_one) \
    ((one_by_one) ? LANES_GATHER_FLOAT(p, ray) : LANES_LOAD(p, LANES_FIRST(ray)))
#define VXL_RAY_UINTS(p, ray, one_by_one) \
    ((one_by_one) ? LANES_GATHER_UINT(p, ray) : LANES_LOAD(p, LANES_FIRST(ray)))

/// Moves the `walking` lanes one step: out of the empty block around them or, where their cell is
/// occupied, to the `waiting` lanes. Lanes that leave the world or reach t_end are in neither mask.
static inline void walk_on(const PyramidView* p, Walk* w, lane_float t_end, SurfaceHit* found,
                           lane_int* walking, lane_int* waiting) {
    lane_int moving = *walking;
    const CellState state = look_up(p, w->x, w->y, w->z, moving, &w->last);
    const lane_int arrived = state.occupied & moving;
    found->leaf = LANES_SELECT(arrived, state.leaf, found->leaf);
    *waiting |= arrived;
    moving &= ~arrived;
    if (VXL_SHARED_CUBES) {
        found->behind.passes &= ~moving;
        moving &= ~take_cube_behind(found, w, moving);
    }
    if (VXL_CUBE_BODIES) {
        const lane_int left = moving & found->in_body;
        leave_body(found, w, left);
        found->hit |= left;
        moving &= ~left;
    }
    advance(p, w, state.log2_size, moving);
    moving &= in_grid(p, w) & LANE_MASK(w->t <= t_end);
    if (VXL_EXACT) {  // an earlier voxel's primitive is hit before anything ahead
        const lane_int passed = moving & LANE_MASK(w->t >= found->t);
        found->hit |= passed;
        moving &= ~passed;
    }
    *walking = moving;
}

/// Tests the surfaces in the voxels of the `waiting` lanes; those that miss them walk on.
static INLINED void meet_surfaces(const PyramidView* p, const SurfaceView* s, Walk* w,
                                  lane_float t_end, const RayState* ray_state, SurfaceHit* found,
                                  lane_int* walking, lane_int* waiting) {
    const lane_int accepted = test_surfaces(p, s, w, *waiting, ray_state, found) & *waiting;
    found->hit |= accepted;
    lane_int moving = *waiting & ~accepted;
    *waiting = (lane_int)0;
    if (!lanes_any(moving)) return;
    advance(p, w, (lane_int)0, moving);
    if (VXL_SHARED_CUBES) {
        const lane_int ending = moving & ~(in_grid(p, w) & LANE_MASK(w->t <= t_end));
        moving &= ~take_cube_behind(found, w, ending);
    }
    if (VXL_CUBE_BODIES) {
        const lane_int left = moving & found->in_body & ~in_grid(p, w);
        leave_body(found, w, left);
        found->hit |= left;
    }
    *walking |= moving & in_grid(p, w) & LANE_MASK(w->t <= t_end);
}

/// Mask: lanes whose walks have ended with a hit.
static inline lane_int is_hit(const SurfaceHit* found, lane_float t_end) {
    lane_int hit = found->hit;
    if (VXL_EXACT) hit |= LANE_MASK(found->t < INFINITY);
    return hit & LANE_MASK(found->t <= t_end);
}

/// Walks the `active` lanes to their first surface before t_end.
static inline SurfaceHit find_first(const PyramidView* p, const SurfaceView* s, Walk* w,
                                    lane_float t_end, lane_int active, const RayState* ray_state) {
    SurfaceHit found = no_hit_yet();
    lane_int walking = active & in_grid(p, w), waiting = (lane_int)0;
    if (VXL_SOLIDS_AHEAD) {
        found = find_solid(p, s, w, t_end, active, ray_state);
        walking &= found.hit;
        found.hit = (lane_int)0;
        approach(p, w, found.t, walking);
    }
    while (lanes_any(walking)) {
        while (lanes_any(walking)) walk_on(p, w, t_end, &found, &walking, &waiting);
        meet_surfaces(p, s, w, t_end, ray_state, &found, &walking, &waiting);
    }
    found.hit = is_hit(&found, t_end) & active;
    return found;
}

/// The walks of the lanes' rays; `one_by_one` is true if they were given their rays one by one.
static inline Walk walk_of(global const float* restrict rays, uint stride, lane_uint ray,
                           bool one_by_one) {
    return begin_walk(VXL_RAY_FLOATS(rays + VXL_RAY_OX * stride, ray, one_by_one),
                      VXL_RAY_FLOATS(rays + VXL_RAY_OY * stride, ray, one_by_one),
                      VXL_RAY_FLOATS(rays + VXL_RAY_OZ * stride, ray, one_by_one),
                      VXL_RAY_FLOATS(rays + VXL_RAY_DX * stride, ray, one_by_one),
                      VXL_RAY_FLOATS(rays + VXL_RAY_DY * stride, ray, one_by_one),
                      VXL_RAY_FLOATS(rays + VXL_RAY_DZ * stride, ray, one_by_one));
}

/// The state of rays from the observer.
static inline RayState sight_ray_state(void) {
    RayState r;
    r.on_surface = r.goes_on = r.refracted = r.within_source = r.asks_side = (lane_int)0;
    r.on_cube = r.joined = r.unsure = r.guesses = (lane_int)0;
    r.source = (lane_uint)VXL_NO_PRIMITIVE;
    r.field_of = r.triangle_of = (lane_uint)VXL_NO_OBJECT;
    r.t_first = (lane_float)0.0f;
    r.media = empty_medium_set();
    r.body = (lane_uint)VXL_NO_MEDIUM;
    r.instance = (lane_uint)VXL_NO_INSTANCE;
    return r;
}

static inline lane_int has_flag(lane_uint flags, uint flag) {
    return LANE_MASK((flags & flag) != 0u);
}

/// The state of the paths numbered `ray`, among the batch's first `count`, with these flags.
static inline RayState load_ray_state(const RayBatch* batch, uint count, lane_uint ray,
                                      lane_uint flags) {
    global const uint* paths = batch->paths;
    const uint stride = batch->stride;
    RayState ray_state = sight_ray_state();
    ray_state.on_surface = has_flag(flags, VXL_PATH_ON_SURFACE);
    ray_state.within_source = has_flag(flags, VXL_PATH_WITHIN_SOURCE);
    if (VXL_SOURCES) ray_state.source = LANES_GATHER_UINT(paths + VXL_PATH_SOURCE * stride, ray);
    if (VXL_INSTANCES)
        ray_state.instance = LANES_GATHER_UINT(paths + VXL_PATH_INSTANCE * stride, ray);
    if (VXL_TRANSMISSION) {
        if (VXL_SHARED_CUBES || VXL_EXACT)
            ray_state.refracted = has_flag(flags, VXL_PATH_REFRACTED);
        ray_state.goes_on = has_flag(flags, VXL_PATH_GOES_ON);
        if (lanes_any(ray_state.goes_on))
            ray_state.t_first = LANES_GATHER_FLOAT(batch->starts, ray);
        ray_state.media = gather_medium_set(paths, stride, ray, LANE_MASK(ray < count));
    }
    if (VXL_CUBE_BODIES) {
        ray_state.body = body_inside(&ray_state.media);
        ray_state.joined = has_flag(flags, VXL_PATH_JOINED);
    }
    return ray_state;
}

/// The t at which the ray entered the walk's present cell; less than 0 where the ray began in it.
static inline lane_float entry_time(const Walk* w) {
    const lane_float none = (lane_float)-INFINITY;
    const lane_float tx = (LANES_FLOAT(w->x + w->px + 1) - w->ox) * w->ix;
    const lane_float ty = (LANES_FLOAT(w->y + w->py + 1) - w->oy) * w->iy;
    const lane_float tz = (LANES_FLOAT(w->z + w->pz + 1) - w->oz) * w->iz;
    return fmax(LANES_SELECT(w->mx, tx, none),
                fmax(LANES_SELECT(w->my, ty, none), LANES_SELECT(w->mz, tz, none)));
}

/// Moves the walks of the lanes `on` to the cell where their rays begin or continue.
static inline void resume_walk(Walk* w, const RayState* ray_state, lane_uint cell_xy,
                               lane_uint cell_z, lane_int on) {
    w->x = LANES_SELECT(on, LANES_AS_INT(cell_xy & 0xFFFFu), w->x);
    w->y = LANES_SELECT(on, LANES_AS_INT(cell_xy >> 16), w->y);
    w->z = LANES_SELECT(on, LANES_AS_INT(cell_z & 0xFFFFu), w->z);
    w->axis = LANES_SELECT(on, (lane_int)3, w->axis);
    if (VXL_CUBE_BODIES) {  // a ray that leaves a body enters the next cell now
        const lane_int out = on & is_exit(cell_z);
        const lane_uint axis = (cell_z >> VXL_FACE_AXIS_SHIFT) & VXL_FACE_AXIS_MASK;
        w->axis = LANES_SELECT(out, LANES_AS_INT(axis), w->axis);
        step_across(w, has_flag(cell_z, VXL_FACE_UP), out);
    }
    w->t = LANES_SELECT(on, fmax(ray_state->t_first, entry_time(w)), w->t);
}

/// A packet of rays on their way.
typedef struct {
    lane_uint ray;  // the number of each lane's ray
    Walk walk;
    RayState ray_state;
    SurfaceHit found;
    lane_float t_end;
} Packet;

/// Gives the `idle` lanes the next of the rays up to `end`. Returns the mask of lanes that got one.
static inline lane_int take_rays(lane_int idle, uint end, uint* next, lane_uint* ray) {
    const lane_uint number = *next + lanes_ranks(idle);
    const lane_int taken = idle & LANE_MASK(number < end);
    *ray = LANES_SELECT(taken, number, *ray);
    *next += (uint)lanes_count(taken);
    return taken;
}

/// Starts the rays that the lanes hold, which are among the batch's first `count`.
static inline void set_out(const WorldView* world, const RayBatch* batch, uint count, Packet* f) {
    global const uint* paths = batch->paths;
    const uint stride = batch->stride;
    f->walk = walk_of(batch->rays, stride, f->ray, VXL_REFILLS);
    f->ray_state = sight_ray_state();
    lane_uint flags = (lane_uint)0;
    if (VXL_PATHS) {
        flags = LANES_GATHER_UINT(paths + VXL_PATH_FLAGS * stride, f->ray);
        f->ray_state = load_ray_state(batch, count, f->ray, flags);
    }
    enter_world(&world->pyramid, &f->walk, ~f->ray_state.on_surface);
    f->ray_state.unsure = ~f->ray_state.on_surface & LANE_MASK(f->walk.axis == 3);
    const lane_int resuming = has_flag(flags, VXL_PATH_GOES_ON | VXL_PATH_FROM_CELL);
    if (VXL_TRANSMISSION && lanes_any(resuming))
        resume_walk(&f->walk, &f->ray_state,
                    LANES_GATHER_UINT(paths + VXL_PATH_CELL * stride, f->ray),
                    LANES_GATHER_UINT(paths + VXL_PATH_CELL_Z * stride, f->ray), resuming);
    f->t_end = VXL_RAY_FLOATS(batch->rays + VXL_RAY_END * stride, f->ray, VXL_REFILLS);
    const lane_int sent = LANE_MASK(f->ray < count) & LANE_MASK(f->t_end >= 0.0f);
    if (VXL_MIXED) find_mixed_mesh(world, sent, &f->ray_state);
    f->found = no_hit_yet();
}

#define VXL_PACKETS_INTERLEAVED \
    VXL_INTERLEAVED_PACKETS(VXL_LANES, VXL_SMOOTH, VXL_EXACT, VXL_INSTANCES)

/// Walks the active lanes of two packets to their first surfaces; see VXL_INTERLEAVED_PACKETS.
static inline void find_interleaved(const PyramidView* p, const SurfaceView* s, Packet* a,
                                    lane_int active_a, Packet* b, lane_int active_b) {
    lane_int walking_a = active_a & in_grid(p, &a->walk), waiting_a = (lane_int)0;
    lane_int walking_b = active_b & in_grid(p, &b->walk), waiting_b = (lane_int)0;
    while (lanes_any(walking_a | walking_b)) {
        while (lanes_any(walking_a | walking_b)) {
            walk_on(p, &a->walk, a->t_end, &a->found, &walking_a, &waiting_a);
            walk_on(p, &b->walk, b->t_end, &b->found, &walking_b, &waiting_b);
        }
        meet_surfaces(p, s, &a->walk, a->t_end, &a->ray_state, &a->found, &walking_a, &waiting_a);
        meet_surfaces(p, s, &b->walk, b->t_end, &b->ray_state, &b->found, &walking_b, &waiting_b);
    }
    a->found.hit = is_hit(&a->found, a->t_end) & active_a;
    b->found.hit = is_hit(&b->found, b->t_end) & active_b;
}

/// How far a packet's rays have come.
typedef struct {
    lane_int x, y, z, axis;
    lane_float t;
    LastSector last;
    SurfaceHit found;
} Progress;

static inline Progress progress_of(const Packet* f) {
    const Walk* w = &f->walk;
    const Progress progress = {w->x, w->y, w->z, w->axis, w->t, w->last, f->found};
    return progress;
}

/// Replaces what the `taken` lanes have found by `other`.
static inline void take_hit(const SurfaceHit* other, lane_int taken, SurfaceHit* found) {
    found->hit = LANES_SELECT(taken, other->hit, found->hit);
    found->t = LANES_SELECT(taken, other->t, found->t);
    found->leaf = LANES_SELECT(taken, other->leaf, found->leaf);
    found->voxel = LANES_SELECT(taken, other->voxel, found->voxel);
    if (VXL_SMOOTH) {
        found->within = LANES_SELECT(taken, other->within, found->within);
        found->inside = LANES_SELECT(taken, other->inside, found->inside);
        found->level = LANES_SELECT(taken, other->level, found->level);
    }
    if (VXL_EXACT) {
        found->primitive = LANES_SELECT(taken, other->primitive, found->primitive);
        found->solid = LANES_SELECT(taken, other->solid, found->solid);
    }
    if (VXL_CUBE_BODIES) {
        found->in_body = LANES_SELECT(taken, other->in_body, found->in_body);
        found->exit = LANES_SELECT(taken, other->exit, found->exit);
    }
    if (VXL_SHARED_CUBES) replace_cubes(&found->behind, &other->behind, taken);
}

/// Restores the walks of lanes that are not `fresh`.
static inline void keep_progress(const Progress* before, lane_int fresh, Packet* f) {
    f->walk.x = LANES_SELECT(fresh, f->walk.x, before->x);
    f->walk.y = LANES_SELECT(fresh, f->walk.y, before->y);
    f->walk.z = LANES_SELECT(fresh, f->walk.z, before->z);
    f->walk.t = LANES_SELECT(fresh, f->walk.t, before->t);
    f->walk.axis = LANES_SELECT(fresh, f->walk.axis, before->axis);
    f->walk.last = before->last;  // this is right for fresh rays, too
    take_hit(&before->found, ~fresh, &f->found);
}

#endif
