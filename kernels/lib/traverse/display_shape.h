// SPDX-License-Identifier: Apache-2.0
// The functions that depend on a display's shape: its sight rays, its depths, its inside. The
// host's counterpart is runtime/scene/parts/display_shape.hpp.
#ifndef VXL_DISPLAY_SHAPE_H
#define VXL_DISPLAY_SHAPE_H

#include "lib/lanes/exact_exp.h"
#include "lib/lanes/vector.h"
#include "shared/display.h"
#include "shared/scene.h"

/// A sight ray in the observer's coordinates, metres.
typedef struct {
    Vector start, direction;
} SightRay;

/// The ray of the sample at (u, v), each in [-1, 1] with u to the right and v down. Samples for
/// which the shape has no ray are cleared in `seen`.
static inline SightRay sight_ray(const Camera* camera, lane_float u, lane_float v, lane_int* seen) {
    SightRay ray;
    const lane_float zero = (lane_float)0.0f;
    // Image right is -X_E, image up is Y_E.
    const lane_float x = -u * camera->half_x, y = -v * camera->half_y;
    ray.start.x = ray.start.y = ray.start.z = zero;
    if (camera->shape == VXL_SHAPE_PYRAMID) {
        ray.start.x = x * camera->lead, ray.start.y = y * camera->lead;
        ray.direction.x = x, ray.direction.y = y, ray.direction.z = (lane_float)1.0f;
    } else if (camera->shape == VXL_SHAPE_BOX) {
        ray.start.x = x, ray.start.y = y;
        ray.direction.x = ray.direction.y = zero, ray.direction.z = (lane_float)1.0f;
    } else if (camera->shape == VXL_SHAPE_BALL) {  // longitude and latitude
        lane_float sin_x, cos_x, sin_y, cos_y;
        exact_sincos(x, &sin_x, &cos_x);
        exact_sincos(y, &sin_y, &cos_y);
        ray.direction.x = sin_x * cos_y, ray.direction.y = sin_y, ray.direction.z = cos_x * cos_y;
    } else {  // sector: the angle from Z_E is proportional to the distance from the middle
        const lane_float radius = exact_sqrt(fma(u, u, v * v));
        lane_float sine, cosine;
        exact_sincos(radius * camera->half_x, &sine, &cosine);
        const lane_float by =
            exact_divide(sine, LANES_SELECT(LANE_MASK(radius > 0.0f), radius, (lane_float)1.0f));
        ray.direction.x = -u * by, ray.direction.y = -v * by, ray.direction.z = cosine;
        *seen &= LANE_MASK(radius <= 1.0f);
    }
    return ray;
}

/// True if depths count along Z_E, false if they count along the sight ray.
static inline bool depth_is_along_z(const Camera* camera) {
    return camera->shape == VXL_SHAPE_PYRAMID || camera->shape == VXL_SHAPE_BOX;
}

/// True if every sight ray leads ahead, so that Z grows along it.
static inline bool looks_ahead(const Camera* camera) {
    if (camera->shape == VXL_SHAPE_SECTOR) return camera->half_x <= 1.57079637f;  // a quarter turn
    return camera->shape != VXL_SHAPE_BALL;
}

/// The vector along a sight ray from its start to a point, in voxels. `eye` is the vector from the
/// camera's `origin` to the point, which lies `depth` metres along Z_E from there. Where depths
/// count along Z_E, `length`, the point's distance in metres, is replaced by the depth.
static inline Vector sight_way(const Camera* camera, Vector eye, lane_float depth,
                               lane_float* length) {
    const float4 ahead = camera->axis_z;
    Vector way = eye;
    if (camera->shape == VXL_SHAPE_PYRAMID) {
        const lane_float whole = depth + camera->lead;
        const lane_float part =
            exact_divide(depth, LANES_SELECT(LANE_MASK(whole > 0.0f), whole, (lane_float)1.0f));
        way.x = fma((lane_float)ahead.x, (lane_float)camera->lead, eye.x) * part;
        way.y = fma((lane_float)ahead.y, (lane_float)camera->lead, eye.y) * part;
        way.z = fma((lane_float)ahead.z, (lane_float)camera->lead, eye.z) * part;
        *length = depth;
    } else if (camera->shape == VXL_SHAPE_BOX) {
        way.x = ahead.x * depth, way.y = ahead.y * depth, way.z = ahead.z * depth;
        *length = depth;
    }
    return way;
}

/// True if a point within the lattice, in metres in the observer's coordinates, lies in the shape.
static inline bool is_in_shape(const DisplayLattice* l, float3 p) {
    if (l->shape == VXL_SHAPE_PYRAMID)
        return fabs(p.x) <= p.z * l->slope_x && fabs(p.y) <= p.z * l->slope_y;
    if (l->shape == VXL_SHAPE_BOX) return true;
    const float squared = fma(p.x, p.x, fma(p.y, p.y, p.z * p.z));
    if (squared > l->far_depth * l->far_depth) return false;
    if (l->shape == VXL_SHAPE_BALL) return true;
    // The angle from Z_E is compared by squares: this needs no root, and the cosine may be
    // negative.
    const float minimum = l->slope_x * fabs(l->slope_x) * squared;
    return squared >= l->near_depth * l->near_depth && p.z * fabs(p.z) >= minimum;
}

#endif
