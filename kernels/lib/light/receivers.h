// SPDX-License-Identifier: Apache-2.0
// Points and rays that choose a light: roughly how much of a light they would return.
#ifndef VXL_RECEIVERS_H
#define VXL_RECEIVERS_H

#include "lib/light/lit_points.h"
#include "lib/light/phase.h"

/// The smallest cosine between a normal and a light that counts.
#define VXL_LEAST_COSINE 0.02f

/// A highlight: of how much light it returns at most, for white matt surfaces' 1, and the square of
/// its width, GGX's alpha.
typedef struct {
    lane_float strength, width;
} Highlight;

// The kinds of receivers: surface points, points that a medium scatters light at, and ways of rays
// through a medium.
#define VXL_RECEIVES_ON_SURFACE 0
#define VXL_RECEIVES_IN_MEDIUM 1
#define VXL_RECEIVES_ON_WAY 2

/// The points from which light is chosen, in voxels, and what they return roughly.
typedef struct {
    int kind;
    Vector at, normal;
    float4 edge;
    Vector out;  // a unit vector: to the viewer; in a medium, to where most of the light that
                 // is scattered comes from; along a way
    lane_float cosine;  // between the normal and `out`
    lane_float matt;    // what they return evenly
    Highlight own, coat;
    float anisotropy;       // of a medium; 0 or more
    float extinction;       // of a medium, per metre at density 1
    lane_float begin, end;  // of a way from `at` along `out`, metres
} Receivers;

/// Returns x^2.
static inline lane_float squared(lane_float x) {
    return x * x;
}

/// The highlight of facets with GGX's `width` that reflect `reflectance` straight on.
static inline Highlight facet_highlight(lane_float reflectance, lane_float width,
                                        lane_float cosine) {
    const lane_float aside = 1.0f - cosine, fourth = squared(squared(aside));
    const lane_float reflected = fma(fourth * aside, 1.0f - reflectance, reflectance);
    // Widths are 1 / 1024 or more; in other lanes, which don't count, the quotient stays finite.
    const lane_float square = fmax(width * width, 9e-7f);
    const Highlight h = {exact_divide(0.25f * reflected, square), square};
    return h;
}

/// Receivers that return light evenly.
static inline Receivers empty_receivers(int kind, Vector at, float4 edge) {
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    const Vector nothing = {zero, zero, zero};
    const Receivers r = {kind,        at,          nothing, edge, nothing, zero, one,
                         {zero, one}, {zero, one}, 0.0f,    0.0f, zero,    zero};
    return r;
}

/// Points at which a medium scatters light that goes along `way`, a unit vector, to the viewer.
static inline Receivers receivers_in_medium(Vector at, float4 edge, Vector way, float anisotropy) {
    Receivers r = empty_receivers(VXL_RECEIVES_IN_MEDIUM, at, edge);
    r.out = anisotropy < 0.0f ? opposite(way) : way;
    r.anisotropy = fabs(anisotropy);
    return r;
}

/// Ways through a medium along the unit vector `way`, from `begin` to `end` metres from `at`.
static inline Receivers receivers_on_way(Vector at, float4 edge, Vector way, lane_float begin,
                                         lane_float end, float extinction) {
    Receivers r = empty_receivers(VXL_RECEIVES_ON_WAY, at, edge);
    r.out = way;
    r.begin = begin;
    r.end = end;
    r.extinction = extinction;
    return r;
}

