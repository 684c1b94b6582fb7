// SPDX-License-Identifier: Apache-2.0
// Packs normals as in shared/normal.h from three components, and unpacks them.
#ifndef VXL_PACKED_NORMAL_H
#define VXL_PACKED_NORMAL_H

#include "lib/lanes/exact_float.h"
#include "shared/normal.h"

/// The components of packed normals in the voxels of their grid, not of unit length.
static inline void unpack_components(lane_uint packed, lane_float* x, lane_float* y,
                                     lane_float* z) {
    const float unit_length = 1.0f / VXL_NORMAL_UNITS;
    const lane_float u = LANES_FLOAT(LANES_AS_INT(packed << 16) >> 16) * unit_length;
    const lane_float v = LANES_FLOAT(LANES_AS_INT(packed) >> 16) * unit_length;
    *z = 1.0f - fabs(u) - fabs(v);
    const lane_float fold = fmax(-*z, 0.0f);
    *x = u - LANES_SELECT(LANE_MASK(u >= 0.0f), fold, -fold);
    *y = v - LANES_SELECT(LANE_MASK(v >= 0.0f), fold, -fold);
}

/// A coordinate of the octahedron's lower half, folded over its edge: `by`, with the sign of `to`.
static inline lane_float folded_over(lane_float by, lane_float to) {
    return LANES_SELECT(LANE_MASK(to < 0.0f), -by, by);
}

static inline lane_uint normal_units(lane_float coordinate) {
    return LANES_AS_UINT(LANES_INT(rint(coordinate * (float)VXL_NORMAL_UNITS))) & 0xFFFFu;
}

/// Packs vectors whose components have absolute values that sum up to 2^-24 .. 2^24; shorter ones
/// become VXL_NO_NORMAL.
static inline lane_uint pack_components(lane_float x, lane_float y, lane_float z) {
    const lane_float size = fabs(x) + fabs(y) + fabs(z);
    const lane_int some = LANE_MASK(size >= 0x1p-24f);
    const lane_float inverse = exact_reciprocal(LANES_SELECT(some, size, (lane_float)1.0f));
    x *= inverse;
    y *= inverse;
    const lane_int below = LANE_MASK(z < 0.0f);
    const lane_float u = LANES_SELECT(below, folded_over(1.0f - fabs(y), x), x);
    const lane_float v = LANES_SELECT(below, folded_over(1.0f - fabs(x), y), y);
    const lane_uint code = normal_units(u) | normal_units(v) << 16;
    return LANES_SELECT(some, code, (lane_uint)VXL_NO_NORMAL);
}

/// pack_components for one vector.
static inline uint pack_normal(float3 n) {
    const lane_uint code = pack_components((lane_float)n.x, (lane_float)n.y, (lane_float)n.z);
    return ((const uint*)&code)[0];
}

/// unpack_components for one code.
static inline float3 unpack_one_normal(uint packed) {
    lane_float x, y, z;
    unpack_components((lane_uint)packed, &x, &y, &z);
    return (float3)(((const float*)&x)[0], ((const float*)&y)[0], ((const float*)&z)[0]);
}

#endif
