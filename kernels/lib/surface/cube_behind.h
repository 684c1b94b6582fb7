// SPDX-License-Identifier: Apache-2.0
// The cubes of voxels that list surfaces which come before them.
#ifndef VXL_CUBE_BEHIND_H
#define VXL_CUBE_BEHIND_H

#include "lib/traverse/voxel_kinds.h"
#include "lib/traverse/walk.h"

/// The cube of a voxel whose surfaces a ray has missed. A surface passes through many such voxels
/// side by side, and the ray may meet it in the next one. So the ray meets the cube only when it
/// reaches a cell of another kind, or leaves the world, without having met a surface.
typedef struct {
    lane_int kept;  // mask: there is such a cube; the first of several
    lane_float t;
    lane_int passes;  // mask: the ray has been only in such voxels since it left a surface in one
    lane_uint voxel, cell_xy, cell_z;  // x | y << 16, z | axis << 16: where the walk was
} CubeBehind;

static inline CubeBehind no_cube_behind(void) {
    CubeBehind b;
    b.kept = b.passes = (lane_int)0;
    b.t = (lane_float)0.0f;
    b.voxel = b.cell_xy = b.cell_z = (lane_uint)0;
    return b;
}

/// Replaces the cubes of the `taken` lanes by those of `other`.
static inline void replace_cubes(CubeBehind* b, const CubeBehind* other, lane_int taken) {
    b->kept = LANES_SELECT(taken, other->kept, b->kept);
    b->passes = LANES_SELECT(taken, other->passes, b->passes);
    b->t = LANES_SELECT(taken, other->t, b->t);
    b->voxel = LANES_SELECT(taken, other->voxel, b->voxel);
    b->cell_xy = LANES_SELECT(taken, other->cell_xy, b->cell_xy);
    b->cell_z = LANES_SELECT(taken, other->cell_z, b->cell_z);
}

/// Lets rays of the `tested` lanes pass cubes that lie `behind` surfaces in their voxels. The rays
/// do so from where they are `leaving` such a surface, to the side that light comes from, up to the
/// first voxel of another kind. Rays that arrive at that surface pass these cubes as well.
static inline void pass_cubes(CubeBehind* b, lane_int tested, lane_int behind, lane_int leaving) {
    b->passes = LANES_SELECT(tested, (b->passes | leaving) & behind, b->passes);
}

/// The axis across whose plane a line enters the walk's cell.
static inline lane_int entry_axis(const Walk* w) {
    const lane_float none = (lane_float)-INFINITY;
    const lane_float tx =
        LANES_SELECT(w->mx, (LANES_FLOAT(w->x + w->px + 1) - w->ox) * w->ix, none);
    const lane_float ty =
        LANES_SELECT(w->my, (LANES_FLOAT(w->y + w->py + 1) - w->oy) * w->iy, none);
    const lane_float tz =
        LANES_SELECT(w->mz, (LANES_FLOAT(w->z + w->pz + 1) - w->oz) * w->iz, none);
    const lane_int y = LANE_MASK(ty >= tx) & 1;
    return LANES_SELECT(LANE_MASK(tz >= fmax(tx, ty)), (lane_int)2, y);
}

/// Keeps the cubes that walks are in, for the `missed` lanes that have none yet. Rays that have
/// come `through` a surface in the voxel meet the cube behind it, and see the face that faces them.
static inline void keep_cube(CubeBehind* b, const Walk* w, lane_uint voxel, lane_int missed,
                             lane_int through) {
    const lane_int fresh = missed & ~(b->kept | b->passes);
    const lane_int axis = LANES_SELECT(through, entry_axis(w), w->axis);
    b->kept |= fresh;
    b->t = LANES_SELECT(fresh, w->t, b->t);
    b->voxel = LANES_SELECT(fresh, voxel, b->voxel);
    b->cell_xy = LANES_SELECT(fresh, LANES_AS_UINT(w->x | w->y << 16), b->cell_xy);
    b->cell_z = LANES_SELECT(fresh, LANES_AS_UINT(w->z | axis << 16), b->cell_z);
}

/// Moves the walks of `lanes` back to their cubes, which are then no longer kept.
static inline void put_back(CubeBehind* b, Walk* w, lane_int lanes) {
    b->kept &= ~lanes;
    w->t = LANES_SELECT(lanes, b->t, w->t);
    w->x = LANES_SELECT(lanes, LANES_AS_INT(b->cell_xy & 0xFFFFu), w->x);
    w->y = LANES_SELECT(lanes, LANES_AS_INT(b->cell_xy >> 16), w->y);
    w->z = LANES_SELECT(lanes, LANES_AS_INT(b->cell_z & 0xFFFFu), w->z);
    w->axis = LANES_SELECT(lanes, LANES_AS_INT(b->cell_z >> 16), w->axis);
}

#endif
