// SPDX-License-Identifier: Apache-2.0
// The layers of physically based surfaces whose roughness and metalness maps change them: their
// tables are interpolated between those of two roughnesses.
#ifndef VXL_MAPPED_LAYERS_H
#define VXL_MAPPED_LAYERS_H

#include "lib/light/facet_albedo.h"
#include "lib/surface/surface_color.h"

/// The layers as a material, or its maps, define them.
typedef struct {
    lane_int mapped;  // mask: maps change the material
    lane_float metallic, width;
    lane_float missing, by_angle;  // means of what facets return
} Layers;

/// Finds the layers of materials, and the tables of those that maps change.
static inline Layers layers_of(global const float* restrict materials, lane_uint material,
                               Colors colors, FacetTable* facets) {
    Layers l;
    l.mapped = (lane_int)0;
    l.metallic = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_METALLIC);
    l.width = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_WIDTH);
    l.missing = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_MISSING);
    l.by_angle = (lane_float)0.0f;
    facets->next = facets->first;
    facets->part = (lane_float)0.0f;
    if (!VXL_TEXTURE_MAPS || !colors.paint) return l;
    const lane_float means_index = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_MAPPED);
    l.mapped = LANE_MASK(means_index > 1.0f);
    if (!lanes_any(l.mapped)) return l;
    const lane_float rough = painted(colors, VXL_PAINT_ROUGHNESS);
    const lane_float at = clamp(rough, 0.0f, 1.0f) * (float)(VXL_ROUGHNESS_STEPS - 1);
    const lane_uint step = min(LANES_UINT(at), (lane_uint)(VXL_ROUGHNESS_STEPS - 2));
    const lane_float part = at - LANES_FLOAT(step);
    const lane_uint means = LANES_UINT(means_index) & LANES_AS_UINT(l.mapped);
    lane_float mean[2];
    for (uint i = 0; i < 2; ++i) {
        const lane_float low = LANES_GATHER_FLOAT(materials, means + 2u * step + i);
        const lane_float high = LANES_GATHER_FLOAT(materials, means + 2u * step + (2u + i));
        mean[i] = fma(part, high - low, low);
    }
    const uint floats = VXL_ALBEDO_ENTRIES * VXL_ALBEDO_FLOATS;
    const lane_uint table = means + 2u * VXL_ROUGHNESS_STEPS + step * floats;
    facets->first = LANES_SELECT(l.mapped, table, facets->first);
    facets->next = LANES_SELECT(l.mapped, table + floats, facets->next);
    facets->part = LANES_SELECT(l.mapped, part, facets->part);
    l.missing = LANES_SELECT(l.mapped, mean[0], l.missing);
    l.by_angle = mean[1];
    l.width = LANES_SELECT(l.mapped, fmax(rough * rough, (lane_float)(1.0f / 1024.0f)), l.width);
    l.metallic = LANES_SELECT(l.mapped, painted(colors, VXL_PAINT_METALLIC), l.metallic);
    return l;
}

#endif
