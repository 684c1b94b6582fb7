// SPDX-License-Identifier: Apache-2.0
// Rough surfaces, modelled as mirrors in all directions: GGX's microfacets with Smith's
// height-correlated shadowing (Walter et al. 2007; Heitz 2014).
//
// Directions are unit vectors in a surface's own frame, whose z is the normal. With k(v) =
// sqrt(width^2 (x^2 + y^2) + z^2), the terms for shadowing and masking need no quotient: G2 / (4
// z_in z_out) = 1 / (2 (k_in z_out + k_out z_in)), and, for facets seen from `out`, G1 / (4 z_out)
// = 1 / (2 (z_out + k_out)).
#ifndef VXL_GGX_H
#define VXL_GGX_H

#include "lib/lanes/vector.h"
#include "lib/sampling/directions.h"

/// Three unit vectors at right angles.
typedef struct {
    Vector x, y, z;
} Frame;

/// A frame with the axes that around_normal uses.
static inline Frame frame_around(Vector n) {
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    const Frame f = {around_normal(n, one, zero, zero), around_normal(n, zero, one, zero), n};
    return f;
}

static inline Vector into_frame(const Frame* f, Vector v) {
    const Vector result = {dot_product(f->x, v), dot_product(f->y, v), dot_product(f->z, v)};
    return result;
}

static inline Vector out_of_frame(const Frame* f, Vector v) {
    const Vector result = {fma(f->x.x, v.x, fma(f->y.x, v.y, f->z.x * v.z)),
                           fma(f->x.y, v.x, fma(f->y.y, v.y, f->z.y * v.z)),
                           fma(f->x.z, v.x, fma(f->y.z, v.y, f->z.z * v.z))};
    return result;
}

/// The length k(v) of the file's head.
static inline lane_float stretched_length(Vector v, lane_float width) {
    const lane_float aside = fma(v.x, v.x, v.y * v.y);
    return exact_sqrt(fma(width * width, aside, v.z * v.z));
}

/// The density of facets that face along h, which has any length: their area per solid angle.
static inline lane_float facet_density(Vector h, lane_float width) {
    const lane_float aside = fma(h.x, h.x, h.y * h.y), squared = fma(h.z, h.z, aside);
    const lane_float stretched = fma(width * width, h.z * h.z, aside);
    const lane_float ratio = exact_divide(
        width * squared, LANES_SELECT(LANE_MASK(stretched > 0.0f), stretched, (lane_float)1.0f));
    return 0.318309886f * ratio * ratio;
}

/// The light that white facets return between the directions `in`, at a cosine, and `out`, with
/// half vector h: pi times the reflectance distribution times the cosine, in the lanes `above`.
/// Sets `mirrored` to the density of directions into which the facets mirror `out`, in the lanes
/// `is`.
static inline lane_float facet_lobe(Vector h, Vector in, lane_float cosine, Vector out,
                                    lane_float width, lane_int above, lane_int is,
                                    lane_float* mirrored) {
    const lane_float one = (lane_float)1.0f;
    const lane_float facets = facet_density(h, width);
    const lane_float k_in = stretched_length(in, width), k_out = stretched_length(out, width);
    const lane_float both = fma(k_in, out.z, k_out * cosine), seen = out.z + k_out;
    *mirrored = exact_divide(0.5f * facets, LANES_SELECT(is & LANE_MASK(seen > 0.0f), seen, one));
    return exact_divide(1.57079633f * facets * cosine,
                        LANES_SELECT(above & LANE_MASK(both > 0.0f), both, one));
}

/// Unit normals of facets seen from `out`, each as probable as its visible area (Dupuy & Benyoub
/// 2023, "Sampling Visible GGX Normals with Spherical Caps").
static inline Vector visible_facet(Vector out, lane_float width, SquarePoint p) {
    const Vector stretched = {out.x * width, out.y * width, out.z};
    const Vector view = unit(stretched);
    const lane_float z = fma(1.0f - p.x, 1.0f + view.z, -view.z);
    const lane_float radius = exact_sqrt(fmax(fma(-z, z, 1.0f), 0.0f));
    lane_float sine, cosine;
    exact_sincos(p.y * 6.28318531f, &sine, &cosine);
    const Vector facet = {fma(radius, cosine, view.x) * width, fma(radius, sine, view.y) * width,
                          z + view.z};
    return unit(facet);
}

/// The directions into which facets seen from `out` mirror it.
static inline Vector mirrored_by_facet(Vector out, lane_float width, SquarePoint p) {
    const Vector h = visible_facet(out, width, p);
    const lane_float twice = 2.0f * dot_product(out, h);
    const Vector in = {fma(twice, h.x, -out.x), fma(twice, h.y, -out.y), fma(twice, h.z, -out.z)};
    return in;
}

#endif
