// SPDX-License-Identifier: Apache-2.0
// The light of a source that physically based surfaces return.
#ifndef VXL_PHYSICAL_LIGHT_H
#define VXL_PHYSICAL_LIGHT_H

#include "lib/light/lit_points.h"
#include "lib/light/physical.h"
#include "lib/surface/shading_normal.h"
#include "shared/scene.h"

/// The weight of a light with an area for a ray that was sent to it, where rays that surfaces
/// scatter find the same light with this density of directions: the balance heuristic (Veach &
/// Guibas 1995), for points of the `area` that are equally probable.
static inline lane_float sent_weight(lane_float density, lane_float falloff, lane_float area) {
    const lane_float likelier = fmin(density * falloff * area, 1e30f);
    return exact_reciprocal(likelier + 1.0f);
}

/// Mask: directions in which the points' surfaces scatter paths.
static inline lane_int scatters_to(const LitPoints* p, Vector direction) {
    lane_float lowest = (lane_float)0.0f;
    if (VXL_SHADING_NORMALS)
        lowest = LANES_SELECT(are_different(p->shading_normal, p->normal),
                              (lane_float)VXL_MIN_COSINE, lowest);
    return LANE_MASK(dot_product(p->normal, direction) >= lowest);
}

/// Sets the light that the physically based ones among the points return towards the viewer.
/// Returns the mask of points, of all kinds, that return any. Paths may also run into `area` square
/// metres of the light.
static inline lane_int find_physical_contributions(const Light* light, const Incidence* i,
                                                   lane_float area, const LitPoints* p, Vector d,
                                                   float4 edge,
                                                   global const float* restrict materials,
                                                   lane_int some, lane_float* contribution) {
    const Vector way = unit(scaled(d, edge));
    Vector normal = p->normal;
    if (VXL_SHADING_NORMALS)
        normal = select_vector(are_different(p->shading_normal, normal),
                               reflecting_normal(way, normal, p->shading_normal), normal);
    const lane_uint color =
        color_offset(materials, p->material, p->position.x, p->position.y, p->position.z);
    const PhysicalView view = view_physical(materials, p->lit, p->material, color, p->colors,
                                            normal, opposite(way), p->leaving);
    if (!lanes_any(view.is)) return some;
    lane_float value[3], density;
    const lane_int above = physical_value(&view, i->l, value, &density);
    lane_float falloff = i->falloff * surface_opacity(materials, p->material, p->colors);
    if (VXL_AREA_SHARES)
        falloff *= sent_weight(LANES_SELECT(scatters_to(p, i->l), density, (lane_float)0.0f),
                               i->falloff, area);
    lane_int any_contribution = (lane_int)0;
    for (int c = 0; c < 3; ++c) {
        const lane_float own = value[c] * falloff * light->intensity[c];
        contribution[c] = LANES_SELECT(view.is, own, contribution[c]);
        any_contribution |= LANE_MASK(own > 0.0f);
    }
    return LANES_SELECT(view.is, above & any_contribution, some);
}

#endif
