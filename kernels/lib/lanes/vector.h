// SPDX-License-Identifier: Apache-2.0
// Vectors of lanes: three components, each a lane type. In memory, the components are `stride`
// values apart.
#ifndef VXL_VECTOR_H
#define VXL_VECTOR_H

#include "lib/lanes/exact_float.h"

typedef struct {
    lane_float x, y, z;
} Vector;

/// Repeats a vector in all lanes.
static inline Vector vector_of(float4 v) {
    const Vector result = {(lane_float)v.x, (lane_float)v.y, (lane_float)v.z};
    return result;
}

static inline lane_float dot_product(Vector a, Vector b) {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}

/// v, with each component multiplied by that of `by`: converts voxels to metres, or back.
static inline Vector scaled(Vector v, float4 by) {
    const Vector result = {v.x * by.x, v.y * by.y, v.z * by.z};
    return result;
}

static inline Vector opposite(Vector v) {
    const Vector result = {-v.x, -v.y, -v.z};
    return result;
}

/// v scaled to length 1; a zero vector stays as it is.
static inline Vector unit(Vector v) {
    const lane_float length = exact_sqrt(dot_product(v, v));
    const lane_float inverse =
        exact_reciprocal(LANES_SELECT(LANE_MASK(length > 0.0f), length, (lane_float)1.0f));
    Vector result = {v.x * inverse, v.y * inverse, v.z * inverse};
    return result;
}

static inline Vector select_vector(lane_int mask, Vector a, Vector b) {
    Vector result = {LANES_SELECT(mask, a.x, b.x), LANES_SELECT(mask, a.y, b.y),
                     LANES_SELECT(mask, a.z, b.z)};
    return result;
}

static inline Vector load_vector(global const float* restrict p, uint stride, uint first) {
    Vector v = {LANES_LOAD(p, first), LANES_LOAD(p, stride + first),
                LANES_LOAD(p, 2 * stride + first)};
    return v;
}

static inline void store_vector(Vector v, global float* restrict p, uint stride, uint first) {
    LANES_STORE(v.x, p, first);
    LANES_STORE(v.y, p, stride + first);
    LANES_STORE(v.z, p, 2 * stride + first);
}

static inline Vector difference(Vector a, Vector b) {
    const Vector result = {a.x - b.x, a.y - b.y, a.z - b.z};
    return result;
}

/// a + b * s.
static inline Vector add_scaled(Vector a, Vector b, lane_float s) {
    const Vector result = {fma(b.x, s, a.x), fma(b.y, s, a.y), fma(b.z, s, a.z)};
    return result;
}

#endif
