// SPDX-License-Identifier: Apache-2.0
// A discrete walk along a ray from cell to cell: floats propose, integers arbitrate.
//
// The cells visited are exactly those of the snapped ray, in order. The sequence is 6-connected, a
// point on a plane belongs to the cell being entered, and crossings at one t are taken lowest axis
// first. Crossing times are computed from the integer cell each time, never accumulated. A time (K
// - o) / d is right within 2 units, so a computed position is right within plane_bound voxels; only
// when it lies closer than that to a plane that it may or may not have crossed does an exact 64-bit
// comparison decide.
#ifndef VXL_WALK_H
#define VXL_WALK_H

#include "lib/lanes/exact_float.h"
#include "lib/traverse/pyramid.h"
#include "shared/trace.h"

// With 0, floats decide every crossing, to measure the cost of exactness.
#ifndef VXL_ARBITRATE
#define VXL_ARBITRATE 1
#endif

typedef struct {
    lane_float ox, oy, oz, dx, dy, dz;  // the ray, shared/trace.h
    lane_float ix, iy, iz;              // 1 / d, +infinity for 0
    lane_int px, py, pz;                // mask: d >= 0
    lane_int mx, my, mz;                // mask: d != 0
    lane_int x, y, z;                   // the cell
    lane_float t;                       // the t at which the walk entered the cell
    lane_int axis;                      // across a plane of this axis; 3: the walk began here
    LastSector last;
} Walk;

/// The coordinate of the cell that a ray enters at its origin.
static inline lane_int first_cell(lane_float o, lane_float d) {
    const lane_int cell = LANES_INT(o);
    return cell + (LANE_MASK(LANES_FLOAT(cell) == o) & LANE_MASK(d < 0.0f));
}

static inline Walk begin_walk(lane_float ox, lane_float oy, lane_float oz, lane_float dx,
                              lane_float dy, lane_float dz) {
    Walk w;
    w.ox = ox, w.oy = oy, w.oz = oz;
    w.dx = dx + 0.0f, w.dy = dy + 0.0f, w.dz = dz + 0.0f;  // -0 becomes +0
    w.ix = exact_reciprocal(w.dx), w.iy = exact_reciprocal(w.dy), w.iz = exact_reciprocal(w.dz);
    w.px = LANE_MASK(w.dx >= 0.0f), w.py = LANE_MASK(w.dy >= 0.0f), w.pz = LANE_MASK(w.dz >= 0.0f);
    w.mx = LANE_MASK(w.dx != 0.0f), w.my = LANE_MASK(w.dy != 0.0f), w.mz = LANE_MASK(w.dz != 0.0f);
    w.x = first_cell(ox, dx), w.y = first_cell(oy, dy), w.z = first_cell(oz, dz);
    w.t = (lane_float)0.0f;
    w.axis = (lane_int)3;
    w.last = no_sector();
    return w;
}

/// The walks of a packet's rays from `first` on.
static inline Walk load_walk(global const float* restrict rays, uint stride, uint first) {
    return begin_walk(LANES_LOAD(rays, VXL_RAY_OX * stride + first),
                      LANES_LOAD(rays, VXL_RAY_OY * stride + first),
                      LANES_LOAD(rays, VXL_RAY_OZ * stride + first),
                      LANES_LOAD(rays, VXL_RAY_DX * stride + first),
                      LANES_LOAD(rays, VXL_RAY_DY * stride + first),
                      LANES_LOAD(rays, VXL_RAY_DZ * stride + first));
}

/// Mask: the walk is inside the grid.
static inline lane_int in_grid(const PyramidView* p, const Walk* w) {
    return LANE_MASK((w->x | w->y | w->z) >= 0) & LANE_MASK(w->x < p->size_x) &
           LANE_MASK(w->y < p->size_y) & LANE_MASK(w->z < p->size_z);
}

