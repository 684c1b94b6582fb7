// SPDX-License-Identifier: Apache-2.0
// Rough surfaces that let light through: facets of GGX's distribution that reflect and refract by
// Fresnel's law (Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces").
//
// Light that facets don't return at once, on either side, returns or passes through in all
// directions, so that none is lost and the distribution is reciprocal (Kulla & Conty 2017).
// Radiance isn't scaled by the square of the index of refraction: a path that leaves the glass
// again undoes the scaling.
#ifndef VXL_ROUGH_GLASS_H
#define VXL_ROUGH_GLASS_H

#include "lib/light/ggx.h"
#include "lib/light/optics.h"
#include "shared/scene.h"

/// The glass of surfaces, seen along a direction from one of its sides.
typedef struct {
    lane_float share;        // of the surface; 0: it isn't glass
    lane_float eta;          // index of refraction before the surface over the one behind it
    lane_float missing;      // the share of light that facets don't return at once, at this angle
    lane_float per_missing;  // 1 over the mean of `missing` on the viewer's side ...
    lane_float per_missing_behind;  // ... and on the other side
    lane_float back;                // the part of `missing` that returns
    lane_uint here, behind;         // indices of the first values of the two sides' tables
    global const float* restrict materials;
} GlassView;

/// The missing share of a side at an angle, from the side's table.
static inline lane_float glass_missing(const GlassView* g, lane_uint side, lane_float cosine,
                                       lane_float width) {
    const lane_float by_width = exact_divide(cosine * (1.0f + width), cosine + width);
    const lane_float table_index =
        (exact_sqrt(by_width) + cosine) * (0.5f * (float)(VXL_GLASS_ENTRIES - 1));
    const lane_uint entry = min(LANES_UINT(table_index), (lane_uint)(VXL_GLASS_ENTRIES - 2));
    const lane_uint first = side + entry * 2u;
    const lane_float low = LANES_GATHER_FLOAT(g->materials, first);
    const lane_float high = LANES_GATHER_FLOAT(g->materials, first + 2u);
    return fma(table_index - LANES_FLOAT(entry), high - low, low);
}

/// The glass of `material`, whose surfaces are met from inside by the `leaving` lanes.
static inline GlassView view_glass(global const float* restrict materials, lane_int is,
                                   lane_uint material, lane_int leaving, lane_float cosine,
                                   lane_float width) {
    const lane_float one = (lane_float)1.0f;
    GlassView g;
    g.materials = materials;
    const lane_uint block =
        LANES_UINT(LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_GLASS)) &
        LANES_AS_UINT(is);
    const lane_int some = is & LANE_MASK(block > 0u);
    g.share = LANES_SELECT(some, LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFRACTION),
                           (lane_float)0.0f);
    const lane_float ior =
        LANES_SELECT(some, LANES_GATHER_FLOAT(materials, block + VXL_GLASS_IOR), (lane_float)1.5f);
    g.eta = LANES_SELECT(leaving, ior, exact_reciprocal(ior));
    const lane_uint inside = LANES_AS_UINT(leaving) & 1u;
    g.here = block + VXL_GLASS_TABLE + inside;
    g.behind = block + VXL_GLASS_TABLE + (1u - inside);
    g.back = LANES_GATHER_FLOAT(materials, block + VXL_GLASS_BACK + inside);
    g.per_missing = LANES_GATHER_FLOAT(materials, block + VXL_GLASS_PER_MISSING + inside);
    g.per_missing_behind =
        LANES_GATHER_FLOAT(materials, block + VXL_GLASS_PER_MISSING + (1u - inside));
    const lane_float w = LANES_SELECT(some, width, one);
    g.missing = LANES_SELECT(some, glass_missing(&g, g.here, cosine, w), (lane_float)0.0f);
    return g;
}

/// The light from above, at a cosine, that glass returns. `lobe` is pi times the distribution of
/// white facets, which light meets at an angle of cosine `meets`; `mirrored` is the density of
/// directions that facets mirror. Sets `density` to the probability with which paths go there.
static inline lane_float glass_value(const GlassView* g, lane_float width, lane_float cosine,
                                     lane_float lobe, lane_float meets, lane_float mirrored,
                                     lane_float* density) {
    const lane_float reflected = refraction_at(g->eta, meets).reflected;
    const lane_float later = g->missing * g->back * g->per_missing;
    const lane_float missing = glass_missing(g, g->here, cosine, width);
    *density = fma((1.0f - g->missing) * reflected, mirrored,
                   g->missing * g->back * cosine * 0.318309886f);
    return fma(lobe, reflected, later * missing * cosine);
}

