// SPDX-License-Identifier: Apache-2.0
// The maps of textures where rays meet triangles: the material's roughness, metalness and emission.
#ifndef VXL_TEXTURE_MAPS_H
#define VXL_TEXTURE_MAPS_H

#include "lib/lanes/exact_float.h"
#include "lib/surface/texture_mean.h"
#include "shared/scene.h"
#include "shared/texture.h"

/// The factors by which maps multiply a material's values; 1 where there is no map.
typedef struct {
    lane_float roughness, metallic, emission[3];
} MapValues;

static inline MapValues no_map_values(void) {
    const lane_float one = (lane_float)1.0f;
    const MapValues m = {one, one, {one, one, one}};
    return m;
}

/// Sets `mean` to the mean over `area` of map number `map` of the textures that begin at
/// `first_word`. Returns the mask of lanes that have this map.
static inline lane_int map_mean(global const uint* restrict textures, lane_uint first_word,
                                uint map, const TextureArea* area, lane_int wears,
                                lane_float* mean) {
    const lane_uint wrap = LANES_GATHER_UINT(textures, (first_word & LANES_AS_UINT(wears)) + 2u);
    lane_int has = wears & LANE_MASK((wrap & VXL_TEXTURE_HAS_MAPS) != 0u);
    if (!lanes_any(has)) return has;
    const lane_uint record =
        (first_word - (VXL_MAP_COUNT - map) * VXL_MAP_WORDS) & LANES_AS_UINT(has);
    const lane_uint offset = LANES_GATHER_UINT(textures, record + VXL_MAP_OFFSET);
    has &= LANE_MASK(offset != 0u);
    if (!lanes_any(has)) return has;
    global const float* floats = (global const float*)textures;
    lane_float m[6];
    for (uint i = 0; i < 6; ++i)
        m[i] = LANES_GATHER_FLOAT(floats, record + (VXL_MAP_TRANSFORM + i));
    TextureArea own = *area;
    own.u = fma(m[0], area->u, fma(m[1], area->v, m[2]));
    own.v = fma(m[3], area->u, fma(m[4], area->v, m[5]));
    for (int i = 0; i < 2; ++i) {
        own.side_u[i] = fma(m[0], area->side_u[i], m[1] * area->side_v[i]);
        own.side_v[i] = fma(m[3], area->side_u[i], m[4] * area->side_v[i]);
    }
    mean_over(textures, first_word + offset, &own, has, map == VXL_MAP_GLOSS, mean);
    return has;
}

/// Sets the values of the maps of the textures that begin at `first_word`, over `area`.
static inline void set_maps(global const uint* restrict textures, lane_uint first_word,
                            const TextureArea* area, lane_int wears, MapValues* m) {
    lane_float mean[4];
    const lane_int gloss = map_mean(textures, first_word, VXL_MAP_GLOSS, area, wears, mean);
    if (lanes_any(gloss)) {
        m->roughness = LANES_SELECT(gloss, mean[1], m->roughness);
        m->metallic = LANES_SELECT(gloss, mean[2], m->metallic);
    }
    const lane_int is_emissive =
        map_mean(textures, first_word, VXL_MAP_EMISSION, area, wears, mean);
    if (lanes_any(is_emissive))
        for (int c = 0; c < 3; ++c)
            m->emission[c] = LANES_SELECT(is_emissive, mean[c], m->emission[c]);
}

/// The number of values behind VXL_PAINT_WIDTH.
#define VXL_MAPPED_VALUES (VXL_PAINT_FLOATS(1) - VXL_PAINT_WIDTH - 1)

/// The values of materials behind VXL_PAINT_WIDTH, as maps change them. Local light shows them in
/// Whitted's model, by the formulas of whitted_material().
static inline void map_material(global const float* restrict materials, lane_uint material,
                                const MapValues* m, lane_float* values) {
    lane_float metallic = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_METALLIC);
    lane_float rough = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_WIDTH);
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    if (VXL_GLOBAL) {
        const lane_int takes =
            LANE_MASK(LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_MAPPED) > 1.0f);
        rough = exact_sqrt(rough);
        values[0] = LANES_SELECT(takes, rough * m->roughness, rough);
        values[1] = LANES_SELECT(takes, metallic * m->metallic, metallic);
        for (int i = 2; i < VXL_MAPPED_VALUES; ++i) values[i] = zero;
        return;
    }
    const lane_int takes = LANE_MASK(rough > 0.0f);
    metallic *= m->metallic;
    rough *= m->roughness;
    const lane_float clear = one - rough, smooth = clear * clear;
    const lane_float glint =
        0.2f * LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFLECTANCE);
    const lane_float width = fmax(rough * rough, (lane_float)0.04f);
    const lane_float shininess = clamp(
        fma((lane_float)2.0f, exact_reciprocal(width * width), (lane_float)-2.0f), 2.0f, 1000.0f);
    const lane_float shine = fma((lane_float)-0.4f, rough, one);
    const lane_float spread =
        fmax(one - smooth - shine * 8.0f * exact_reciprocal(shininess + 7.6f), (lane_float)0.0f);
    const lane_float of_metal = metallic * shine;
    const lane_float specular = fma(glint * (one - metallic), clear, of_metal);
    const lane_int shines = LANE_MASK(specular > 0.0f);
    const lane_float own[VXL_MAPPED_VALUES] = {
        fma(metallic, spread - one, one),
        specular,
        shininess,
        metallic * smooth,
        exact_divide(of_metal, LANES_SELECT(shines, specular, one)),
        one};
    const uint indices[VXL_MAPPED_VALUES] = {VXL_MATERIAL_DIFFUSE,        VXL_MATERIAL_SPECULAR,
                                             VXL_MATERIAL_SHININESS,      VXL_MATERIAL_REFLECTION,
                                             VXL_MATERIAL_HIGHLIGHT_TINT, VXL_MATERIAL_MIRROR_TINT};
    for (int i = 0; i < VXL_MAPPED_VALUES; ++i)
        values[i] =
            LANES_SELECT(takes, own[i], LANES_GATHER_FLOAT(materials, material + indices[i]));
}

#endif
