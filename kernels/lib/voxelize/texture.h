// SPDX-License-Identifier: Apache-2.0
// The colour of a texture at a point: bilinear in linear light, on one level of the texture.
#ifndef VXL_TEXTURE_H
#define VXL_TEXTURE_H

#include "shared/texture.h"

/// Maps a coordinate, in texture widths, to where texels are: 0..1, or 0..2 where every other copy
/// is mirrored.
static inline float wrapped_coordinate(float at, uint wrap) {
    if (wrap == VXL_TEXTURE_WRAP_CLAMP) return clamp(at, 0.0f, 1.0f);
    if (wrap == VXL_TEXTURE_WRAP_MIRROR) return at - 2.0f * floor(0.5f * at);
    return at - floor(at);
}

/// The texel for an index from -1 to `size` or, for mirrored textures, to twice the size.
static inline int wrapped_texel(int at, int size, uint wrap) {
    if (wrap == VXL_TEXTURE_WRAP_REPEAT) return at < 0 ? at + size : at >= size ? at - size : at;
    if (wrap == VXL_TEXTURE_WRAP_MIRROR && at >= size) at = 2 * size - 1 - at;
    return clamp(at, 0, size - 1);
}

static inline float3 texel_color(uint texel, global const float* linear_levels) {
    return (float3)(linear_levels[texel & 255u], linear_levels[texel >> 8 & 255u],
                    linear_levels[texel >> 16 & 255u]);
}

/// The colour at a point on a level of a texture, given by its record in shared/texture.h.
static inline float3 texture_color(uint4 texture, uint level, global const uint* texels,
                                   global const float* linear_levels, float2 uv) {
    int2 size = convert_int2(texture.yz);
    uint first = texture.x;
    for (; level > 0u; --level) {
        first += (uint)size.x * (uint)size.y;
        size = max(size >> 1, (int2)(1));
    }
    const uint2 wrap = (uint2)(texture.w & 15u, texture.w >> VXL_TEXTURE_WRAP_V_SHIFT);
    const float2 at = (float2)(wrapped_coordinate(uv.x, wrap.x) * (float)size.x - 0.5f,
                               wrapped_coordinate(uv.y, wrap.y) * (float)size.y - 0.5f);
    const float2 low = floor(at), part = at - low;
    const int2 from = convert_int2(low);
    const int x0 = wrapped_texel(from.x, size.x, wrap.x);
    const int x1 = wrapped_texel(from.x + 1, size.x, wrap.x);
    const int y0 = wrapped_texel(from.y, size.y, wrap.y) * size.x;
    const int y1 = wrapped_texel(from.y + 1, size.y, wrap.y) * size.x;
    const float3 upper =
        texel_color(texels[first + (uint)(y0 + x0)], linear_levels) * (1.0f - part.x) +
        texel_color(texels[first + (uint)(y0 + x1)], linear_levels) * part.x;
    const float3 lower =
        texel_color(texels[first + (uint)(y1 + x0)], linear_levels) * (1.0f - part.x) +
        texel_color(texels[first + (uint)(y1 + x1)], linear_levels) * part.x;
    return upper * (1.0f - part.y) + lower * part.y;
}

#endif
