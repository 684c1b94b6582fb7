// SPDX-License-Identifier: Apache-2.0
// The nearest surface that a packet's rays meet, in the world or in instances.
//
// The packet traverses a tree over the instances' boxes, the nearer child first, up to the best
// hit. At an instance, the rays that meet its own box are transformed into its space and walk there
// by the same code as in the world. A hit replaces another if its t is smaller, or if both t are
// equal and its instance's number is smaller (the world counts as the smallest). So the result
// depends neither on the order of visits nor on which rays share a packet.
#ifndef VXL_INSTANCES_H
#define VXL_INSTANCES_H

#include "lib/packets/packet.h"
#include "lib/traverse/bounds_slack.h"
#include "lib/traverse/transformed_ray.h"

/// A ray in the form that slab tests use.
typedef struct {
    lane_float ix, iy, iz;  // 1 / d
    lane_float sx, sy, sz;  // -o / d
} SlabRay;

static inline SlabRay slab_ray(const Walk* w) {
    SlabRay r;
    r.ix = clamp(w->ix, -1e30f, 1e30f), r.iy = clamp(w->iy, -1e30f, 1e30f);
    r.iz = clamp(w->iz, -1e30f, 1e30f);
    r.sx = -w->ox * r.ix, r.sy = -w->oy * r.iy, r.sz = -w->oz * r.iz;
    return r;
}

/// Mask: lanes that meet a child's box before t_last. Sets *t to where they enter it. The boxes are
/// large enough for all rounding (runtime/stages/instance/instance_tree.hpp).
static inline lane_int meets_child(const SlabRay* r, global const InstanceNode* node, int child,
                                   lane_float t_last, lane_float* t) {
    global const float* low = node->low[child];
    global const float* high = node->high[child];
    const lane_float ax = fma(low[0], r->ix, r->sx), bx = fma(high[0], r->ix, r->sx);
    const lane_float ay = fma(low[1], r->iy, r->sy), by = fma(high[1], r->iy, r->sy);
    const lane_float az = fma(low[2], r->iz, r->sz), bz = fma(high[2], r->iz, r->sz);
    const lane_float enter = fmax(fmin(ax, bx), fmax(fmin(ay, by), fmin(az, bz)));
    const lane_float leave = fmin(fmax(ax, bx), fmin(fmax(ay, by), fmax(az, bz)));
    *t = fmax(enter, 0.0f);
    return LANE_MASK(*t <= fmin(leave, t_last));
}

/// The coordinate, along one axis, of the cell that the ray is in just before t_first; `nearest` is
/// the plane closest to its position at t_first.
static inline lane_int cell_before(lane_int nearest, lane_float o, lane_float inverse,
                                   lane_int positive, lane_int moves, lane_float t_first,
                                   lane_int still) {
    const lane_int crossed = LANE_MASK((LANES_FLOAT(nearest) - o) * inverse < t_first);
    return LANES_SELECT(moves, cell_next_to(nearest, crossed, positive), still);
}

