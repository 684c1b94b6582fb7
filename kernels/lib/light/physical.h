// SPDX-License-Identifier: Apache-2.0
// Physically based surfaces: metal, or matt surfaces under clear facets; the facets are rough, and
// there may be a coat above.
//
// What facets return at once is GGX's lobe with Schlick's reflectance. What they return after more
// reflections, and what returns from the matt surface below, has no direction of its own and is
// distributed so that no light is lost and the reflectance is reciprocal (Kulla & Conty 2017,
// "Revisiting Physically Based Shading at Imageworks").
#ifndef VXL_PHYSICAL_H
#define VXL_PHYSICAL_H

#include "lib/light/coat.h"
#include "lib/light/facet_albedo.h"
#include "lib/light/ggx.h"
#include "lib/light/mapped_layers.h"
#include "lib/light/rough_glass.h"
#include "lib/surface/surface_color.h"

/// Surfaces seen along one direction.
typedef struct {
    lane_int is;  // mask: physically based ones
    global const float* restrict materials;
    FacetTable facets;
    Layers layers;
    lane_float width, reflectance, multiple;  // multiple: what returns later of `reflectance`
    lane_float grazing;                       // reflectance of the facets at grazing angles ...
    lane_float clear_grazing;                 // ... and of the part that isn't metal
    lane_float facet[3];                      // reflectance of the facets at normal incidence
    lane_float later[3];                      // later light, per product of missing shares
    lane_float matt[3];                       // matt surface below, per product of passed shares
    Frame frame;
    Vector out;         // the direction to the viewer, in the frame
    Albedo seen;        // at the viewer's angle
    lane_float passed;  // share of light that passes the facets at the viewer's angle
    lane_float albedo[3];
    lane_float gloss;    // probability that facets mirror paths
    GlassView glass;     // of the surfaces that let light through
    Coat coat;           // on the other surfaces
    lane_float tint[3];  // the colour of what light passes through
} PhysicalView;

/// What the facets under the coat return at an angle.
static inline Albedo albedo_below(const PhysicalView* s, lane_float cosine, lane_float returned) {
    const Albedo a = albedo_at(&s->facets, cosine);
    if (!VXL_COAT) return a;
    return under_coat(&s->coat, a, cosine, returned);
}

/// The share of light that passes the facets of the part that isn't metal.
static inline lane_float passed_share(const PhysicalView* s, const Albedo* a) {
    return fmax(
        a->entered - at_once(a, s->reflectance, s->clear_grazing) - s->multiple * a->missing, 0.0f);
}

/// The light that facets return later, per share that they don't return at once (Kulla & Conty
/// 2017).
static inline lane_float multiple_share(lane_float reflectance, lane_float grazing,
                                        lane_float missing) {
    const lane_float mean =
        fma(reflectance, (lane_float)(20.0f / 21.0f), grazing * (lane_float)(1.0f / 21.0f));
    return exact_divide(mean * mean * (1.0f - missing), fma(-mean, missing, (lane_float)1.0f));
}

/// The factor of the materials' matt part; it is chosen so that no light is lost.
static inline lane_float matt_factor(const PhysicalView* s, lane_uint material) {
    const lane_float own = LANES_GATHER_FLOAT(s->materials, material + VXL_MATERIAL_MATT);
    const Layers* l = &s->layers;
    if (!VXL_TEXTURE_MAPS || !lanes_any(l->mapped)) return own;
    const lane_float one = (lane_float)1.0f;
    const Albedo mean = {one - l->missing, l->by_angle, l->missing, one};
    const lane_float passed = LANES_SELECT(l->mapped, passed_share(s, &mean), one);
    return LANES_SELECT(l->mapped, exact_divide(one - l->metallic, passed), own);
}

/// Adds what the coat returns to the albedos, and what it returns evenly in all directions to
/// `rest`.
static inline void add_coat(PhysicalView* s, lane_float glossy, lane_float* rest) {
    Coat* coat = &s->coat;
    const lane_float later = coat->share * coat->later * coat->missing;
    const lane_float first = fma(coat->share, coat->returned, -later);
    *rest += later;
    for (int c = 0; c < 3; ++c) s->albedo[c] = fma(coat->share, coat->returned, s->albedo[c]);
    const lane_float all = first + glossy + *rest;
    coat->chance = exact_divide(first, LANES_SELECT(LANE_MASK(all > 0.0f), all, (lane_float)1.0f));
}