/// Mask: the ray's point at `t` is in the world, or outside it by no more than rounding.
static inline lane_int is_in_world(const PyramidView* p, const Walk* w, lane_float t) {
    const lane_float x = fma(w->dx, t, w->ox), y = fma(w->dy, t, w->oy), z = fma(w->dz, t, w->oz);
    const float bound = p->plane_bound;
    return LANE_MASK(fmin(x, fmin(y, z)) >= -bound) & LANE_MASK(x <= (float)p->size_x + bound) &
           LANE_MASK(y <= (float)p->size_y + bound) & LANE_MASK(z <= (float)p->size_z + bound);
}

/// Mask: the ray's point at `t` is in the walk's present cell, or outside it by no more than
/// rounding.
static inline lane_int is_in_cell(const PyramidView* p, const Walk* w, lane_float t) {
    const float bound = p->plane_bound + 0.5f;  // from the cell's middle
    const lane_float x = fma(w->dx, t, w->ox) - (LANES_FLOAT(w->x) + 0.5f),
                     y = fma(w->dy, t, w->oy) - (LANES_FLOAT(w->y) + 0.5f),
                     z = fma(w->dz, t, w->oz) - (LANES_FLOAT(w->z) + 0.5f);
    return LANE_MASK(fmax(fabs(x), fmax(fabs(y), fabs(z))) <= bound);
}

/// The distance from the origin to a plane along one axis, in fixed point, positive ahead.
static inline lane_long plane_distance(lane_int plane, lane_float o, lane_int positive,
                                       float fixed_point) {
    const lane_long distance = LANES_LONG((LANES_FLOAT(plane) - o) * fixed_point);
    const lane_long sign = LANES_LONG(positive) * -2 - 1;
    return distance * sign;
}

/// One axis of an exact crossing: the distances A of its exit plane and B of the plane nearest to
/// the computed position, and the fixed-point direction D. t(A) = A / D.
typedef struct {
    lane_long exit, nearest, direction;
} AxisCrossing;

static inline AxisCrossing axis_crossing(lane_int exit_plane, lane_int nearest_plane, lane_float o,
                                         lane_float d, lane_int positive, float fixed_point) {
    AxisCrossing a;
    a.exit = plane_distance(exit_plane, o, positive, fixed_point);
    a.nearest = plane_distance(nearest_plane, o, positive, fixed_point);
    a.direction = LANES_LONG(fabs(d) * (float)(1 << VXL_DIRECTION_BITS));
    return a;
}

/// The cell coordinate behind `plane` if the axis has crossed it, or before it if not.
static inline lane_int cell_next_to(lane_int plane, lane_int crossed, lane_int positive) {
    return plane + (crossed ^ positive);
}

/// The walk's next cell beyond the block of 1 << log2_size cells around it, before it is
/// arbitrated.
typedef struct {
    lane_int kx, ky, kz;    // planes through which the block is left
    lane_int rx, ry, rz;    // planes nearest to the computed exit position
    lane_float tx, ty, tz;  // times of kx, ky, kz
    lane_int ex, ey;        // masks: left across x; across y; if neither, across z
    lane_int x, y, z;       // the cell entered
} Crossing;

