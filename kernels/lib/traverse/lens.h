// SPDX-License-Identifier: Apache-2.0
// Sight rays through a thin lens: they start all over it, and meet where it is focused.
#ifndef VXL_LENS_H
#define VXL_LENS_H

#include "lib/light/directions.h"
#include "lib/traverse/display_shape.h"
#include "shared/paths.h"

/// The points of the unit disk through which sample number `sample` of the pixels passes. Columns
/// and rows are those of the whole frame, so that parts of a picture agree.
static inline SquarePoint lens_point(lane_uint column, lane_uint row, uint sample) {
    const lane_uint seed = decision_seed(column | (row << 16), (lane_uint)VXL_DECISION_LENS);
    return disk_point(sobol_point((lane_uint)sample, seed));
}

/// The rays of a pyramid's samples that start at points p of the lens, which is a disk around the
/// observer across Z_E. They come to the same places as the observer's own at the depth where the
/// lens is focused.
static inline SightRay through_lens(const Camera* camera, SightRay ray, SquarePoint p) {
    ray.direction.x = fma(p.x, -camera->lens_slope, ray.direction.x);
    ray.direction.y = fma(p.y, -camera->lens_slope, ray.direction.y);
    ray.start.x = fma(ray.direction.x, camera->lead, p.x * camera->lens_radius);
    ray.start.y = fma(ray.direction.y, camera->lead, p.y * camera->lens_radius);
    return ray;
}

#endif
