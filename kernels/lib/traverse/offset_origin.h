// SPDX-License-Identifier: Apache-2.0
// The origins of rays that leave the surfaces of instances.
#ifndef VXL_OFFSET_ORIGIN_H
#define VXL_OFFSET_ORIGIN_H

#include "lib/lanes/fixed_point.h"
#include "shared/instance.h"
#include "shared/scene.h"

/// Surface points of instances, moved along `normal` (a unit vector in metric space, on the side
/// that rays leave to) so that they lie on that side in the instance's own voxels, too. Points of
/// the world's surfaces stay where they are.
static inline Vector offset_origin(PyramidShape shape, Vector position, Vector normal,
                                   global const uint* restrict hits, uint stride, uint first) {
    if (!VXL_INSTANCES) return position;
    const lane_uint instance = LANES_LOAD(hits, VXL_HIT_INSTANCE * stride + first);
    const lane_float by = LANES_SELECT(LANE_MASK(instance != VXL_NO_INSTANCE),
                                       (lane_float)shape.origin_offset, (lane_float)0.0f);
    const Vector result = {fma(normal.x, by, position.x), fma(normal.y, by, position.y),
                           fma(normal.z, by, position.z)};
    return result;
}

#endif