/// Moves walks whose origins lie outside an aligned instance's box to the first cell in the box,
/// and walks that continue at t_first to the cell that they are in just before, so that surfaces at
/// t_first itself are ahead of them.
static inline void enter_box(const PyramidView* p, global const InstanceRecord* r,
                             lane_float t_first, Walk* w) {
    Crossing c;
    c.kx = LANES_SELECT(w->px, (lane_int)(int)r->low[0], (lane_int)(int)r->high[0]);
    c.ky = LANES_SELECT(w->py, (lane_int)(int)r->low[1], (lane_int)(int)r->high[1]);
    c.kz = LANES_SELECT(w->pz, (lane_int)(int)r->low[2], (lane_int)(int)r->high[2]);
    const lane_float none = (lane_float)-INFINITY;
    c.tx = LANES_SELECT(w->mx, (LANES_FLOAT(c.kx) - w->ox) * w->ix, none);
    c.ty = LANES_SELECT(w->my, (LANES_FLOAT(c.ky) - w->oy) * w->iy, none);
    c.tz = LANES_SELECT(w->mz, (LANES_FLOAT(c.kz) - w->oz) * w->iz, none);
    const lane_float t = fmax(c.tx, fmax(c.ty, c.tz));
    const lane_int ez = LANE_MASK(c.tz == t);
    c.ey = LANE_MASK(c.ty == t) & ~ez;
    c.ex = ~(c.ey | ez);
    const lane_float at = fmax(t, t_first);
    const lane_float qx = fma(w->dx, at, w->ox), qy = fma(w->dy, at, w->oy),
                     qz = fma(w->dz, at, w->oz);
    c.rx = LANES_INT(floor(qx + 0.5f)), c.ry = LANES_INT(floor(qy + 0.5f));
    c.rz = LANES_INT(floor(qz + 0.5f));
    const lane_int goes_on = LANE_MASK(t_first > 0.0f) & LANE_MASK(t_first > t);
    const lane_int enters = LANE_MASK(t >= 0.0f) & ~goes_on;
    const AxisCrossing x = axis_crossing(c.kx, c.rx, w->ox, w->dx, w->px, p->fixed_point);
    const AxisCrossing y = axis_crossing(c.ky, c.ry, w->oy, w->dy, w->py, p->fixed_point);
    const AxisCrossing z = axis_crossing(c.kz, c.rz, w->oz, w->dz, w->pz, p->fixed_point);
    settle_cell(w, &x, &y, &z, &c);
    const lane_int x_on = cell_before(c.rx, w->ox, w->ix, w->px, w->mx, t_first, w->x);
    const lane_int y_on = cell_before(c.ry, w->oy, w->iy, w->py, w->my, t_first, w->y);
    const lane_int z_on = cell_before(c.rz, w->oz, w->iz, w->pz, w->mz, t_first, w->z);
    w->x = LANES_SELECT(enters, c.x, LANES_SELECT(goes_on, x_on, w->x));
    w->y = LANES_SELECT(enters, c.y, LANES_SELECT(goes_on, y_on, w->y));
    w->z = LANES_SELECT(enters, c.z, LANES_SELECT(goes_on, z_on, w->z));
    w->t = LANES_SELECT(enters | goes_on, at, w->t);
    w->axis = LANES_SELECT(enters, ~c.ex & (2 + c.ey), w->axis);
}

static inline PyramidView instance_pyramid(const PyramidView* world,
                                           global const InstanceRecord* r) {
    PyramidView p = *world;
    p.sectors += r->first_sector;
    p.size_x = r->size[0], p.size_y = r->size[1], p.size_z = r->size[2];
    p.sectors_x = r->sectors_x, p.sectors_y = r->sectors_y;
    p.plane_bound = r->plane_bound;
    p.fixed_point = r->fixed_point;
    return p;
}

// The object of instances' surfaces in their own packed attributes.
#define VXL_OWN_OBJECT (VXL_KIND_SMOOTH << VXL_KIND_SHIFT)

/// The state with which rays begin in the space of instance `number`, which shows `object`, or of
/// the world.
///
/// A ray that continues from a surface at t_first has yet to meet the surfaces at this same t in
/// the spaces that come after that surface's space: the world comes first, then the instances by
/// number. In an instance's space, it is inside the instance's object or inside nothing.
static inline RayState ray_state_in(const RayState* ray_state, lane_uint number, uint object,
                                    lane_int begins) {
    RayState t = *ray_state;
    const lane_int own = LANE_MASK(ray_state->instance == number);
    t.on_surface &= own;
    t.on_cube = t.on_surface & LANE_MASK(number == VXL_NO_INSTANCE);
    t.within_source &= own;
    t.source = LANES_SELECT(own, t.source, (lane_uint)VXL_NO_PRIMITIVE);
    t.unsure = begins & (~t.on_surface | t.guesses);
    if (VXL_MIXED) enter_mixed_mesh(&t, number, object);
    if (VXL_TRANSMISSION) {
        const lane_int ahead = ray_state->goes_on &
                               LANE_MASK(LANES_AS_INT(number) > LANES_AS_INT(ray_state->instance));
        t.t_first = LANES_SELECT(ahead, float_before(t.t_first), t.t_first);
        const lane_int of_world = LANE_MASK(number == VXL_NO_INSTANCE);
        const lane_int within = medium_set_holds(&t.media, (lane_uint)object) & ~of_world;
        for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i)
            t.media.members[i] =
                LANES_SELECT(of_world, t.media.members[i], (lane_uint)VXL_NO_MEDIUM);
        t.media.members[0] = LANES_SELECT(within, (lane_uint)VXL_OWN_OBJECT, t.media.members[0]);
        t.body = LANES_SELECT(of_world, t.body, (lane_uint)VXL_NO_MEDIUM);
        t.joined &= of_world;
    }
    return t;
}

/// The axis of an aligned instance's space that is parallel to an axis of the world; 3 for none.
static inline lane_int object_axis(global const InstanceRecord* r, lane_int world_axis) {
    lane_int axis = (lane_int)3;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            if (r->object_from_world[3 * row + column] != 0.0f)
                axis = LANES_SELECT(LANE_MASK(world_axis == column), (lane_int)row, axis);
    return axis;
}

