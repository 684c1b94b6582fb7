// SPDX-License-Identifier: Apache-2.0
// The packed normals of shared/normal.h: from vectors, and back.
#ifndef VXL_PACKED_NORMAL_H
#define VXL_PACKED_NORMAL_H

#include "lib/lanes/vector.h"
#include "shared/normal.h"

/// The packed normals as vectors in the voxels of their grid, not of unit length.
static inline Vector unpack_normal(lane_uint packed) {
    const float unit_length = 1.0f / VXL_NORMAL_UNITS;
    const lane_float u = LANES_FLOAT(LANES_AS_INT(packed << 16) >> 16) * unit_length;
    const lane_float v = LANES_FLOAT(LANES_AS_INT(packed) >> 16) * unit_length;
    const lane_float z = 1.0f - fabs(u) - fabs(v);
    const lane_float fold = fmax(-z, 0.0f);
    const Vector n = {u - LANES_SELECT(LANE_MASK(u >= 0.0f), fold, -fold),
                      v - LANES_SELECT(LANE_MASK(v >= 0.0f), fold, -fold), z};
    return n;
}

/// A coordinate of the octahedron's lower half, folded over its edge: `by` with the sign of `to`.
static inline lane_float folded_over(lane_float by, lane_float to) {
    return LANES_SELECT(LANE_MASK(to < 0.0f), -by, by);
}

static inline lane_uint normal_units(lane_float coordinate) {
    return LANES_AS_UINT(LANES_INT(rint(coordinate * (float)VXL_NORMAL_UNITS))) & 0xFFFFu;
}

/// The codes of vectors whose components' sum of sizes is within 2^-24 .. 2^24; VXL_NO_NORMAL for
/// those that are shorter.
static inline lane_uint pack_normal(Vector g) {
    const lane_float size = fabs(g.x) + fabs(g.y) + fabs(g.z);
    const lane_int some = LANE_MASK(size >= 0x1p-24f);
    const lane_float inverse = exact_reciprocal(LANES_SELECT(some, size, (lane_float)1.0f));
    const lane_float x = g.x * inverse, y = g.y * inverse;
    const lane_int below = LANE_MASK(g.z < 0.0f);
    const lane_float u = LANES_SELECT(below, folded_over(1.0f - fabs(y), x), x);
    const lane_float v = LANES_SELECT(below, folded_over(1.0f - fabs(x), y), y);
    const lane_uint code = normal_units(u) | normal_units(v) << 16;
    return LANES_SELECT(some, code, (lane_uint)VXL_NO_NORMAL);
}

/// pack_normal of one vector.
static inline uint pack_one_normal(float x, float y, float z) {
    const Vector g = {(lane_float)x, (lane_float)y, (lane_float)z};
    const lane_uint code = pack_normal(g);
    return ((const uint*)&code)[0];
}

#endif
