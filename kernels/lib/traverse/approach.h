// SPDX-License-Identifier: Apache-2.0
// Walks that begin shortly before a point of their rays, without the steps up to there.
#ifndef VXL_APPROACH_H
#define VXL_APPROACH_H

#include "lib/traverse/walk.h"

/// The number of planes between cells, times -1, that the ray's point at t may lie on; planes along
/// which the ray runs don't count.
static inline lane_int planes_at(const PyramidView* p, const Walk* w, lane_float t) {
    const lane_float x = fma(w->dx, t, w->ox), y = fma(w->dy, t, w->oy), z = fma(w->dz, t, w->oz);
    return (near_plane(LANES_INT(x + 0.5f), x, p->plane_bound) & w->mx) +
           (near_plane(LANES_INT(y + 0.5f), y, p->plane_bound) & w->my) +
           (near_plane(LANES_INT(z + 0.5f), z, p->plane_bound) & w->mz);
}

/// The t at which the ray enters cell x of an axis along which it moves; elsewhere -infinity.
static inline lane_float axis_entry(lane_int x, lane_float o, lane_float inverse, lane_int positive,
                                    lane_int moves) {
    return LANES_SELECT(moves, (LANES_FLOAT(x + positive + 1) - o) * inverse,
                        (lane_float)-INFINITY);
}

/// Moves the walks of `lanes` to the cell that their rays are in at `t`, with the state in which
/// steps would have reached it. Returns the mask of lanes that stay: the cell at t, or the face
/// through which the ray enters it, isn't certain, or the walk has come past t.
static inline lane_int skip_to(const PyramidView* p, Walk* w, lane_float t, lane_int lanes) {
    const lane_int ahead = lanes & LANE_MASK(t > w->t);
    const lane_float at = LANES_SELECT(ahead, t, (lane_float)0.0f);
    lane_int sure = ahead & LANE_MASK(planes_at(p, w, at) == 0);
    Walk to = *w;
    to.x = LANES_SELECT(w->mx, LANES_INT(fma(w->dx, at, w->ox)), w->x);
    to.y = LANES_SELECT(w->my, LANES_INT(fma(w->dy, at, w->oy)), w->y);
    to.z = LANES_SELECT(w->mz, LANES_INT(fma(w->dz, at, w->oz)), w->z);
    sure &= in_grid(p, &to);
    const lane_float tx = axis_entry(to.x, w->ox, w->ix, w->px, w->mx);
    const lane_float ty = axis_entry(to.y, w->oy, w->iy, w->py, w->my);
    const lane_float tz = axis_entry(to.z, w->oz, w->iz, w->pz, w->mz);
    to.t = fmax(tx, fmax(ty, tz));
    const lane_int moved =
        sure & (LANE_MASK(to.x != w->x) | LANE_MASK(to.y != w->y) | LANE_MASK(to.z != w->z));
    const lane_float entry = LANES_SELECT(moved, to.t, (lane_float)0.0f);
    const lane_int taken =
        moved & LANE_MASK(entry > w->t) & LANE_MASK(planes_at(p, w, entry) >= -1);
    const lane_int across_x = LANE_MASK(tx == to.t), across_y = LANE_MASK(ty == to.t) & ~across_x;
    w->x = LANES_SELECT(taken, to.x, w->x);
    w->y = LANES_SELECT(taken, to.y, w->y);
    w->z = LANES_SELECT(taken, to.z, w->z);
    w->t = LANES_SELECT(taken, to.t, w->t);
    w->axis = LANES_SELECT(taken, ~across_x & (2 + across_y), w->axis);
    return lanes & ~(taken | (sure & ~moved));
}

/// Moves the walks of `lanes` to the cell of their rays' points at t or to one shortly before it.
/// Walks of which no such cell is certain stay where they are.
static inline void approach(const PyramidView* p, Walk* w, lane_float t, lane_int lanes) {
    lane_int left = skip_to(p, w, t, lanes);
    // Points on faces of cells are common, since boxes may have their faces there.
    const lane_float cell = fmin(fabs(w->ix), fmin(fabs(w->iy), fabs(w->iz)));
    for (float back = 0.015625f; back <= 1.0f && lanes_any(left); back *= 8.0f)
        left = skip_to(p, w, fma(cell, (lane_float)-back, t), left);
}

#endif