/// Replaces what lanes have found by closer hits of their rays on instance `number`.
static inline lane_int meet_instance(const PyramidView* world, const SurfaceView* s,
                                     const InstanceView* v, uint number, const Walk* ray,
                                     lane_float inverse_squared, lane_float t_last, lane_int active,
                                     const BoundsSlack* slack, const RayState* ray_state,
                                     SurfaceHit* best, Walk* at) {
    global const InstanceRecord* r = v->records + number;
    if (v->shown && v->shown[r->object] == 0u) return (lane_int)0;
    const Vector o = {ray->ox, ray->oy, ray->oz}, d = {ray->dx, ray->dy, ray->dz};
    const lane_float t_first = first_of_faces(slack, ray_state->t_first, r->bounds_rounding);
    t_last = last_of_faces(slack, t_last, r->bounds_rounding);
    const BoxPassage way = pass_box(r, o, d, inverse_squared, t_first);
    active &= way.met & LANE_MASK(way.base + way.from <= t_last);
    if (!lanes_any(active)) return active;
    const TransformedRay c = transform_ray(r, &way);
    const PyramidView p = instance_pyramid(world, r);
    Walk w =
        begin_walk(c.origin.x, c.origin.y, c.origin.z, c.direction.x, c.direction.y, c.direction.z);
    w.axis = r->aligned ? (lane_int)3 : way.axis;
    if (r->aligned) enter_box(&p, r, t_first, &w);
    RayState outside = *ray_state;
    outside.t_first = r->aligned ? t_first : (lane_float)0.0f;
    RayState inside = ray_state_in(&outside, (lane_uint)number, r->object, LANE_MASK(w.axis == 3));
    if (VXL_SOLIDS) {
        const lane_int asked = active & inside.asks_side & LANE_MASK(w.axis == 3) &
                               LANE_MASK(ray_state->instance == number);
        if (lanes_any(asked)) {
            const SolidRay transformed = {w.ox, w.oy, w.oz, w.dx, w.dy, w.dz};
            inside.within_source =
                go_inside(s->solids, inside.source & ~VXL_SOLID_PRIMITIVE & LANES_AS_UINT(asked),
                          &transformed, asked);
        }
    }
    // The walk ends behind t_last by more than the rounding of its t, because hits are compared by
    // their t in the world.
    const lane_float t_end = transformed_t(&c, fma(t_last, 0x1p-20f, t_last));
    const SurfaceHit found = find_first(&p, s, &w, t_end, active, &inside);
    const lane_float t = fmax(world_t(&c, fmax(found.t, 0.0f)), 0.0f);
    const lane_int closer =
        found.hit & active & LANE_MASK(t <= t_last) &
        (~best->hit | LANE_MASK(t < best->t) |
         (LANE_MASK(t == best->t) & LANE_MASK((int)number < LANES_AS_INT(best->instance))));
    best->hit |= closer;
    best->t = LANES_SELECT(closer, t, best->t);
    best->voxel = LANES_SELECT(closer, found.voxel, best->voxel);
    best->primitive = LANES_SELECT(closer, found.primitive, best->primitive);
    best->within = LANES_SELECT(closer, found.within, best->within);
    best->exit &= ~closer;
    best->instance = LANES_SELECT(closer, (lane_uint)number, best->instance);
    at->x = LANES_SELECT(closer, w.x, at->x);
    at->y = LANES_SELECT(closer, w.y, at->y);
    at->z = LANES_SELECT(closer, w.z, at->z);
    const lane_int on_side = LANE_MASK(slack->in > 0.0f) & LANE_MASK(w.t == 0.0f);
    const lane_int side = r->aligned ? object_axis(r, ray->axis) : w.axis;
    at->axis = LANES_SELECT(closer, LANES_SELECT(on_side, side, w.axis), at->axis);
    return closer;
}

