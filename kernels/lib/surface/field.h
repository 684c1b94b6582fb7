// SPDX-License-Identifier: Apache-2.0
// The sub-voxel surface of a smooth voxel: half-Taylor interpolation of its corners' distances.
//
// shared/voxel.h has the record and the formula. Values are in distance units (1/8192 voxel),
// positive outside. Neighbouring voxels hold equal bits for the nodes and edges that they share.
#ifndef VXL_FIELD_H
#define VXL_FIELD_H

#include "lib/lanes/records.h"
#include "shared/voxel.h"

/// A decoded record: corner distances, named x y z, and second differences, named by axis and edge.
typedef struct {
    lane_float f000, f100, f010, f110, f001, f101, f011, f111;
    lane_float x00, x10, x01, x11;  // ½ D_x of the edge at (y,z)
    lane_float y00, y10, y01, y11;  // ½ D_y at (x,z)
    lane_float z00, z10, z01, z11;  // ½ D_z at (x,y)
} Field;

static inline lane_float low_half(lane_uint word) {
    return LANES_FLOAT(LANES_AS_INT(word << 16) >> 16);
}
static inline lane_float high_half(lane_uint word) {
    return LANES_FLOAT(LANES_AS_INT(word) >> 16);
}
/// ½ D of the edge whose bits begin at bit `first`.
static inline lane_float half_curvature(lane_uint word, int first) {
    // The nine bits of |D| become the exponent and first mantissa bits of a float of at least 32:
    // (32 + m/2) 2^e.
    const lane_uint size = (first > 17 ? word >> (first - 17) : word << (17 - first)) & 0x3FE0000u;
    const lane_float half_size = LANES_AS_FLOAT(size + 0x42000000u) - 32.0f;
    return LANES_AS_FLOAT(LANES_AS_UINT(half_size) ^ (word << (22 - first) & 0x80000000u));
}

#if VXL_FIELD_WORDS != VXL_RECORD_WORDS
#error "a voxel's field is one record"
#endif

/// Reads a voxel's record.
static inline Field read_field(global const uint* restrict fields, lane_uint voxel) {
    const Records r = read_records(fields, voxel);
    Field f;
    f.f000 = low_half(r.word[0]), f.f100 = high_half(r.word[0]);
    f.f010 = low_half(r.word[1]), f.f110 = high_half(r.word[1]);
    f.f001 = low_half(r.word[2]), f.f101 = high_half(r.word[2]);
    f.f011 = low_half(r.word[3]), f.f111 = high_half(r.word[3]);
    f.x00 = half_curvature(r.word[4], 0);
    f.y00 = half_curvature(r.word[4], 10);
    f.z00 = half_curvature(r.word[4], 20);
    f.x10 = half_curvature(r.word[5], 0);
    f.y10 = half_curvature(r.word[5], 10);
    f.z10 = half_curvature(r.word[5], 20);
    f.x01 = half_curvature(r.word[6], 0);
    f.y01 = half_curvature(r.word[6], 10);
    f.z01 = half_curvature(r.word[6], 20);
    f.x11 = half_curvature(r.word[7], 0);
    f.y11 = half_curvature(r.word[7], 10);
    f.z11 = half_curvature(r.word[7], 20);
    return f;
}

/// The linear interpolation from a at s = 0 to b at s = 1, exact at both ends, so that neighbours
/// give equal bits on the face that they share.
static inline lane_float blend(lane_float a, lane_float b, lane_float s) {
    return fma(s, b, fma(-s, a, a));
}

static inline lane_float bilinear(lane_float a00, lane_float a10, lane_float a01, lane_float a11,
                                  lane_float s, lane_float t) {
    return blend(blend(a00, a10, s), blend(a01, a11, s), t);
}

/// The distance at (x,y,z) in [0,1]³ of the voxel.
static inline lane_float field_value(const Field* f, lane_float x, lane_float y, lane_float z) {
    const lane_float linear = blend(bilinear(f->f000, f->f100, f->f010, f->f110, x, y),
                                    bilinear(f->f001, f->f101, f->f011, f->f111, x, y), z);
    const lane_float dx = bilinear(f->x00, f->x10, f->x01, f->x11, y, z);
    const lane_float dy = bilinear(f->y00, f->y10, f->y01, f->y11, x, z);
    const lane_float dz = bilinear(f->z00, f->z10, f->z01, f->z11, x, y);
    return fma(fma(-x, x, x), dx, fma(fma(-y, y, y), dy, fma(fma(-z, z, z), dz, linear)));
}

/// The gradient of `field_value`, in distance units per voxel.
static inline void field_gradient(const Field* f, lane_float x, lane_float y, lane_float z,
                                  lane_float* gx, lane_float* gy, lane_float* gz) {
    const lane_float bx = fma(-x, x, x), by = fma(-y, y, y), bz = fma(-z, z, z);
    const lane_float dx = bilinear(f->x00, f->x10, f->x01, f->x11, y, z);
    const lane_float dy = bilinear(f->y00, f->y10, f->y01, f->y11, x, z);
    const lane_float dz = bilinear(f->z00, f->z10, f->z01, f->z11, x, y);
    *gx =
        bilinear(f->f100 - f->f000, f->f110 - f->f010, f->f101 - f->f001, f->f111 - f->f011, y, z) +
        fma(fma(-2.0f, x, 1.0f), dx,
            fma(by, blend(f->y10 - f->y00, f->y11 - f->y01, z),
                bz * blend(f->z10 - f->z00, f->z11 - f->z01, y)));
    *gy =
        bilinear(f->f010 - f->f000, f->f110 - f->f100, f->f011 - f->f001, f->f111 - f->f101, x, z) +
        fma(fma(-2.0f, y, 1.0f), dy,
            fma(bx, blend(f->x10 - f->x00, f->x11 - f->x01, z),
                bz * blend(f->z01 - f->z00, f->z11 - f->z10, x)));
    *gz =
        bilinear(f->f001 - f->f000, f->f101 - f->f100, f->f011 - f->f010, f->f111 - f->f110, x, y) +
        fma(fma(-2.0f, z, 1.0f), dz,
            fma(bx, blend(f->x01 - f->x00, f->x11 - f->x10, y),
                by * blend(f->y01 - f->y00, f->y11 - f->y10, x)));
}

#endif
