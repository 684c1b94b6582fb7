// SPDX-License-Identifier: Apache-2.0
// Physically based surfaces: metal, and matt surfaces under a clear coat, both of rough facets.
//
// What facets return at once is GGX's lobe with Schlick's reflectance. What they return after more
// reflections, and what comes back from the matt surface below them, has no direction of its own
// and is shared out so that no light is lost and both ways between two directions are equal (Kulla
// & Conty 2017, "Revisiting Physically Based Shading at Imageworks").
#ifndef VXL_PHYSICAL_H
#define VXL_PHYSICAL_H

#include "lib/light/ggx.h"
#include "lib/light/rough_glass.h"
#include "lib/surface/surface_color.h"

/// What facets return at some angles: the share of all light that they miss, and what they return
/// at once of the part (1 - m)^5 of it; see VXL_ALBEDO_ENTRIES.
typedef struct {
    lane_float missing, by_angle;
} Albedo;

/// Surfaces as they are seen along one direction.
typedef struct {
    lane_int is;  // mask: physically based ones
    global const float* restrict materials;
    lane_uint albedos;
    lane_float width, reflectance, multiple;  // the last: what comes back later of `reflectance`
    lane_float facet[3];                      // what facets reflect straight on
    lane_float later[3];                      // what light returns later, per missing shares
    lane_float matt[3];                       // of the surface below, per passed shares
    Frame frame;
    Vector out;         // the direction to the viewer, in the frame
    Albedo seen;        // at its angle
    lane_float passed;  // the share of light that gets through the facets there
    lane_float albedo[3];
    lane_float gloss;    // how probably paths are mirrored by facets
    GlassView glass;     // the part of the surfaces that lets light through
    lane_float tint[3];  // what that multiplies light by on its way
} PhysicalView;

/// One of the two rows of the surfaces' tables, `at` a place between the first entry, 0, and the
/// last, 1.
static inline lane_float table_value(const PhysicalView* s, uint row, lane_float at) {
    const lane_float place = at * (float)(VXL_ALBEDO_ENTRIES - 1);
    const lane_uint entry = min(LANES_UINT(place), (lane_uint)(VXL_ALBEDO_ENTRIES - 2));
    const lane_uint first = s->albedos + entry * (uint)VXL_ALBEDO_FLOATS + row;
    const lane_float low = LANES_GATHER_FLOAT(s->materials, first);
    const lane_float high = LANES_GATHER_FLOAT(s->materials, first + (uint)VXL_ALBEDO_FLOATS);
    return fma(place - LANES_FLOAT(entry), high - low, low);
}

static inline Albedo albedo_at(const PhysicalView* s, lane_float cosine) {
    const lane_float width = LANES_SELECT(s->is, s->width, (lane_float)1.0f);
    const lane_float by_width = exact_divide(cosine * (1.0f + width), cosine + width);
    Albedo a;
    a.missing = table_value(s, VXL_ALBEDO_MISSING, exact_sqrt(by_width));
    a.by_angle = (1.0f - a.missing) * table_value(s, VXL_ALBEDO_BY_ANGLE, exact_sqrt(cosine));
    return a;
}

/// What facets return at once of light at an angle, reflecting so much straight on.
static inline lane_float at_once(const Albedo* a, lane_float reflectance) {
    return fma(reflectance, 1.0f - a->missing - a->by_angle, a->by_angle);
}

/// The share of light that gets through the facets of what isn't metal.
static inline lane_float passed_share(const PhysicalView* s, const Albedo* a) {
    return fmax(1.0f - at_once(a, s->reflectance) - s->multiple * a->missing, 0.0f);
}

/// What facets return later, per share that they don't return at once (Kulla & Conty 2017).
static inline lane_float multiple_share(lane_float reflectance, lane_float missing) {
    const lane_float mean =
        fma(reflectance, (lane_float)(20.0f / 21.0f), (lane_float)(1.0f / 21.0f));
    return exact_divide(mean * mean * (1.0f - missing), fma(-mean, missing, (lane_float)1.0f));
}

/// Finds what surfaces of `base` colour and their layers return.
static inline void set_layers(lane_uint material, const lane_float* base, PhysicalView* s) {
    global const float* materials = s->materials;
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    const lane_float metallic = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_METALLIC);
    const lane_float missing = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_MISSING);
    const lane_float matt = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_MATT);
    const lane_float per_missing =
        exact_reciprocal(LANES_SELECT(LANE_MASK(missing > 0.0f) & s->is, missing, one));
    s->multiple = multiple_share(s->reflectance, missing);
    s->seen = albedo_at(s, s->out.z);
    s->passed = passed_share(s, &s->seen);
    lane_float glossy = zero, rest = zero;
    for (int c = 0; c < 3; ++c) {
        s->facet[c] = fma(metallic, base[c] - s->reflectance, s->reflectance);
        const lane_float multiple =
            fma(metallic, multiple_share(base[c], missing) - s->multiple, s->multiple);
        s->later[c] = multiple * per_missing;
        s->matt[c] = base[c] * matt;
        const lane_float first = at_once(&s->seen, s->facet[c]);
        const lane_float other =
            fma(multiple, s->seen.missing, base[c] * (one - metallic) * s->passed);
        s->albedo[c] = first + other;
        glossy = fmax(glossy, first), rest = fmax(rest, other);
    }
    s->gloss = exact_divide(glossy, LANES_SELECT(s->is, glossy + rest, one));
    for (int c = 0; VXL_ROUGH_GLASS && c < 3; ++c) {
        const lane_float through = fma(base[c], (lane_float)0.5f, (lane_float)0.5f);
        s->albedo[c] = fma(s->glass.share, through - s->albedo[c], s->albedo[c]);
        s->tint[c] = base[c];
    }
}