/// Pi times the distribution of the light from `in`, on the other side, that glass lets through,
/// times the cosine there. Sets `density` to the probability with which paths go there. Directions
/// are in the surface's frame.
static inline lane_float glass_through(const GlassView* g, lane_float width, Vector out, Vector in,
                                       lane_float* density) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const lane_int below = LANE_MASK(in.z < 0.0f);
    const lane_float cosine = LANES_SELECT(below, fmin(-in.z, one), one);
    Vector h = {fma(g->eta, out.x, in.x), fma(g->eta, out.y, in.y), fma(g->eta, out.z, in.z)};
    h = unit(select_vector(LANE_MASK(h.z < 0.0f), opposite(h), h));
    const lane_float meets = dot_product(h, out), leaves = -dot_product(h, in);
    const lane_int met = below & LANE_MASK(meets > 0.0f) & LANE_MASK(leaves > 0.0f);
    const Refraction bend = refraction_at(g->eta, clamp(meets, 0.0f, 1.0f));
    const lane_float root = fma(g->eta, meets, -leaves);
    const lane_int some = met & ~bend.total & LANE_MASK(root != 0.0f);
    const lane_float k_out = stretched_length(out, width), k_in = stretched_length(in, width);
    const lane_float seen = out.z + k_out;
    const lane_float facets = facet_density(h, width);
    const lane_float safe = LANES_SELECT(some, root * root * seen, one);
    const lane_float bent = LANES_SELECT(
        some, exact_divide(2.0f * facets * meets * leaves * bend.refracted, safe), zero);
    const lane_float unhidden =
        exact_divide(2.0f * cosine, LANES_SELECT(below, cosine + k_in, one));
    const lane_float later =
        g->missing * (one - g->back) * glass_missing(g, g->behind, cosine, width);
    *density = LANES_SELECT(
        below, fma(one - g->missing, bent, g->missing * (one - g->back) * cosine * 0.318309886f),
        zero);
    const lane_float value =
        fma(3.14159265f * bent, unhidden, later * g->per_missing_behind * cosine);
    return LANES_SELECT(below, value, zero);
}

/// Directions in which paths continue from glass. `choice` decides between facets and the rest, and
/// between reflection and refraction. `down` becomes the mask of paths that are meant to pass
/// through the glass; facets may send them to the wrong side, where their light is lost.
static inline Vector glass_direction(const GlassView* g, lane_float width, Vector out,
                                     SquarePoint at, lane_float choice, lane_int* down) {
    const lane_float one = (lane_float)1.0f;
    const lane_float at_once = one - g->missing;
    const lane_int by_facet = LANE_MASK(choice < at_once);
    const lane_float of_facet = exact_divide(choice, fmax(at_once, 1e-6f));
    const lane_float of_rest = exact_divide(choice - at_once, fmax(g->missing, 1e-6f));
    const Vector h = visible_facet(out, width, at);
    const lane_float meets = clamp(dot_product(out, h), 0.0f, 1.0f);
    const Refraction bend = refraction_at(g->eta, meets);
    const lane_float twice = 2.0f * meets;
    const Vector mirrored = {fma(twice, h.x, -out.x), fma(twice, h.y, -out.y),
                             fma(twice, h.z, -out.z)};
    const Vector bent = refracted_direction(opposite(out), h, g->eta, meets, &bend);
    const SquarePoint d = disk_point(at);
    const lane_float up = exact_sqrt(1.0f - at.x);
    const lane_int even_back = LANE_MASK(of_rest < g->back);
    const lane_int facet_back = LANE_MASK(of_facet < bend.reflected);
    const Vector even = {d.x, d.y, LANES_SELECT(even_back, up, -up)};
    const Vector facet = select_vector(facet_back, mirrored, bent);
    *down = ~LANES_SELECT(by_facet, facet_back, even_back);
    return select_vector(by_facet, facet, even);
}

#endif
