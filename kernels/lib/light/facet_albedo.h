// SPDX-License-Identifier: Apache-2.0
// The light that rough facets return, from tables over the angle: see VXL_ALBEDO_ENTRIES.
#ifndef VXL_FACET_ALBEDO_H
#define VXL_FACET_ALBEDO_H

#include "lib/lanes/vector.h"
#include "shared/scene.h"

/// The tables of surfaces' facets.
typedef struct {
    global const float* restrict materials;
    lane_uint first;   // the index of the first value
    lane_float width;  // of highlights, above 0
    // Where textures have maps: the table of the next roughness, and its weight.
    lane_uint next;
    lane_float part;
} FacetTable;

/// What facets return at an angle: `all` is the share returned at once if they reflect all light,
/// `by_angle` the share if they reflect the part (1 - m)^5; `missing` is the share that they miss,
/// which is returned later; `entered` is the share that reaches them.
typedef struct {
    lane_float all, by_angle, missing, entered;
} Albedo;

/// One number of an entry, interpolated: entries have `rows` numbers, and `at` is 0 at the first
/// entry, 1 at the last.
static inline lane_float between_entries(global const float* restrict materials, lane_uint values,
                                         uint rows, uint row, lane_float at) {
    const lane_float table_index = at * (float)(VXL_ALBEDO_ENTRIES - 1);
    const lane_uint entry = min(LANES_UINT(table_index), (lane_uint)(VXL_ALBEDO_ENTRIES - 2));
    const lane_uint first = values + entry * rows + row;
    const lane_float low = LANES_GATHER_FLOAT(materials, first);
    const lane_float high = LANES_GATHER_FLOAT(materials, first + rows);
    return fma(table_index - LANES_FLOAT(entry), high - low, low);
}

/// One of the VXL_ALBEDO_FLOATS numbers, interpolated between the two tables.
static inline lane_float between_tables(const FacetTable* t, uint row, lane_float at) {
    const lane_float low = between_entries(t->materials, t->first, VXL_ALBEDO_FLOATS, row, at);
    if (!VXL_TEXTURE_MAPS) return low;
    const lane_float high = between_entries(t->materials, t->next, VXL_ALBEDO_FLOATS, row, at);
    return fma(t->part, high - low, low);
}

/// What facets return if all light reaches them.
static inline Albedo albedo_at(const FacetTable* t, lane_float cosine) {
    const lane_float by_width = exact_divide(cosine * (1.0f + t->width), cosine + t->width);
    Albedo a;
    a.missing = between_tables(t, VXL_ALBEDO_MISSING, exact_sqrt(by_width));
    a.all = 1.0f - a.missing;
    a.by_angle = a.all * between_tables(t, VXL_ALBEDO_BY_ANGLE, exact_sqrt(cosine));
    a.entered = (lane_float)1.0f;
    return a;
}

/// The share that facets return at once if they reflect `reflectance` at normal incidence and
/// `grazing` at grazing angles.
static inline lane_float at_once(const Albedo* a, lane_float reflectance, lane_float grazing) {
    return fma(reflectance, a->all - a->by_angle, grazing * a->by_angle);
}

#endif