/// Sets the cell entered across the planes of the axes that `c` names, in exact arithmetic.
static inline void settle_cell(const Walk* w, const AxisCrossing* x, const AxisCrossing* y,
                               const AxisCrossing* z, Crossing* c) {
    const lane_int ez = ~(c->ex | c->ey);
    const lane_long ex = LANES_LONG(c->ex), ey = LANES_LONG(c->ey), ez_long = LANES_LONG(ez);
    const lane_long exit = (x->exit & ex) | (y->exit & ey) | (z->exit & ez_long);
    const lane_long direction =
        (x->direction & ex) | (y->direction & ey) | (z->direction & ez_long);
    // A plane met at the same time as the exit is crossed if its axis comes before the exit's axis,
    // or is that axis.
    const lane_long ax = x->nearest * direction, bx = exit * x->direction;
    const lane_long ay = y->nearest * direction, by = exit * y->direction;
    const lane_long az = z->nearest * direction, bz = exit * z->direction;
    const lane_int crossed_x = LANE_LONG_MASK(ax <= bx);
    const lane_int crossed_y = LANE_LONG_MASK(ay < by) | (LANE_LONG_MASK(ay == by) & ~c->ex);
    const lane_int crossed_z = LANE_LONG_MASK(az < bz) | (LANE_LONG_MASK(az == bz) & ez);
    c->x = LANES_SELECT(w->mx, cell_next_to(c->rx, crossed_x, w->px), w->x);
    c->y = LANES_SELECT(w->my, cell_next_to(c->ry, crossed_y, w->py), w->y);
    c->z = LANES_SELECT(w->mz, cell_next_to(c->rz, crossed_z, w->pz), w->z);
}

/// Decides a crossing in exact arithmetic, for all lanes.
static inline void arbitrate(const PyramidView* p, const Walk* w, Crossing* c) {
    const AxisCrossing x = axis_crossing(c->kx, c->rx, w->ox, w->dx, w->px, p->fixed_point);
    const AxisCrossing y = axis_crossing(c->ky, c->ry, w->oy, w->dy, w->py, p->fixed_point);
    const AxisCrossing z = axis_crossing(c->kz, c->rz, w->oz, w->dz, w->pz, p->fixed_point);
    // t_a <= t_b <=> A_a D_b <= A_b D_a; no block is left across an axis with D = 0.
    c->ex = LANE_LONG_MASK(x.exit * y.direction <= y.exit * x.direction) &
            LANE_LONG_MASK(x.exit * z.direction <= z.exit * x.direction);
    c->ey = LANE_LONG_MASK(y.exit * z.direction <= z.exit * y.direction) & ~c->ex;
    settle_cell(w, &x, &y, &z, c);
}

/// The coordinate of the first cell beyond plane `k` in the ray's direction.
static inline lane_int beyond(lane_int k, lane_int positive) {
    return k + ~positive;
}

static inline lane_int near_plane(lane_int plane, lane_float position, float bound) {
    return LANE_MASK(fabs(LANES_FLOAT(plane) - position) <= bound);
}

/// The coordinate of `cell`, or of `from` if `cell` lies behind `from` as the ray sees it.
static inline lane_int not_back(lane_int cell, lane_int from, lane_int positive) {
    return LANES_SELECT(LANE_MASK(((cell - from) ^ ~positive) < 0), from, cell);
}

