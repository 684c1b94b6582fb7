// SPDX-License-Identifier: Apache-2.0
// The state in which a packet's rays come to surfaces, and what they have found.
#ifndef VXL_SURFACE_HIT_H
#define VXL_SURFACE_HIT_H

#include "lib/surface/cube_behind.h"
#include "lib/traverse/medium_set.h"
#include "shared/instance.h"
#include "shared/trace.h"

#define VXL_NO_OBJECT 0xFFFFFFFFu

/// The state in which a packet's rays set out.
typedef struct {
    lane_int on_surface;     // mask: begins on a surface
    lane_int goes_on;        // mask: continues an earlier ray, whose surface was met at t_first
    lane_int refracted;      // mask: the surface that it begins on has refracted it
    lane_uint source;        // the primitive that it begins on; else see source_of_hit
    lane_int within_source;  // mask: it continues inside that primitive's object
    lane_float t_first;
    MediumSet media;     // in scenes with transmitting objects; empty elsewhere
    lane_uint body;      // the body of cubes in `media`; VXL_NO_MEDIUM for none
    lane_int joined;     // mask: the body's inner faces are no surfaces
    lane_int unsure;     // mask: it may begin inside smooth objects without knowing
    lane_uint instance;  // whose surface it begins on; VXL_NO_INSTANCE for the world's
    lane_int asks_side;  // mask: within_source isn't known yet; an instance's space will tell
    lane_int on_cube;    // mask: cubes in the cell where it begins are behind it, in scenes with
                         // instances; elsewhere on_surface tells
    lane_int guesses;    // mask: fields' signs tell its side, even where it begins on them; in
                         // scenes with instances
    lane_uint field_of, triangle_of;  // the object on whose field or triangles it begins;
                                      // VXL_NO_OBJECT for none; see mixed_mesh.h
} RayState;

/// What a packet has found so far.
typedef struct {
    lane_int hit;  // mask
    lane_float t;
    lane_uint leaf, voxel, primitive;
    lane_uint solid;     // the last solid tested
    lane_float level;    // shift of smooth surfaces for rays that began on one, see hit_smooth
    lane_int within;     // mask: the hit is on a field, met from inside its object
    lane_uint inside;    // packed attributes of a smooth object that an unsure ray was found to be
                         // inside; VXL_NO_MEDIUM for none
    lane_int in_body;    // mask: the walk has been in a cell of the body that the ray is inside of
    lane_int exit;       // mask: the hit is the face across which it left the body
    CubeBehind behind;   // in scenes whose voxels may be exact and cubes at once
    lane_uint instance;  // whose surface was hit; VXL_NO_INSTANCE for the world's
} SurfaceHit;

/// Takes a hit at `t` on a cube or field in the `accepted` lanes, unless a primitive is hit
/// earlier.
static inline void take_voxel_hit(SurfaceHit* found, lane_float t, lane_int accepted) {
    const lane_int closer = accepted & LANE_MASK(t < found->t);
    found->t = LANES_SELECT(closer, t, found->t);
    found->primitive = LANES_SELECT(closer, (lane_uint)VXL_NO_PRIMITIVE, found->primitive);
}

/// The hit of a packet before its walk.
static inline SurfaceHit no_hit_yet(void) {
    SurfaceHit found;
    found.hit = (lane_int)0;
    found.t = (lane_float)INFINITY;
    found.leaf = found.voxel = (lane_uint)0;
    found.primitive = found.solid = (lane_uint)VXL_NO_PRIMITIVE;
    found.level = (lane_float)0.0f;
    found.within = (lane_int)0;
    found.inside = (lane_uint)VXL_NO_MEDIUM;
    found.in_body = found.exit = (lane_int)0;
    found.behind = no_cube_behind();
    found.instance = (lane_uint)VXL_NO_INSTANCE;
    return found;
}

#endif
