// SPDX-License-Identifier: Apache-2.0
// Sight rays through a thin lens: they start at points of the lens and meet where it is focused.
#ifndef VXL_LENS_H
#define VXL_LENS_H

#include "lib/sampling/directions.h"
#include "lib/sampling/pixel_points.h"
#include "lib/traverse/display_shape.h"
#include "shared/paths.h"

/// A point of the regular polygon of `corners` corners on the unit circle, with one corner at the
/// top. All points are equally probable: p.y chooses a triangle between two corners and the middle.
static inline SquarePoint polygon_point(SquarePoint p, int corners) {
    const lane_float at = p.y * (float)corners;
    const lane_float first = floor(at), along = at - first, radius = exact_sqrt(p.x);
    const lane_float turn = exact_divide((lane_float)6.28318531f, (lane_float)(float)corners);
    lane_float x, y, next_x, next_y;
    exact_sincos(first * turn, &x, &y);
    exact_sincos((first + 1.0f) * turn, &next_x, &next_y);
    const SquarePoint result = {radius * fma(along, next_x - x, x),
                                radius * fma(along, next_y - y, y)};
    return result;
}

/// The points of the lens, within the unit disk, through which sample number `sample` of the pixels
/// passes. Columns and rows count in the whole frame, so that parts of a picture agree.
static inline SquarePoint lens_point(const Camera* camera, lane_uint column, lane_uint row,
                                     uint sample) {
    const SampledPixels samples = sampled_pixels(column | (row << 16), (lane_uint)sample);
    const SquarePoint p = pixel_point(&samples, (lane_uint)VXL_DECISION_LENS);
    if (VXL_BLADES) return polygon_point(p, camera->blades);
    return disk_point(p);
}

/// Moves the rays of a pyramid's samples to start at points p of the lens, which lies around the
/// observer at right angles to Z_E. At the depth where the lens is focused, they reach the same
/// points as the observer's own rays.
static inline SightRay through_lens(const Camera* camera, SightRay middle, SquarePoint p) {
    SightRay ray = middle;
    ray.direction.x = fma(p.x, -camera->lens_slope, ray.direction.x);
    ray.direction.y = fma(p.y, -camera->lens_slope, ray.direction.y);
    ray.start.x = fma(ray.direction.x, camera->lead, p.x * camera->lens_radius);
    ray.start.y = fma(ray.direction.y, camera->lead, p.y * camera->lens_radius);
    return ray;
}

#endif