/// Replaces what lanes have found by closer hits on instances. Lanes that look for `any` hit are
/// done after the first.
static INLINED void meet_instances(const PyramidView* world, const SurfaceView* s,
                                   const InstanceView* v, const Walk* ray, lane_int active,
                                   bool any, const BoundsSlack* slack, const RayState* ray_state,
                                   SurfaceHit* best, Walk* at) {
    const SlabRay slab = slab_ray(ray);
    const Vector d = {ray->dx, ray->dy, ray->dz};
    const lane_float inverse_squared = exact_reciprocal(dot_product(d, d));
    uint nodes[VXL_INSTANCE_DEPTH];
    lane_int masks[VXL_INSTANCE_DEPTH];
    lane_float times[VXL_INSTANCE_DEPTH];
    int waiting = 0;
    uint node = 0;
    lane_float t_last = LANES_SELECT(best->hit, fmin(best->t, slack->t_out), slack->t_out);
    while (true) {
        if (node & VXL_INSTANCE_LEAF) {
            const lane_int met =
                meet_instance(world, s, v, node & ~VXL_INSTANCE_LEAF, ray, inverse_squared, t_last,
                              active, slack, ray_state, best, at);
            t_last = LANES_SELECT(met, best->t, t_last);
            active = (lane_int)0;
        } else {
            lane_float t_a, t_b;
            const lane_int a = meets_child(&slab, v->nodes + node, 0, t_last, &t_a) & active;
            const lane_int b = meets_child(&slab, v->nodes + node, 1, t_last, &t_b) & active;
            const int any_a = lanes_any(a), any_b = lanes_any(b);
            if (any_a && any_b) {
                const lane_int b_first = b & (~a | LANE_MASK(t_b < t_a));
                const int swap = 2 * lanes_count(b_first) > lanes_count(a | b);
                nodes[waiting] = v->nodes[node].child[swap ? 0 : 1];
                masks[waiting] = swap ? a : b;
                times[waiting] = swap ? t_a : t_b;
                ++waiting;
                node = v->nodes[node].child[swap ? 1 : 0];
                active = swap ? b : a;
                continue;
            }
            active = any_a ? a : b;
            node = v->nodes[node].child[any_a ? 0 : 1];
        }
        while (!lanes_any(active)) {
            if (waiting == 0) return;
            --waiting;
            node = nodes[waiting];
            active = masks[waiting] & LANE_MASK(times[waiting] <= t_last);
            if (any) active &= ~best->hit;
        }
    }
}

/// Restarts the walks of the `restarted` rays, which continue from an instance's surface at t.
static inline void restart_walks(const PyramidView* p, Walk* w, lane_float t, lane_int restarted) {
    const lane_float zero = (lane_float)0.0f, at = LANES_SELECT(restarted, t, zero);
    const float one = p->fixed_point;
    const Walk from =
        begin_walk(snap_position(clamp(fma(w->dx, at, w->ox), 0.0f, (float)p->size_x), zero, one),
                   snap_position(clamp(fma(w->dy, at, w->oy), 0.0f, (float)p->size_y), zero, one),
                   snap_position(clamp(fma(w->dz, at, w->oz), 0.0f, (float)p->size_z), zero, one),
                   w->dx, w->dy, w->dz);
    w->ox = LANES_SELECT(restarted, from.ox, w->ox);
    w->oy = LANES_SELECT(restarted, from.oy, w->oy);
    w->oz = LANES_SELECT(restarted, from.oz, w->oz);
    w->x = LANES_SELECT(restarted, from.x, w->x);
    w->y = LANES_SELECT(restarted, from.y, w->y);
    w->z = LANES_SELECT(restarted, from.z, w->z);
    w->t = LANES_SELECT(restarted, from.t, w->t);
    w->axis = LANES_SELECT(restarted, from.axis, w->axis);
}

/// Walks the `active` lanes to their first surface before t_end, in the world or in an instance. It
/// ends in the surface's cell, which for an instance's surface is in the instance's voxels.
static INLINED SurfaceHit find_nearest(const WorldView* world, Walk* w, lane_float t_end,
                                       lane_int active, bool any, const RayState* ray_state) {
    const PyramidView* p = &world->pyramid;
    const SurfaceView* s = &world->surface;
    if (!VXL_INSTANCES) return find_first(p, s, w, t_end, active, ray_state);
    const RayState in_world =
        ray_state_in(ray_state, (lane_uint)VXL_NO_INSTANCE, 0u, LANE_MASK(w->axis == 3));
    const Walk ray = *w;
    SurfaceHit found = find_first(p, s, w, t_end, active, &in_world);
    found.instance = (lane_uint)VXL_NO_INSTANCE;
    // There is nothing beyond the world's bounds.
    lane_float t_in = (lane_float)0.0f, t_out = t_end;
    const Vector o = {ray.ox, ray.oy, ray.oz}, d = {ray.dx, ray.dy, ray.dz};
    clip_to_world(o, d, p->size_x, p->size_y, p->size_z, &t_in, &t_out);
    if (any) active &= ~found.hit;
    if (!lanes_any(active)) return found;
    const BoundsSlack slack =
        bounds_slack(p, &ray, ~(ray_state->on_surface | ray_state->goes_on), t_out, t_end);
    meet_instances(p, s, &world->instances, &ray, active, any, &slack, ray_state, &found, w);
    return found;
}

#endif
