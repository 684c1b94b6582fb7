// SPDX-License-Identifier: Apache-2.0
// The mean of a texture over the area that a sample sees: bilinear values on the level of the
// texture that is fine enough for the area's narrow side.
#ifndef VXL_TEXTURE_MEAN_H
#define VXL_TEXTURE_MEAN_H

#include "lib/lanes/exact_float.h"
#include "shared/texture.h"

// The narrow side of an area covers VXL_FINE_TEXELS to twice as many texels of its level, and the
// long side at most VXL_LONG_TEXELS.
#define VXL_FINE_TEXELS 2.0f
#define VXL_LONG_TEXELS 16.0f
// Samples lie at most half a texel apart.
#define VXL_SAMPLES_PER_TEXEL 2.0f

/// A level of each lane's texture.
typedef struct {
    global const uint* restrict textures;
    lane_uint first;  // index of its first texel
    lane_int width, height;
    lane_uint wrap_u, wrap_v;
    lane_uint alpha;  // VXL_ALPHA_*
    bool is_data;     // its channels are numbers from 0 to 1 instead of a colour in sRGB
} TextureLevel;

/// The area of a texture that a sample sees, in texture widths: around a point, from -1/2 to 1/2
/// along each of two sides. The area's middle lies at `off` from the point, in these sides. Where a
/// surface leans away from the observer, a point a side_0 + b side_1 is seen at (a, b) times 1 + a
/// lean_0 + b lean_1.
typedef struct {
    lane_float u, v;
    lane_float side_u[2], side_v[2];
    lane_float off[2], lean[2];
} TextureArea;

/// The first level of the textures that begin at `first_word`; one harmless texel for lanes outside
/// `wears`.
static inline TextureLevel first_level(global const uint* restrict textures, lane_uint first_word,
                                       lane_int wears) {
    TextureLevel t;
    first_word &= LANES_AS_UINT(wears);
    t.textures = textures;
    t.width = LANES_AS_INT(LANES_GATHER_UINT(textures, first_word));
    t.height = LANES_AS_INT(LANES_GATHER_UINT(textures, first_word + 1u));
    t.width = LANES_SELECT(wears, t.width, (lane_int)1);
    t.height = LANES_SELECT(wears, t.height, (lane_int)1);
    const lane_uint wrap = LANES_GATHER_UINT(textures, first_word + 2u) & LANES_AS_UINT(wears);
    t.wrap_u = wrap & VXL_TEXTURE_WRAP_MASK;
    t.wrap_v = wrap >> VXL_TEXTURE_WRAP_V_SHIFT & VXL_TEXTURE_WRAP_MASK;
    t.is_data = false;
    t.alpha = (lane_uint)VXL_ALPHA_OPAQUE;
    if (VXL_TEXTURE_ALPHA)
        t.alpha = LANES_GATHER_UINT(textures, first_word + 3u) & LANES_AS_UINT(wears);
    t.first = first_word + (uint)VXL_TEXTURE_HEAD;
    return t;
}

/// Moves to a level that is `level` steps coarser; a level of one texel is the last.
static inline void go_to_level(TextureLevel* t, lane_int level) {
    lane_int on = LANE_MASK(level > 0) & (LANE_MASK(t->width > 1) | LANE_MASK(t->height > 1));
    while (lanes_any(on)) {
        t->first += LANES_AS_UINT(t->width * t->height & on);
        t->width = LANES_SELECT(on, max(t->width >> 1, 1), t->width);
        t->height = LANES_SELECT(on, max(t->height >> 1, 1), t->height);
        level -= 1;
        on = LANE_MASK(level > 0) & (LANE_MASK(t->width > 1) | LANE_MASK(t->height > 1));
    }
}

/// Maps a coordinate, in texture widths, to where texels are: 0..1, or 0..2 where every other copy
/// is mirrored.
static inline lane_float texel_coordinate(lane_float at, lane_uint wrap) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const lane_int mirrors = LANE_MASK(wrap == VXL_TEXTURE_WRAP_MIRROR);
    const lane_float period = LANES_SELECT(mirrors, one * 2.0f, one);
    const lane_float inverse = LANES_SELECT(mirrors, one * 0.5f, one);
    lane_float coordinate = at - period * floor(at * inverse);
    const lane_int clamps = LANE_MASK(wrap == VXL_TEXTURE_WRAP_CLAMP);
    coordinate = LANES_SELECT(clamps, clamp(at, 0.0f, 1.0f), coordinate);
    // Rounding may reach the end, and NaN has no position.
    return LANES_SELECT(LANE_MASK(coordinate >= 0.0f) & LANE_MASK(coordinate <= period), coordinate,
                        zero);
}

