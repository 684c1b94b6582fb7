// SPDX-License-Identifier: Apache-2.0
// The cubes of one object that a ray is inside of, treated as one body.
//
// The ray's medium set changes when the ray enters the first voxel of the body, and when it leaves
// the last one to a cell that isn't the object's; voxels between don't change the set. If the
// material refracts, the body consists of this material alone, and these two faces are its whole
// surface. Otherwise every voxel entered covers what lies behind it by its opacity, and the face
// where the ray leaves does nothing.
#ifndef VXL_CUBE_BODY_H
#define VXL_CUBE_BODY_H

#include "lib/surface/surface_color.h"
#include "lib/traverse/medium_set.h"
#include "lib/traverse/walk.h"

/// Mask: a surface is the face of a cube.
static inline lane_int is_cube(lane_uint packed, lane_uint primitive) {
    return LANE_MASK((packed >> VXL_KIND_SHIFT) == VXL_KIND_CUBES) &
           LANE_MASK(primitive == VXL_NO_PRIMITIVE);
}

/// The packed attributes of the body that a ray is inside of; VXL_NO_MEDIUM for none. A voxel shows
/// one object, so there is at most one body.
static inline lane_uint body_inside(const MediumSet* in) {
    const lane_uint kind = (lane_uint)VXL_KIND_CUBES;
    lane_uint body = (lane_uint)VXL_NO_MEDIUM;
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i)
        body = LANES_SELECT(LANE_MASK((in->members[i] >> VXL_KIND_SHIFT) == kind), in->members[i],
                            body);
    return body;
}

/// Mask: bodies of which the faces between voxels are no surfaces.
static inline lane_int is_joined(lane_uint body, global const float* restrict materials) {
    const lane_int some = LANE_MASK(body != VXL_NO_MEDIUM);
    const lane_uint material = material_offset(body) & LANES_AS_UINT(some);
    return some &
           LANE_MASK(LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFRACTION) > 0.0f);
}

/// Mask: cubes of `packed` that belong to the body that a ray is inside of. Other materials of the
/// object aren't part of a body that is `joined`.
static inline lane_int is_of_body(lane_uint body, lane_uint packed, lane_int joined) {
    const uint material = VXL_MATERIAL_MASK << VXL_MATERIAL_SHIFT;
    return is_medium(body, packed) & (~joined | LANE_MASK(((body ^ packed) & material) == 0u));
}

/// Mask: the surface of a hit whose VXL_HIT_FACE is `face` was met from inside, by leaving a cell.
static inline lane_int is_exit(lane_uint face) {
    return LANE_MASK((face & VXL_FACE_EXIT) != 0u);
}

/// Moves the `moving` walks by one cell along the axis of their last crossing, towards larger
/// coordinates where `up`.
static inline void step_across(Walk* w, lane_int up, lane_int moving) {
    const lane_int step = (-1 - 2 * up) & moving;
    w->x += step & LANE_MASK(w->axis == 0);
    w->y += step & LANE_MASK(w->axis == 1);
    w->z += step & LANE_MASK(w->axis == 2);
}

/// Mask: the walk's last crossing led towards larger coordinates.
static inline lane_int crossed_upwards(const Walk* w) {
    return LANES_SELECT(LANE_MASK(w->axis == 0), w->px,
                        LANES_SELECT(LANE_MASK(w->axis == 1), w->py, w->pz));
}

/// The face of a hit as in VXL_HIT_FACE. Where a walk left a body, this moves the walk back to the
/// body's last cell, for VXL_HIT_CELL.
static inline lane_uint hit_face(Walk* w, lane_int exit) {
    lane_uint flags = (lane_uint)0;
    if (VXL_CUBE_BODIES) {
        const lane_int up = crossed_upwards(w);
        step_across(w, ~up, exit);
        flags = (LANES_AS_UINT(exit) & VXL_FACE_EXIT) | (LANES_AS_UINT(exit & up) & VXL_FACE_UP);
    }
    return LANES_AS_UINT(w->z | (w->axis << VXL_FACE_AXIS_SHIFT)) | flags;
}

#endif
