// SPDX-License-Identifier: Apache-2.0
// The colour of a surface point: its material's colour times its voxel's own.
#ifndef VXL_SURFACE_COLOR_H
#define VXL_SURFACE_COLOR_H

#include "lib/lanes/exact_exp.h"
#include "shared/scene.h"
#include "shared/texture.h"
#include "shared/voxel.h"

/// 8-bit sRGB to linear, one channel of a packed colour.
static inline lane_float linear_channel(lane_uint color, int shift) {
    const lane_float s = LANES_FLOAT((color >> shift) & 255u) * (1.0f / 255.0f);
    const lane_float curved = exact_power(fma(s, 0.947867299f, 0.0521327014f), (lane_float)2.4f);
    return LANES_SELECT(LANE_MASK(s <= 0.04045f), s * 0.0773993808f, curved);
}

/// The index, in floats, of the material's record for packed attributes.
static inline lane_uint material_offset(lane_uint packed) {
    return ((packed >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK) * VXL_MATERIAL_FLOATS;
}

/// The block coordinate of `position` (in voxels) along one axis of a material's checker.
static inline lane_int checker_block(global const float* restrict materials, lane_uint material,
                                     uint axis, lane_float position) {
    const lane_float scale =
        LANES_GATHER_FLOAT(materials, material + (VXL_MATERIAL_CHECKER_SCALE + axis));
    const lane_float shift =
        LANES_GATHER_FLOAT(materials, material + (VXL_MATERIAL_CHECKER_SHIFT + axis));
    return LANES_INT(floor(fma(position, scale, shift)));
}

/// The index, in floats, of a material's colour at a point: its own colour or that of its checker.
static inline lane_uint color_offset(global const float* restrict materials, lane_uint material,
                                     lane_float x, lane_float y, lane_float z) {
    if (!VXL_CHECKER) return material;
    const lane_int block = checker_block(materials, material, 0u, x) +
                           checker_block(materials, material, 1u, y) +
                           checker_block(materials, material, 2u, z);
    return material + LANES_AS_UINT((block & 1) * VXL_MATERIAL_CHECKER_COLOR);
}

/// Where to find the own colours of a packet's surfaces.
typedef struct {
    global const uint* voxels;
    global const float* paint;  // of hits, where surfaces wear textures; otherwise null
    const lane_float* fresh;    // the paint, in the kernel that computes it; otherwise null
    lane_uint number;           // index of the voxels, or of the first floats of the hits' paint
} Colors;

/// The colours of the hits from `first` on, which are in these voxels.
static inline Colors colors_of_hits(global const uint* voxels, lane_uint voxel,
                                    global const float* paint, uint first) {
    const lane_uint hit =
        (first + LANES_AS_UINT((lane_int)LANES_NUMBERS)) * VXL_PAINT_FLOATS(VXL_TEXTURE_MAPS);
    const Colors colors = {voxels, paint, 0, VXL_TEXTURES ? hit : voxel};
    return colors;
}

/// The colours of voxels, for hits that have no paint.
static inline Colors colors_of_voxels(global const uint* voxels, lane_uint voxel) {
    const Colors colors = {voxels, 0, 0, voxel};
    return colors;
}

/// One of the values of paint, VXL_PAINT_*. A driver may read memory before the same kernel has
/// written it, so fresh values are taken from where they were computed.
static inline lane_float painted(Colors colors, uint value) {
    if (colors.fresh) return colors.fresh[value];
    return LANES_GATHER_FLOAT(colors.paint, colors.number + value);
}

/// A channel of voxels' own colours; 1 where the world has none.
static inline lane_float voxel_color(global const uint* restrict colors, lane_uint voxel,
                                     int channel) {
    if (!VXL_COLORS) return (lane_float)1.0f;
    return linear_channel(LANES_GATHER_UINT(colors, voxel), 8 * channel);
}

/// Voxels' own opacity; 1 where the world has none.
static inline lane_float voxel_opacity(global const uint* restrict colors, lane_uint voxel) {
    if (!VXL_VOXEL_OPACITY) return (lane_float)1.0f;
    const lane_uint transparency = LANES_GATHER_UINT(colors, voxel) >> VXL_TRANSPARENCY_SHIFT;
    return exact_divide(LANES_FLOAT(255u - transparency), (lane_float)255.0f);
}

/// The colour of a surface point: that of its material (see color_offset) times its own, which is
/// the voxel's or, in scenes with textures, the hit's. Colors has both.
static inline lane_float surface_color(global const float* restrict materials,
                                       lane_uint color_index, Colors colors, int channel) {
    lane_float color = LANES_GATHER_FLOAT(materials, color_index + (uint)channel);
    if (VXL_TEXTURES && colors.paint)
        color *= painted(colors, (uint)channel);
    else if (VXL_COLORS)
        color *= voxel_color(colors.voxels, colors.number, channel);
    return color;
}

/// A value of the material. Where maps may change it, the paint of hits holds it at index
/// `paint_index`.
static inline lane_float mapped_value(global const float* restrict materials, lane_uint value,
                                      Colors colors, uint paint_index) {
    if (VXL_TEXTURE_MAPS && colors.paint) return painted(colors, paint_index);
    return LANES_GATHER_FLOAT(materials, value);
}

/// The factor of a colourless share of light when `tint` of it takes on the surface's colour.
static inline lane_float tinted(lane_float color, lane_float tint) {
    return fma(tint, color - 1.0f, (lane_float)1.0f);
}

/// The part of the incoming light that a surface returns in all directions; in global light, this
/// is for surfaces that aren't physically based.
static inline lane_float surface_diffuse(global const float* restrict materials, lane_uint material,
                                         Colors colors) {
    if (VXL_GLOBAL) return LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_DIFFUSE);
    return mapped_value(materials, material + VXL_MATERIAL_DIFFUSE, colors, VXL_PAINT_DIFFUSE);
}

/// The share of what lies behind that a surface covers: its material's opacity times its own. This
/// is 1 in scenes without transmitting objects.
static inline lane_float surface_opacity(global const float* restrict materials, lane_uint material,
                                         Colors colors) {
    if (!VXL_TRANSMISSION) return (lane_float)1.0f;
    const lane_float opacity = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_OPACITY);
    if (VXL_TEXTURES && colors.paint) return opacity * painted(colors, VXL_PAINT_OPACITY);
    if (VXL_VOXEL_OPACITY) return opacity * voxel_opacity(colors.voxels, colors.number);
    return opacity;
}

/// Mask: light goes through or past surfaces of a material with this opacity.
static inline lane_int transmits(global const float* restrict materials, lane_uint material,
                                 lane_float opacity) {
    return LANE_MASK(opacity < 1.0f) |
           LANE_MASK(LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFRACTION) > 0.0f);
}

#endif