/// The texel for an index from -1 to `size` or, for mirrored textures, to twice the size.
static inline lane_int texel_number(lane_int at, lane_int size, lane_uint wrap) {
    const lane_int repeats = LANE_MASK(wrap == VXL_TEXTURE_WRAP_REPEAT);
    const lane_int mirrors = LANE_MASK(wrap == VXL_TEXTURE_WRAP_MIRROR);
    at = LANES_SELECT(repeats & LANE_MASK(at < 0), at + size, at);
    at = LANES_SELECT(repeats & LANE_MASK(at >= size), at - size, at);
    at = LANES_SELECT(mirrors & LANE_MASK(at >= size), 2 * size - 1 - at, at);
    return clamp(at, (lane_int)0, size - 1);
}

/// Adds a texel's three channels, times `weight`: in linear light for colours, as they are for
/// data. Where alpha counts, the weight is multiplied by the texel's alpha first, and is added to
/// sum[3].
static inline void add_texel(const TextureLevel* t, lane_int x, lane_int y, lane_float weight,
                             lane_float* sum) {
    const lane_uint texel =
        LANES_GATHER_UINT(t->textures, t->first + LANES_AS_UINT(y * t->width + x));
    global const float* curve = (global const float*)t->textures;
    if (VXL_TEXTURE_ALPHA) {
        const lane_float alpha = LANES_FLOAT(texel >> 24) * (1.0f / 255.0f);
        weight *= LANES_SELECT(LANE_MASK(t->alpha != VXL_ALPHA_OPAQUE), alpha, (lane_float)1.0f);
        sum[3] += weight;
    }
    for (int c = 0; c < 3; ++c) {
        const lane_uint code = (texel >> (uint)(8 * c)) & 255u;
        const lane_float value =
            t->is_data ? LANES_FLOAT(code) * (1.0f / 255.0f) : LANES_GATHER_FLOAT(curve, code);
        sum[c] = fma(value, weight, sum[c]);
    }
}

/// Adds the bilinear value at a point, times `weight`. With a minimum alpha, the value counts fully
/// if its alpha reaches the minimum, and otherwise not at all.
static inline void add_texture(const TextureLevel* t, lane_float u, lane_float v, lane_float weight,
                               lane_float* sum) {
    const lane_float x = fma(texel_coordinate(u, t->wrap_u), LANES_FLOAT(t->width), -0.5f);
    const lane_float y = fma(texel_coordinate(v, t->wrap_v), LANES_FLOAT(t->height), -0.5f);
    const lane_float low_x = floor(x), low_y = floor(y);
    const lane_float part_x = x - low_x, part_y = y - low_y;
    const lane_int from_x = LANES_INT(low_x), from_y = LANES_INT(low_y);
    const lane_int x0 = texel_number(from_x, t->width, t->wrap_u);
    const lane_int x1 = texel_number(from_x + 1, t->width, t->wrap_u);
    const lane_int y0 = texel_number(from_y, t->height, t->wrap_v);
    const lane_int y1 = texel_number(from_y + 1, t->height, t->wrap_v);
    const lane_float full = VXL_TEXTURE_ALPHA ? (lane_float)1.0f : weight;
    const lane_float upper = (1.0f - part_y) * full, lower = part_y * full;
    const lane_float zero = (lane_float)0.0f;
    lane_float own[4] = {zero, zero, zero, zero};
    lane_float* to = VXL_TEXTURE_ALPHA ? own : sum;
    add_texel(t, x0, y0, (1.0f - part_x) * upper, to);
    add_texel(t, x1, y0, part_x * upper, to);
    add_texel(t, x0, y1, (1.0f - part_x) * lower, to);
    add_texel(t, x1, y1, part_x * lower, to);
    if (!VXL_TEXTURE_ALPHA) return;
    const lane_int has_min = LANE_MASK(t->alpha < VXL_ALPHA_BLEND) & LANE_MASK(t->alpha > 0u);
    const lane_int is_there = LANE_MASK(own[3] * 255.0f >= LANES_FLOAT(t->alpha));
    const lane_int some = LANE_MASK(own[3] > 0.0f);
    const lane_float whole = exact_reciprocal(LANES_SELECT(some, own[3], (lane_float)1.0f));
    const lane_float as_mask = LANES_SELECT(is_there & some, whole, zero);
    const lane_float scale = weight * LANES_SELECT(has_min, as_mask, (lane_float)1.0f);
    for (int c = 0; c < 4; ++c) sum[c] = fma(own[c], scale, sum[c]);
}