/// Finds what surfaces of `base` colour return with their layers.
static inline void set_layers(lane_uint material, const lane_float* base, PhysicalView* s) {
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    const lane_float metallic = s->layers.metallic, missing = s->layers.missing;
    const lane_float per_missing =
        exact_reciprocal(LANES_SELECT(LANE_MASK(missing > 0.0f) & s->is, missing, one));
    s->clear_grazing = (VXL_COAT | VXL_WEAK_FACETS) ? s->coat.reflects : one;
    s->grazing = fma(metallic, one - s->clear_grazing, s->clear_grazing);
    const lane_float missed = VXL_COAT ? missing * s->coat.per_entered : missing;
    s->multiple = multiple_share(s->reflectance, s->clear_grazing, missed);
    const lane_float matt = matt_factor(s, material);
    s->seen = albedo_below(s, s->out.z, s->coat.returned);
    s->passed = passed_share(s, &s->seen);
    lane_float glossy = zero, rest = zero;
    for (int c = 0; c < 3; ++c) {
        s->facet[c] = fma(metallic, base[c] - s->reflectance, s->reflectance);
        const lane_float multiple =
            fma(metallic, multiple_share(base[c], one, missed) - s->multiple, s->multiple);
        s->later[c] = multiple * per_missing;
        s->matt[c] = base[c] * matt;
        const lane_float first = at_once(&s->seen, s->facet[c], s->grazing);
        const lane_float other =
            fma(multiple, s->seen.missing, base[c] * (one - metallic) * s->passed);
        s->albedo[c] = first + other;
        glossy = fmax(glossy, first), rest = fmax(rest, other);
    }
    if (VXL_COAT) add_coat(s, glossy, &rest);
    s->gloss = exact_divide(glossy, LANES_SELECT(s->is, glossy + rest, one));
    for (int c = 0; VXL_ROUGH_GLASS && c < 3; ++c) {
        const lane_float through = fma(base[c], (lane_float)0.5f, (lane_float)0.5f);
        s->albedo[c] = fma(s->glass.share, through - s->albedo[c], s->albedo[c]);
        s->tint[c] = base[c];
    }
}

/// The surfaces of `material`, seen from the unit vector `out`, by their `normal`; the `leaving`
/// lanes see them from inside. `color` is an offset from color_offset.
static inline PhysicalView view_physical(global const float* restrict materials, lane_int met,
                                         lane_uint material, lane_uint color, Colors colors,
                                         Vector normal, Vector out, lane_int leaving) {
    PhysicalView s;
    s.materials = materials;
    const lane_float width = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_WIDTH);
    s.is = met & LANE_MASK(width > 0.0f);
    s.facets.materials = materials;
    s.facets.first = LANES_UINT(LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_ALBEDOS)) &
                     LANES_AS_UINT(s.is);
    s.layers = layers_of(materials, material, colors, &s.facets);
    s.layers.mapped &= s.is;
    s.width = s.layers.width;
    s.facets.width = LANES_SELECT(s.is, s.width, (lane_float)1.0f);
    s.reflectance = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFLECTANCE);
    s.frame = frame_around(normal);
    s.out = into_frame(&s.frame, out);
    s.out.z = clamp(s.out.z, 0.0f, 1.0f);
    if (VXL_ROUGH_GLASS) s.glass = view_glass(materials, s.is, material, leaving, s.out.z, s.width);
    if (VXL_COAT | VXL_WEAK_FACETS) s.coat = view_coat(materials, s.is, material, s.out.z);
    lane_float base[3];
    for (int c = 0; c < 3; ++c) base[c] = surface_color(materials, color, colors, c);
    set_layers(material, base, &s);
    return s;
}