/// The surfaces of `material` that are seen from the unit vector `out`, by their `normal`, by the
/// `leaving` lanes from inside. `color` is what color_offset tells.
static inline PhysicalView view_physical(global const float* restrict materials, lane_int met,
                                         lane_uint material, lane_uint color, Colors colors,
                                         Vector normal, Vector out, lane_int leaving) {
    PhysicalView s;
    s.materials = materials;
    s.width = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_WIDTH);
    s.is = met & LANE_MASK(s.width > 0.0f);
    s.albedos = LANES_UINT(LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_ALBEDOS)) &
                LANES_AS_UINT(s.is);
    s.reflectance = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFLECTANCE);
    s.frame = frame_around(normal);
    s.out = into_frame(&s.frame, out);
    s.out.z = clamp(s.out.z, 0.0f, 1.0f);
    if (VXL_ROUGH_GLASS) s.glass = view_glass(materials, s.is, material, leaving, s.out.z, s.width);
    lane_float base[3];
    for (int c = 0; c < 3; ++c) base[c] = surface_color(materials, color, colors, c);
    set_layers(material, base, &s);
    return s;
}

/// What surfaces return of the light from `in`, a unit vector in the world, towards the viewer:
/// `value` holds pi times the reflectance distribution times the cosine, which for a white matt
/// surface is the cosine. Returns the mask of directions above the surfaces; `density` is how
/// probable paths are to go there, per solid angle.
static inline lane_int physical_value(const PhysicalView* s, Vector in, lane_float* value,
                                      lane_float* density) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const Vector i = into_frame(&s->frame, in), o = s->out;
    const lane_int above = s->is & LANE_MASK(i.z > 0.0f);
    const lane_float cosine = LANES_SELECT(above, fmin(i.z, one), zero);
    const Vector h = {i.x + o.x, i.y + o.y, i.z + o.z};
    const lane_float facets = facet_density(h, s->width);
    const lane_float k_in = stretched_length(i, s->width), k_out = stretched_length(o, s->width);
    const lane_float both = fma(k_in, o.z, k_out * cosine), seen = o.z + k_out;
    const lane_float lobe = exact_divide(1.57079633f * facets * cosine,
                                         LANES_SELECT(above & LANE_MASK(both > 0.0f), both, one));
    const lane_float meets = clamp(dot_product(unit(h), o), 0.0f, 1.0f);
    const lane_float far = one - meets, square = far * far, fifth = square * square * far;
    const Albedo a = albedo_at(s, cosine);
    const lane_float later = s->seen.missing * a.missing * cosine;
    const lane_float matt = s->passed * passed_share(s, &a) * cosine;
    for (int c = 0; c < 3; ++c) {
        const lane_float facet = fma(fifth, one - s->facet[c], s->facet[c]);
        const lane_float all = fma(lobe, facet, fma(later, s->later[c], matt * s->matt[c]));
        value[c] = LANES_SELECT(above, all, zero);
    }
    const lane_float mirrored =
        exact_divide(0.5f * facets, LANES_SELECT(s->is & LANE_MASK(seen > 0.0f), seen, one));
    const lane_float evenly = cosine * 0.318309886f;
    lane_float likely = fma(s->gloss, mirrored - evenly, evenly);
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

/// The same of the light from `in` on the other side of the surfaces. Returns the mask of surfaces
/// that let some of it through.
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

/// Directions, as unit vectors in the world, in which paths go on, some of them into the surfaces.
/// Where `layer`, spread over what isn't glass, is below `gloss` facets mirror them. `down` becomes
/// the mask of those meant to get through glass.
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
    const Vector mirrored = mirrored_by_facet(s->out, s->width, at);
    Vector in = select_vector(LANE_MASK(layer < s->gloss), mirrored, evenly);
    if (VXL_ROUGH_GLASS) {
        lane_int through;
        const Vector way = glass_direction(&s->glass, s->width, s->out, at, choice, &through);
        in = select_vector(in_glass, way, in);
        *down = in_glass & through;
    }
    return unit(out_of_frame(&s->frame, in));
}

#endif
