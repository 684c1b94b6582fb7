// SPDX-License-Identifier: Apache-2.0
// Depths of points and rays before an observer.
#ifndef VXL_DEPTH_H
#define VXL_DEPTH_H

#include "lib/lanes/fixed_point.h"
#include "lib/lanes/vector.h"
#include "lib/traverse/display_shape.h"
#include "shared/display.h"
#include "shared/scene.h"

/// The vector to a point from the camera's `origin`, which lies `lead` metres ahead of E, in
/// voxels.
static inline Vector from_eye(const Camera* camera, Vector p) {
    const Vector result = {p.x - camera->origin.x - camera->origin_low.x,
                           p.y - camera->origin.y - camera->origin_low.y,
                           p.z - camera->origin.z - camera->origin_low.z};
    return result;
}

/// The component of a vector along Z_E, in metres.
static inline lane_float along_sight(const Camera* camera, float4 edge, Vector metres) {
    // Z_E in voxels per metre, times the edge, is a unit vector.
    return fma(metres.x, camera->axis_z.x * edge.x,
               fma(metres.y, camera->axis_z.y * edge.y, metres.z * (camera->axis_z.z * edge.z)));
}

/// The depth in metres of a point given in voxels from the camera's `origin`: along Z_E, or along
/// the ray.
static inline lane_float depth_of(const Camera* camera, float4 edge, Vector from_eye) {
    const Vector metres = scaled(from_eye, edge);
    if (!depth_is_along_z(camera)) return exact_sqrt(dot_product(metres, metres));
    return along_sight(camera, edge, metres);
}

/// The step that a depth beyond the near surface lies in.
static inline lane_uint step_of(const DisplaySteps* steps, lane_float depth) {
    const lane_int step = LANES_INT(fmax(depth, 0.0f) * steps->inverse_step);
    return LANES_AS_UINT(clamp(step, (lane_int)0, (lane_int)(steps->count - 1)));
}

/// The relation between a ray's t and the depth beyond the near surface.
typedef struct {
    lane_float metres;  // metres per unit of t
    lane_float along;   // depth per unit of t
    lane_float origin;  // depth at t = 0
} DepthScale;

static inline DepthScale depth_scale(const Camera* camera, float4 edge, Vector o, Vector d) {
    DepthScale s;
    s.metres = metres_per_t(edge, d);
    s.along = s.metres;
    if (depth_is_along_z(camera)) s.along = depth_of(camera, edge, d);
    s.origin = depth_of(camera, edge, from_eye(camera, o)) - camera->near_plane;
    return s;
}

#endif
