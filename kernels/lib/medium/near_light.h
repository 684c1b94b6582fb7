// SPDX-License-Identifier: Apache-2.0
// Where along a ray's way through a medium a light near by shines most.
//
// Points are spread evenly over the angle at which the light sees the way (Kulla & Fajardo 2012,
// "Importance sampling techniques for path tracing in participating media"); for a spot light, over
// the part of the way in its cone. Paths that the medium scatters find the same light by chance;
// both are weighted by the balance heuristic (Veach & Guibas 1995).
#ifndef VXL_NEAR_LIGHT_H
#define VXL_NEAR_LIGHT_H

#include "lib/lanes/exact_angle.h"
#include "lib/light/lit_points.h"
#include "lib/sampling/directions.h"
#include "shared/scene.h"

/// The part of a ray's way that a light shines on, in metres along it from the point closest to the
/// light.
typedef struct {
    lane_float begin, end;
    lane_float height;  // distance of the light from that point, metres
    lane_float angle;   // the angle at which the light sees the part
    lane_int some;      // mask: there is such a part
} NearPart;

/// Cuts off what isn't in the cone of a spot light of less than 180 degrees. The point closest to
/// the light is at `next` from it.
static inline void cut_to_cone(const Light* light, Vector next, Vector way, NearPart* p) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const Vector axis = light->direction;
    const lane_float squared_cosine = light->outer_cosine * light->outer_cosine;
    // The solutions are points x on the way with (next + x way) axis = outer_cosine |next + x way|.
    const lane_float ahead = dot_product(next, axis), along = dot_product(way, axis);
    const lane_float a = fma(along, along, -squared_cosine), b = ahead * along;
    const lane_float c = fma(ahead, ahead, -squared_cosine * dot_product(next, next));
    const lane_float discriminant = fma(b, b, -a * c);
    const lane_int meets = LANE_MASK(discriminant >= 0.0f) & LANE_MASK(a != 0.0f);
    const lane_float root = exact_sqrt(LANES_SELECT(meets, discriminant, zero));
    const lane_float safe = LANES_SELECT(meets, a, one);
    const lane_float p0 = exact_divide(-b - root, safe), p1 = exact_divide(root - b, safe);
    const lane_float low = fmin(p0, p1), high = fmax(p0, p1);
    // If the way runs across the cone, it is inside between the two points, unless these lie behind
    // the light.
    const lane_int across = LANE_MASK(a < 0.0f);
    const lane_int before = LANE_MASK(fma(along, 0.5f * (low + high), ahead) > 0.0f);
    const lane_int towards = LANE_MASK(along > 0.0f);
    const lane_int narrow = LANE_MASK(light->outer_cosine > 0.0f);
    const lane_float begin = LANES_SELECT(
        across, fmax(p->begin, low), LANES_SELECT(towards & meets, fmax(p->begin, high), p->begin));
    const lane_float end = LANES_SELECT(across, fmin(p->end, high),
                                        LANES_SELECT(meets & ~towards, fmin(p->end, low), p->end));
    p->begin = LANES_SELECT(narrow, begin, p->begin);
    p->end = LANES_SELECT(narrow, end, p->end);
    p->some &= ~narrow | (across & meets & before) | (~across & LANE_MASK(along != 0.0f));
}

/// The part of the ways along the unit vectors `way` that the light shines on. The light's middle
/// lies at `to_light` from the ways' origins, and the ways reach from `begin` to `end`, all in
/// metres.
///
/// If a ray begins at a light, for example because the observer carries one, the medium scatters an
/// infinite amount of its light towards the observer. Within one voxel of the light only chance
/// finds that light, so pictures become brighter with more samples.
static inline NearPart near_part(const Light* light, float4 edge, Vector to_light, Vector way,
                                 lane_float begin, lane_float end, lane_int valid) {
    const lane_float one = (lane_float)1.0f;
    const lane_float nearest = dot_product(to_light, way);
    const Vector across = cross_of(to_light, way);
    const Vector next = {fma(way.x, nearest, -to_light.x), fma(way.y, nearest, -to_light.y),
                         fma(way.z, nearest, -to_light.z)};
    NearPart p;
    p.begin = begin - nearest;
    p.end = end - nearest;
    // If the light lay on the way itself, the density of points would not be finite.
    p.height = fmax(exact_sqrt(dot_product(across, across)), 1e-6f);
    const float voxel = fmax(edge.x, fmax(edge.y, edge.z));
    const lane_int at_light = LANE_MASK(fma(p.height, p.height, p.begin * p.begin) < voxel * voxel);
    p.some = valid & ~at_light;
    if (light->kind == VXL_LIGHT_SPOT) cut_to_cone(light, next, way, &p);
    p.some &= LANE_MASK(p.begin < p.end);
    p.begin = LANES_SELECT(p.some, p.begin, (lane_float)0.0f);
    p.end = LANES_SELECT(p.some, p.end, one);
    p.angle = exact_atan2(p.height * (p.end - p.begin), fma(p.height, p.height, p.begin * p.end));
    p.some &= LANE_MASK(p.angle > 0.0f);
    return p;
}

/// The density, per metre, of points at `x` metres from the point closest to the light.
static inline lane_float near_density(const NearPart* p, lane_float x) {
    const lane_int inside = p->some & LANE_MASK(x >= p->begin) & LANE_MASK(x <= p->end);
    const lane_float all = p->angle * fma(p->height, p->height, x * x);
    return LANES_SELECT(inside,
                        exact_divide(p->height, LANES_SELECT(inside, all, (lane_float)1.0f)),
                        (lane_float)0.0f);
}

/// The point at this fraction of the angle, in metres from the point closest to the light.
static inline lane_float near_point(const NearPart* p, lane_float fraction) {
    lane_float sine, cosine;
    exact_sincos(fraction * p->angle, &sine, &cosine);
    const lane_float up = p->height * fma(p->begin, cosine, p->height * sine);
    const lane_float down = fma(p->height, cosine, -p->begin * sine);
    const lane_int finite = LANE_MASK(down > 0.0f);
    const lane_float x = exact_divide(up, LANES_SELECT(finite, down, (lane_float)1.0f));
    return clamp(LANES_SELECT(finite, x, p->end), p->begin, p->end);
}

#endif
