// SPDX-License-Identifier: Apache-2.0
// Faces of instances that lie exactly on the world's bounds.
//
// A ray that enters the world begins on one of its sides. In an instance's space, a face on that
// side may lie behind this point, and a face on the side by which the ray leaves may lie beyond its
// last point. The difference across the side is no more than the rounding of faces, but along a
// grazing ray that is far. So rays look for an instance's faces as if the world's bounds lay
// farther out by that rounding.
#ifndef VXL_BOUNDS_SLACK_H
#define VXL_BOUNDS_SLACK_H

#include "lib/lanes/vector.h"
#include "lib/traverse/walk.h"

/// How far a ray's first and last point move in t if the bounds move by one voxel; 0 for rays that
/// begin or end inside the world.
typedef struct {
    lane_float in, out;
    lane_float t_out;  // the last point, with the bounds where they are
    lane_float t_end;  // the ray's end
} BoundsSlack;

/// The smaller of `slowness` and an axis's |1 / d|, in the lanes of `mask`.
static inline lane_float min_slowness(lane_float slowness, lane_float inverse, lane_int mask) {
    return LANES_SELECT(mask, fmin(slowness, fabs(inverse)), slowness);
}

/// How far a ray's first point moves in t if the bounds move outwards by one voxel; 0 unless it
/// lies on a side through which the ray enters.
static inline lane_float slack_of_entry(Vector o, Vector d, int size_x, int size_y, int size_z) {
    const lane_float none = (lane_float)INFINITY;
    lane_float in = none;
    in = min_slowness(in, exact_reciprocal(d.x), on_entry_side(o.x, d.x, size_x));
    in = min_slowness(in, exact_reciprocal(d.y), on_entry_side(o.y, d.y, size_y));
    in = min_slowness(in, exact_reciprocal(d.z), on_entry_side(o.z, d.z, size_z));
    return LANES_SELECT(LANE_MASK(in < none), in, (lane_float)0.0f);
}

/// Mask: rays that reach the far side of one axis by t_out.
static inline lane_int goes_out_by(lane_float t_out, lane_float o, lane_float inverse,
                                   lane_int positive, lane_int moves, int size) {
    const lane_float side = LANES_SELECT(positive, (lane_float)(float)size, (lane_float)0.0f);
    return moves & LANE_MASK((side - o) * inverse <= t_out);
}

/// The slack of rays that leave the world, or end, at t_out. Rays that are not `new` continue from
/// a surface.
static inline BoundsSlack bounds_slack(const PyramidView* p, const Walk* w, lane_int new,
                                       lane_float t_out, lane_float t_end) {
    const lane_float none = (lane_float)INFINITY;
    const Vector o = {w->ox, w->oy, w->oz}, d = {w->dx, w->dy, w->dz};
    const lane_float in = slack_of_entry(o, d, p->size_x, p->size_y, p->size_z);
    lane_float out = none;
    out = min_slowness(out, w->ix, goes_out_by(t_out, w->ox, w->ix, w->px, w->mx, p->size_x));
    out = min_slowness(out, w->iy, goes_out_by(t_out, w->oy, w->iy, w->py, w->my, p->size_y));
    out = min_slowness(out, w->iz, goes_out_by(t_out, w->oz, w->iz, w->pz, w->mz, p->size_z));
    BoundsSlack slack;
    slack.in = LANES_SELECT(new, in, (lane_float)0.0f);
    slack.out = LANES_SELECT(LANE_MASK(out < none), out, (lane_float)0.0f);
    slack.t_out = t_out;
    slack.t_end = t_end;
    return slack;
}

/// The first t at which surfaces count, for a ray that begins at `t_first`, where faces are right
/// within `rounding` voxels.
static inline lane_float first_of_faces(const BoundsSlack* s, lane_float t_first, float rounding) {
    return fma(s->in, (lane_float)-rounding, t_first);
}

/// The last t at which surfaces count: t_last, or beyond it if the ray leaves the world there.
static inline lane_float last_of_faces(const BoundsSlack* s, lane_float t_last, float rounding) {
    const lane_float beyond = fmin(fma(s->out, (lane_float)rounding, s->t_out), s->t_end);
    return LANES_SELECT(LANE_MASK(t_last < s->t_out), t_last, beyond);
}

#endif