/// The light from `in`, a unit vector in the world, that surfaces return towards the viewer.
/// `value` gets pi times the reflectance distribution times the cosine, which for a white matt
/// surface is the cosine; `density` gets the probability, per solid angle, with which paths go
/// there. Returns the mask of directions above the surfaces.
static inline lane_int physical_value(const PhysicalView* s, Vector in, lane_float* value,
                                      lane_float* density) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const Vector i = into_frame(&s->frame, in), o = s->out;
    const lane_int above = s->is & LANE_MASK(i.z > 0.0f);
    const lane_float cosine = LANES_SELECT(above, fmin(i.z, one), zero);
    const Vector h = {i.x + o.x, i.y + o.y, i.z + o.z};
    lane_float mirrored, coat_missing = zero, returned_by_coat = zero, under = one;
    const lane_float lobe = facet_lobe(h, i, cosine, o, s->width, above, s->is, &mirrored);
    if (VXL_COAT) {
        returned_by_coat = coat_returned(&s->coat, cosine, &coat_missing);
        under = fma(-s->coat.share, fmax(returned_by_coat, s->coat.returned), one);
    }
    const lane_float meets = clamp(dot_product(unit(h), o), 0.0f, 1.0f);
    const lane_float far = one - meets, square = far * far, fifth = square * square * far;
    const Albedo a = albedo_below(s, cosine, returned_by_coat);
    const lane_float later = s->seen.missing * a.missing * cosine;
    const lane_float matt = s->passed * passed_share(s, &a) * cosine;
    const lane_float evenly = cosine * 0.318309886f;
    lane_float likely = fma(s->gloss, mirrored - evenly, evenly);
    lane_float coat = zero;
    if (VXL_COAT) {
        lane_float by_coat;
        coat = coat_value(&s->coat, h, i, cosine, o, above, s->is, fifth, coat_missing, &by_coat);
        likely = fma(s->coat.chance, by_coat - likely, likely);
    }
    for (int c = 0; c < 3; ++c) {
        const lane_float facet = fma(fifth, s->grazing - s->facet[c], s->facet[c]);
        lane_float all =
            fma(VXL_COAT ? lobe * under : lobe, facet, fma(later, s->later[c], matt * s->matt[c]));
        if (VXL_COAT) all += coat;
        value[c] = LANES_SELECT(above, all, zero);
    }
    if (VXL_ROUGH_GLASS) {
        lane_float of_glass;
        const lane_float returned =
            glass_value(&s->glass, s->width, cosine, lobe, meets, mirrored, &of_glass);
        likely = fma(s->glass.share, of_glass - likely, likely);
        for (int c = 0; c < 3; ++c)
            value[c] =
                LANES_SELECT(above, fma(s->glass.share, returned - value[c], value[c]), zero);
    }
    *density = LANES_SELECT(above, likely, zero);
    return above;
}

/// Finds how much light from `in`, on their other side, surfaces let through, and the density of
/// that direction. Returns the mask of surfaces that let some of it through.
static inline lane_int physical_through(const PhysicalView* s, Vector in, lane_float* value,
                                        lane_float* density) {
    const lane_float zero = (lane_float)0.0f;
    const Vector i = into_frame(&s->frame, in);
    lane_float likely;
    const lane_int some = s->is & LANE_MASK(s->glass.share > 0.0f) & LANE_MASK(i.z < 0.0f);
    const lane_float all = s->glass.share * glass_through(&s->glass, s->width, s->out, i, &likely);
    for (int c = 0; c < 3; ++c) value[c] = LANES_SELECT(some, all * s->tint[c], zero);
    *density = LANES_SELECT(some, s->glass.share * likely, zero);
    return some;
}

/// Directions, as unit vectors in the world, in which paths continue, some of them into the
/// surfaces. Where `layer`, stretched over what isn't glass, is below `gloss`, facets mirror the
/// path. `down` becomes the mask of paths that are meant to pass through glass.
static inline Vector physical_direction(const PhysicalView* s, SquarePoint at, lane_float layer,
                                        lane_int* down) {
    const lane_float one = (lane_float)1.0f;
    lane_int in_glass = (lane_int)0;
    lane_float choice = layer;
    *down = (lane_int)0;
    if (VXL_ROUGH_GLASS) {
        const lane_float glass = s->glass.share;
        in_glass = LANE_MASK(layer < glass);
        choice = exact_divide(layer, LANES_SELECT(in_glass, glass, one));
        layer = exact_divide(layer - glass, LANES_SELECT(in_glass, one, one - glass));
    }
    const SquarePoint d = disk_point(at);
    const Vector evenly = {d.x, d.y, exact_sqrt(1.0f - at.x)};
    lane_float width = s->width;
    lane_int by_coat = (lane_int)0;
    if (VXL_COAT) {
        const lane_float chance = s->coat.chance;
        by_coat = LANE_MASK(layer < chance);
        width = LANES_SELECT(by_coat, s->coat.facets.width, width);
        layer = exact_divide(layer - chance, LANES_SELECT(by_coat, one, one - chance));
    }
    const Vector mirrored = mirrored_by_facet(s->out, width, at);
    Vector in = select_vector(by_coat | LANE_MASK(layer < s->gloss), mirrored, evenly);
    if (VXL_ROUGH_GLASS) {
        lane_int through;
        const Vector way = glass_direction(&s->glass, s->width, s->out, at, choice, &through);
        in = select_vector(in_glass, way, in);
        *down = in_glass & through;
    }
    return unit(out_of_frame(&s->frame, in));
}

#endif
