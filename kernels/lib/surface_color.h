// The colour of a surface point: its material's, times its voxel's own.
#ifndef VXL_SURFACE_COLOR_H
#define VXL_SURFACE_COLOR_H

#include "lib/exact_exp.h"
#include "shared/scene.h"
#include "shared/voxel.h"

/// 8-bit sRGB to linear, one channel of a packed colour.
static inline lane_float linear_channel(lane_uint color, int shift) {
    const lane_float s = LANES_FLOAT((color >> shift) & 255u) * (1.0f / 255.0f);
    const lane_float curved = exact_power(fma(s, 0.947867299f, 0.0521327014f), (lane_float)2.4f);
    return LANES_SELECT(LANE_MASK(s <= 0.04045f), s * 0.0773993808f, curved);
}

/// The colour of a surface point: its material's, times its voxel's own where the world has such.
static inline lane_float surface_color(global const float* restrict materials, lane_uint material,
                                       global const uint* restrict colors, lane_uint voxel,
                                       int channel) {
    lane_float color = LANES_GATHER_FLOAT(materials, material + (uint)channel);
    if (VXL_COLORS) color *= linear_channel(LANES_GATHER_UINT(colors, voxel), 8 * channel);
    return color;
}

/// Where the record of an attribute word's material starts, in floats.
static inline lane_uint material_place(lane_uint word) {
    return ((word >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK) * VXL_MATERIAL_FLOATS;
}

#endif
