// SPDX-License-Identifier: Apache-2.0
// Offsets the origins of rays that leave the surfaces of instances, or triangles.
#ifndef VXL_OFFSET_ORIGIN_H
#define VXL_OFFSET_ORIGIN_H

#include "lib/lanes/exact_float.h"
#include "lib/lanes/fixed_point.h"
#include "shared/instance.h"
#include "shared/scene.h"

/// The maximum distance, in voxels along a unit vector of metric space, of computed points from the
/// world's triangles: the points are right within plane_bound along each axis.
static inline lane_float rounding_of_points(PyramidShape shape) {
    const float4 e = shape.edge;
    const lane_float uneven =
        exact_divide((lane_float)fmax(e.x, fmax(e.y, e.z)), (lane_float)fmin(e.x, fmin(e.y, e.z)));
    return 1.7320508f * uneven * shape.plane_bound;
}

/// Surface points moved along `normal` by as much as rounding may have put them behind the surface.
/// `normal` is a unit vector in metric space, on the side to which rays leave. Moved points of
/// instances lie on that side in the instance's own voxels, too; moved points of the world's
/// triangles also lie on that side of neighbours in the same plane. In scenes with objects that let
/// light through, points of the world's triangles are not moved: beyond the back of a thin pane, a
/// ray would never leave the pane. Points of the world's cubes, fields and solids are never moved.
static inline Vector offset_origin(PyramidShape shape, Vector position, Vector normal,
                                   global const uint* restrict hits, uint stride, uint first) {
    const int moves_off_triangles = VXL_TRIANGLES & !VXL_TRANSMISSION;
    if (!(VXL_INSTANCES | moves_off_triangles)) return position;
    lane_float by = (lane_float)0.0f;
    if (moves_off_triangles) {
        const lane_uint primitive = LANES_LOAD(hits, VXL_HIT_PRIMITIVE * stride + first);
        by = LANES_SELECT(LANE_MASK((primitive >> 30) == 0u), rounding_of_points(shape), by);
    }
    if (VXL_INSTANCES) {
        const lane_uint instance = LANES_LOAD(hits, VXL_HIT_INSTANCE * stride + first);
        by = LANES_SELECT(LANE_MASK(instance != VXL_NO_INSTANCE), (lane_float)shape.origin_offset,
                          by);
    }
    const Vector result = {fma(normal.x, by, position.x), fma(normal.y, by, position.y),
                           fma(normal.z, by, position.z)};
    return result;
}

#endif