/// What surfaces of the points' materials return, without textures' maps.
static inline Receivers receivers_of(global const float* restrict materials, const LitPoints* p,
                                     float4 edge, Vector way) {
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    Receivers r = empty_receivers(VXL_RECEIVES_ON_SURFACE, p->position, edge);
    r.normal = p->shading_normal;
    r.out = opposite(unit(scaled(way, edge)));
    r.cosine = clamp(dot_product(r.normal, r.out), 0.0f, 1.0f);
    const lane_uint m = p->material & LANES_AS_UINT(p->lit);
    const lane_float shininess = LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_SHININESS);
    r.own.strength = LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_SPECULAR);
    r.own.width = exact_divide((lane_float)2.0f, fmax(shininess, 0.0f) + 2.0f);
    if (!VXL_PHYSICAL) return r;
    const lane_float width = LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_WIDTH);
    const lane_float metallic = LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_METALLIC);
    const lane_float reflectance = LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_REFLECTANCE);
    const lane_int is = LANE_MASK(width > 0.0f);
    const Highlight facets =
        facet_highlight(fma(metallic, one - reflectance, reflectance), width, r.cosine);
    r.own.strength = LANES_SELECT(is, facets.strength, r.own.strength);
    r.own.width = LANES_SELECT(is, facets.width, r.own.width);
    r.matt = LANES_SELECT(is, fmax(one - metallic, 0.05f), one);
    if (!VXL_COAT) return r;
    const lane_uint block =
        LANES_UINT(LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_COAT)) & LANES_AS_UINT(is);
    const lane_int coated = LANE_MASK(block > 0u);
    const lane_float share = LANES_GATHER_FLOAT(materials, block + VXL_COAT_SHARE);
    r.coat = facet_highlight((lane_float)VXL_COAT_REFLECTANCE,
                             LANES_GATHER_FLOAT(materials, block + VXL_COAT_WIDTH), r.cosine);
    r.coat.strength = LANES_SELECT(coated, share * r.coat.strength, zero);
    r.coat.width = LANES_SELECT(coated, r.coat.width, one);
    return r;
}

/// The strength of a highlight where the half vector has this squared cosine with the normal. The
/// light comes from all over a ball that is seen under an angle with this squared sine.
static inline lane_float highlight_at(const Highlight* h, lane_float half_cosine,
                                      lane_float ball_sine) {
    const lane_float width = fmin(h->width + ball_sine, 1.0f);
    const lane_float lobe = exact_divide(width, fma(half_cosine, width - 1.0f, 1.0f));
    return h->strength * exact_divide(h->width, width) * (lobe * lobe);
}

/// What the points return of light that comes along `l`, a unit vector with the cosine `facing`.
static inline lane_float returned_light(const Receivers* p, Vector l, lane_float facing,
                                        lane_float ball_sine) {
    const lane_float between = dot_product(l, p->out);
    // The squared length of the half vector, which vanishes between opposite directions.
    const lane_float length = fmax(fma(2.0f, between, 2.0f), 1e-6f);
    const lane_float half_cosine = fmin(exact_divide(squared(facing + p->cosine), length), 1.0f);
    lane_float light =
        fma(p->matt, fmax(facing, VXL_LEAST_COSINE), highlight_at(&p->own, half_cosine, ball_sine));
    if (VXL_COAT) light += highlight_at(&p->coat, half_cosine, ball_sine);
    return light;
}

/// The cosine of an angle less another one of at most 90 degrees, but at most 1.
static inline lane_float cosine_of_less(lane_float cosine, lane_float less_cosine,
                                        lane_float less_sine) {
    const lane_float sine = exact_sqrt(fmax(fma(-cosine, cosine, 1.0f), 0.0f));
    return LANES_SELECT(LANE_MASK(cosine >= less_cosine), (lane_float)1.0f,
                        fma(cosine, less_cosine, sine * less_sine));
}

/// What points in a medium scatter of light that comes from all over a ball, which is seen along
/// `l` under an angle with this cosine and sine.
static inline lane_float scattered_light(const Receivers* p, Vector l, lane_float ball_cosine,
                                         lane_float ball_sine) {
    const lane_float cosine = cosine_of_less(dot_product(p->out, l), ball_cosine, ball_sine);
    return phase_density(p->anisotropy, cosine);
}

/// What the medium scatters along ways of light from a ball at `to`, in metres from where the ways'
/// lines begin: as if the way lay straight across the light, as near as it comes to the ball.
static inline lane_float light_along_way(const Receivers* p, Vector to, lane_float radius,
                                         float least) {
    const lane_float ahead = dot_product(to, p->out);
    const lane_float nearest = clamp(ahead, p->begin, p->end);
    const Vector across = add_scaled(to, p->out, -nearest);
    const lane_float square = fmax(dot_product(across, across), fmax(radius * radius, least));
    const lane_float distance = exact_sqrt(square), length = p->end - p->begin;
    const lane_float thick = fma(nearest - p->begin, p->extinction, 1.0f);
    return exact_divide(length, distance * (distance + length) * (thick * thick));
}

#endif
