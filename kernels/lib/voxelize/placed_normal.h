// SPDX-License-Identifier: Apache-2.0
// The normal that a world voxel takes from an object's voxel.
#ifndef VXL_PLACED_NORMAL_H
#define VXL_PLACED_NORMAL_H

#include "lib/surface/packed_normal.h"
#include "lib/voxelize/placed.h"

// The normal of an object's voxel, as a gradient in the world's voxels.
static inline uint normal_in_world(const PlacedObject* object, long from) {
    if (!VXL_OBJECT_NORMALS || from < 0) return VXL_NO_NORMAL;
    const uint packed = object->normals[from];
    if (packed == VXL_NO_NORMAL) return packed;
    const float3 own = unpack_one_normal(packed);
    const float of_object[3] = {own.x, own.y, own.z};
    const float unit = as_float((127 - object->fraction_bits) << 23);  // 2^-fraction_bits
    float g[3];
    for (int column = 0; column < 3; ++column) {
        float sum = 0.0f;
        for (int axis = 0; axis < 3; ++axis)
            sum = fma(convert_float_rte(object->rows[4 * axis + column]) * unit, of_object[axis],
                      sum);
        g[column] = sum;
    }
    return pack_normal((float3)(g[0], g[1], g[2]));
}

#endif
