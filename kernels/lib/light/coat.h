// SPDX-License-Identifier: Apache-2.0
// The clear coat of physically based surfaces: facets with their own width, through which light
// reaches what is below and returns.
//
// A coat lets through one share of the light along the direction in which light comes, and another
// along that in which it leaves. Light that the facets below return at once is multiplied by the
// smaller of the two shares: what a polished coat reflects back to a mirror leaves the same way
// later. The rest is distributed by the rules for light that facets miss, so that none is lost and
// the reflectance is reciprocal.
#ifndef VXL_COAT_H
#define VXL_COAT_H

#include "lib/light/facet_albedo.h"
#include "lib/light/ggx.h"

/// The coat of surfaces, seen along one direction.
typedef struct {
    FacetTable facets;
    lane_uint losses;  // the index of the first value of VXL_COAT_TABLE
    lane_float share;  // of the surface; 0: it has no coat
    lane_float later;  // the part that facets return later of what they miss
    lane_float per_missing, per_entered;
    lane_float reflects;           // the factor of the reflectance below
    lane_float missing, returned;  // at the viewer's angle, see coat_returned
    lane_float chance;             // the probability that it mirrors paths
} Coat;

/// The share of light that a coat without gaps returns at an angle. Sets `missing` to the share
/// that its facets miss.
static inline lane_float coat_returned(const Coat* coat, lane_float cosine, lane_float* missing) {
    const Albedo a = albedo_at(&coat->facets, cosine);
    *missing = a.missing;
    return fma(coat->later, a.missing,
               at_once(&a, (lane_float)VXL_COAT_REFLECTANCE, (lane_float)1.0f));
}

/// The coat of the materials of the surfaces `is`, which are seen at an angle.
static inline Coat view_coat(global const float* restrict materials, lane_int is,
                             lane_uint material, lane_float cosine) {
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    const lane_uint block =
        LANES_UINT(LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_COAT)) & LANES_AS_UINT(is);
    const lane_int some = LANE_MASK(block > 0u);
    Coat c;
    c.reflects = LANES_SELECT(some, LANES_GATHER_FLOAT(materials, block + VXL_COAT_REFLECTS), one);
    c.share = c.later = c.per_missing = c.missing = c.returned = c.chance = zero;
    c.per_entered = one;
    if (!VXL_COAT) return c;
    c.share = LANES_SELECT(some, LANES_GATHER_FLOAT(materials, block + VXL_COAT_SHARE), zero);
    const lane_int coated = LANE_MASK(c.share > 0.0f);
    c.facets.materials = materials;
    c.facets.width =
        LANES_SELECT(coated, LANES_GATHER_FLOAT(materials, block + VXL_COAT_WIDTH), one);
    c.facets.first =
        LANES_UINT(LANES_GATHER_FLOAT(materials, block + VXL_COAT_ALBEDOS)) & LANES_AS_UINT(coated);
    c.facets.next = c.facets.first;
    c.facets.part = zero;
    c.losses = (block + VXL_COAT_TABLE) & LANES_AS_UINT(coated);
    c.later = LANES_GATHER_FLOAT(materials, block + VXL_COAT_LATER);
    c.per_missing = LANES_GATHER_FLOAT(materials, block + VXL_COAT_PER_MISSING);
    c.per_entered =
        LANES_SELECT(coated, LANES_GATHER_FLOAT(materials, block + VXL_COAT_PER_ENTERED), one);
    c.returned = coat_returned(&c, cosine, &c.missing);
    return c;
}

/// What facets under the coat return at an angle, given `a`, what they would return without a coat,
/// and `returned`, the share that the coat returns there.
static inline Albedo under_coat(const Coat* coat, Albedo a, lane_float cosine,
                                lane_float returned) {
    const lane_float at = exact_sqrt(cosine);
    const lane_float lost =
        coat->share * between_entries(coat->facets.materials, coat->losses, 2u, 0u, at);
    const lane_float lost_by_angle =
        coat->share * between_entries(coat->facets.materials, coat->losses, 2u, 1u, at);
    Albedo under;
    under.entered = fma(-coat->share, returned, (lane_float)1.0f);
    under.missing = fma(a.missing, under.entered, a.all * lost);
    under.all = a.all * (under.entered - lost);
    under.by_angle = a.by_angle * (under.entered - lost_by_angle);
    return under;
}

/// The light that the coat returns at a cosine, in the units of facet_lobe. `fifth` is the fifth
/// power in Schlick's formula, and `missing` the share that the facets miss there. Sets `mirrored`
/// to the density of directions that the facets mirror.
static inline lane_float coat_value(const Coat* coat, Vector h, Vector in, lane_float cosine,
                                    Vector out, lane_int above, lane_int is, lane_float fifth,
                                    lane_float missing, lane_float* mirrored) {
    const lane_float lobe = facet_lobe(h, in, cosine, out, coat->facets.width, above, is, mirrored);
    const float straight = VXL_COAT_REFLECTANCE;
    const lane_float facet = fma(fifth, (lane_float)(1.0f - straight), (lane_float)straight);
    const lane_float later = coat->later * coat->per_missing * coat->missing * missing * cosine;
    return coat->share * fma(lobe, facet, later);
}

#endif