/// The integer part of the logarithm to base 2 of a number of at least 1; 0 for smaller ones.
static inline lane_int floor_log2(lane_float v) {
    const lane_float from_one = clamp(v, 1.0f, 1048576.0f);
    return (LANES_AS_INT(from_one) >> 23) - 127;
}

/// Sets `mean` to the mean of the textures that begin at `first_word` over `area`, as texture_mean
/// does. With `is_data`, the channels are numbers instead of a colour in sRGB.
static inline void mean_over(global const uint* restrict textures, lane_uint first_word,
                             const TextureArea* area, lane_int wears, bool is_data,
                             lane_float* mean) {
    TextureLevel t = first_level(textures, first_word, wears);
    t.is_data = is_data;
    const lane_float w = LANES_FLOAT(t.width), h = LANES_FLOAT(t.height);
    lane_float length[2];
    for (int i = 0; i < 2; ++i) {
        const lane_float x = area->side_u[i] * w, y = area->side_v[i] * h;
        length[i] = exact_sqrt(fma(x, x, y * y));
    }
    const lane_float cross =
        fabs(area->side_u[0] * area->side_v[1] - area->side_u[1] * area->side_v[0]) * w * h;
    const lane_float long_side = fmax(length[0], length[1]);
    const lane_int some = LANE_MASK(long_side > 0.0f) & LANE_MASK(long_side < 1e18f) & wears;
    const lane_float narrow = exact_divide(cross, LANES_SELECT(some, long_side, (lane_float)1.0f));
    const lane_int level =
        floor_log2(fmax(narrow * (1.0f / VXL_FINE_TEXELS), long_side * (1.0f / VXL_LONG_TEXELS)));
    go_to_level(&t, level & some);
    const lane_float scale = LANES_AS_FLOAT((127 - level) << 23) * VXL_SAMPLES_PER_TEXEL;
    lane_float count[2], step[2];
    for (int i = 0; i < 2; ++i) {
        const float max_count = VXL_LONG_TEXELS * VXL_SAMPLES_PER_TEXEL * 2.0f;
        count[i] = clamp(ceil(length[i] * scale), 1.0f, max_count);
        count[i] = LANES_SELECT(some, count[i], (lane_float)1.0f);
        step[i] = exact_reciprocal(count[i]);
    }
    const lane_float weight = step[0] * step[1];
    for (int c = 0; c < 4; ++c) mean[c] = (lane_float)0.0f;
    lane_float j = (lane_float)0.5f;
    lane_int in_row = wears;
    while (lanes_any(in_row)) {
        const lane_float b = fma(j, step[1], area->off[1] - 0.5f);
        lane_float i = (lane_float)0.5f;
        lane_int in = in_row;
        while (lanes_any(in)) {
            const lane_float a = fma(i, step[0], area->off[0] - 0.5f);
            const lane_float lean = fma(a, area->lean[0], fma(b, area->lean[1], (lane_float)1.0f));
            const lane_float s = exact_reciprocal(clamp(lean, 0.25f, 4.0f));
            const lane_float u = fma(a * s, area->side_u[0], fma(b * s, area->side_u[1], area->u));
            const lane_float v = fma(a * s, area->side_v[0], fma(b * s, area->side_v[1], area->v));
            add_texture(&t, u, v, LANES_SELECT(in, weight, (lane_float)0.0f), mean);
            i += 1.0f;
            in &= LANE_MASK(i < count[0]);
        }
        j += 1.0f;
        in_row &= LANE_MASK(j < count[1]);
    }
    if (!VXL_TEXTURE_ALPHA) return;
    const lane_int covers = LANE_MASK(mean[3] > 0.0f);
    const lane_float whole = exact_reciprocal(LANES_SELECT(covers, mean[3], (lane_float)1.0f));
    for (int c = 0; c < 3; ++c) mean[c] *= whole;
    mean[3] = clamp(mean[3], 0.0f, 1.0f);
    // A coverage of 1, except for rounding, is opaque.
    mean[3] = LANES_SELECT(LANE_MASK(mean[3] > 0.99999f), (lane_float)1.0f, mean[3]);
}

/// Sets `mean` to the mean colour of the textures that begin at `first_word` over `area`. Where
/// alpha counts, mean[3] is the share of the area that they cover, and the colour is that of the
/// covered part. `wears` is the mask of lanes with a texture.
static inline void texture_mean(global const uint* restrict textures, lane_uint first_word,
                                const TextureArea* area, lane_int wears, lane_float* mean) {
    mean_over(textures, first_word, area, wears, false, mean);
}

#endif