/// Moves the `moving` lanes across the first of the planes kx, ky, kz, which lie ahead, one on each
/// axis.
static inline void cross_first(const PyramidView* p, Walk* w, lane_int kx, lane_int ky, lane_int kz,
                               lane_int moving) {
    Crossing c;
    c.kx = kx, c.ky = ky, c.kz = kz;
    const lane_float never = (lane_float)INFINITY;
    c.tx = LANES_SELECT(w->mx, (LANES_FLOAT(c.kx) - w->ox) * w->ix, never);
    c.ty = LANES_SELECT(w->my, (LANES_FLOAT(c.ky) - w->oy) * w->iy, never);
    c.tz = LANES_SELECT(w->mz, (LANES_FLOAT(c.kz) - w->oz) * w->iz, never);
    lane_float t = LANES_LESS(c.tx, LANES_LESS(c.ty, c.tz));
    const lane_float qx = fma(w->dx, t, w->ox);
    const lane_float qy = fma(w->dy, t, w->oy);
    const lane_float qz = fma(w->dz, t, w->oz);
    c.rx = LANES_INT(qx + 0.5f), c.ry = LANES_INT(qy + 0.5f), c.rz = LANES_INT(qz + 0.5f);
    c.ex = LANE_MASK(c.tx == t);
    c.ey = LANE_MASK(c.ty == t) & ~c.ex;
    const lane_int ez = ~(c.ex | c.ey);
    c.x = LANES_SELECT(c.ex, beyond(c.kx, w->px), LANES_INT(qx));
    c.y = LANES_SELECT(c.ey, beyond(c.ky, w->py), LANES_INT(qy));
    c.z = LANES_SELECT(ez, beyond(c.kz, w->pz), LANES_INT(qz));

    const lane_int near_planes = (near_plane(c.rx, qx, p->plane_bound) & w->mx) +
                                 (near_plane(c.ry, qy, p->plane_bound) & w->my) +
                                 (near_plane(c.rz, qz, p->plane_bound) & w->mz);
    const lane_int doubtful = LANE_MASK(near_planes < -1) & moving;
    if (VXL_ARBITRATE && lanes_any(doubtful)) {
        Crossing exact = c;
        arbitrate(p, w, &exact);
        c.x = LANES_SELECT(doubtful, exact.x, c.x);
        c.y = LANES_SELECT(doubtful, exact.y, c.y);
        c.z = LANES_SELECT(doubtful, exact.z, c.z);
        c.ex = LANES_SELECT(doubtful, exact.ex, c.ex);
        c.ey = LANES_SELECT(doubtful, exact.ey, c.ey);
        t = LANES_SELECT(c.ex, c.tx, LANES_SELECT(c.ey, c.ty, c.tz));
    }
    if (!VXL_ARBITRATE) {  // with floats alone, walks would oscillate forever where planes meet
        c.x = not_back(c.x, w->x, w->px);
        c.y = not_back(c.y, w->y, w->py);
        c.z = not_back(c.z, w->z, w->pz);
    }
    w->x = LANES_SELECT(moving, c.x, w->x);
    w->y = LANES_SELECT(moving, c.y, w->y);
    w->z = LANES_SELECT(moving, c.z, w->z);
    w->t = LANES_SELECT(moving, t, w->t);
    w->axis = LANES_SELECT(moving, ~c.ex & (2 + c.ey), w->axis);
}

/// Moves the `moving` lanes out of the aligned blocks of 1 << log2_size empty cells around them.
static inline void advance(const PyramidView* p, Walk* w, lane_int log2_size, lane_int moving) {
    const lane_int size = (lane_int)1 << log2_size;
    const lane_int corner = -size;
    cross_first(p, w, (w->x & corner) + (w->px & size), (w->y & corner) + (w->py & size),
                (w->z & corner) + (w->pz & size), moving);
}

/// The t at which the ray leaves the walk's present cell.
static inline lane_float exit_time(const Walk* w) {
    const lane_float tx = (LANES_FLOAT(w->x - w->px) - w->ox) * w->ix;
    const lane_float ty = (LANES_FLOAT(w->y - w->py) - w->oy) * w->iy;
    const lane_float tz = (LANES_FLOAT(w->z - w->pz) - w->oz) * w->iz;
    return fmin(tx, fmin(ty, tz));
}

/// Mask: coordinates of rays' origins that lie on the side of the world through which the rays
/// enter.
static inline lane_int on_entry_side(lane_float o, lane_float d, int size) {
    return (LANE_MASK(o == 0.0f) & LANE_MASK(d > 0.0f)) |
           (LANE_MASK(o == (float)size) & LANE_MASK(d < 0.0f));
}

/// Marks `entering` walks that begin on a side of the world as having entered through it.
static inline void enter_world(const PyramidView* p, Walk* w, lane_int entering) {
    const lane_int x = on_entry_side(w->ox, w->dx, p->size_x) & entering;
    const lane_int y = on_entry_side(w->oy, w->dy, p->size_y) & entering;
    const lane_int z = on_entry_side(w->oz, w->dz, p->size_z) & entering;
    w->axis = LANES_SELECT(z, (lane_int)2, w->axis);
    w->axis = LANES_SELECT(y, (lane_int)1, w->axis);
    w->axis = LANES_SELECT(x, (lane_int)0, w->axis);
}

#endif
