// SPDX-License-Identifier: Apache-2.0
// The radiance of the sky along directions, which are unit vectors in metric space.
#ifndef VXL_SKY_H
#define VXL_SKY_H

#include "lib/lanes/exact_exp.h"
#include "lib/lanes/vector.h"
#include "lib/light/sky_map.h"
#include "lib/traverse/medium_set.h"
#include "lib/traverse/ray_batch.h"
#include "shared/emitters.h"
#include "shared/paths.h"
#include "shared/sky.h"

/// The angle whose cosine is x, in [0, pi], within 3e-8 (Abramowitz & Stegun 1964, 4.4.46).
static inline lane_float angle_of_cosine(lane_float x) {
    const lane_float a = fmin(fabs(x), 1.0f);
    lane_float p = fma(a, -0.0012624911f, 0.0066700901f);
    p = fma(a, p, -0.0170881256f);
    p = fma(a, p, 0.0308918810f);
    p = fma(a, p, -0.0501743046f);
    p = fma(a, p, 0.0889789874f);
    p = fma(a, p, -0.2145988016f);
    p = fma(a, p, 1.5707963050f);
    const lane_float angle = exact_sqrt(1.0f - a) * p;
    return LANES_SELECT(LANE_MASK(x < 0.0f), 3.14159265f - angle, angle);
}

/// Perez' formula of 1993: the brightness of a direction at `height`, its cosine with the zenith,
/// and at an angle from the sun with this cosine.
static inline lane_float perez(float4 abcd, float e, lane_float height, lane_float angle,
                               lane_float cosine) {
    const lane_float dim = exact_exp(exact_divide((lane_float)abcd.y, height));
    const lane_float circumsolar = fma((lane_float)abcd.z, exact_exp(abcd.w * angle),
                                       fma(e * cosine, cosine, (lane_float)1.0f));
    return fma((lane_float)abcd.x, dim, (lane_float)1.0f) * circumsolar;
}

/// The clear sky of Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight".
static inline void daylight(global const SkyRecord* sky, Vector way, lane_float* light) {
    const float4 sun = sky->sun_direction, last = sky->last, base = sky->base;
    const lane_float cosine = fma(way.x, sun.x, fma(way.y, sun.y, way.z * sun.z));
    const lane_float angle = angle_of_cosine(cosine);
    const lane_float height = fmax(way.y, 0.0009765625f);  // the formula has a pole at the horizon
    const lane_float luminance = base.x * perez(sky->luminance, last.x, height, angle, cosine);
    const lane_float x = base.y * perez(sky->chromaticity_x, last.y, height, angle, cosine);
    const lane_float y = base.z * perez(sky->chromaticity_y, last.z, height, angle, cosine);
    const lane_float per_y = exact_divide(luminance, fmax(y, 0.001f));
    const lane_float cie_x = x * per_y, cie_z = (1.0f - x - y) * per_y;
    const lane_float red = fma(cie_x, 3.2404542f, fma(luminance, -1.5371385f, cie_z * -0.4985314f));
    const lane_float green =
        fma(cie_x, -0.9692660f, fma(luminance, 1.8760108f, cie_z * 0.0415560f));
    const lane_float blue = fma(cie_x, 0.0556434f, fma(luminance, -0.2040259f, cie_z * 1.0572252f));
    light[0] = fmax(red, 0.0f), light[1] = fmax(green, 0.0f), light[2] = fmax(blue, 0.0f);
}

/// The parameters that `bind` of a SkyView sets, in its order. A comma ends them.
#define VXL_SKY_PARAMETERS global const SkyRecord *restrict sky, VXL_SKY_MAP_PARAMETERS

/// A sky; `map` is empty unless the sky is one.
typedef struct {
    global const SkyRecord* restrict record;
    SkyMap map;
} SkyView;

/// The parameter that says, for hidden skies, whether rays come from an observer. A comma ends it.
#if VXL_SKY_HIDDEN
#define VXL_SKY_DEPTH_PARAMETER uint from_observer,
#define VXL_FROM_OBSERVER from_observer
#else
#define VXL_SKY_DEPTH_PARAMETER
#define VXL_FROM_OBSERVER 0u
#endif

/// The value of SkyView in a kernel with these parameters.
#define VXL_SKY_VIEW \
    { sky, VXL_SKY_MAP_VIEW }

/// The radiance of the sky along `way`, without the sun's disc.
static inline void sky_light(const SkyView* view, Vector way, lane_float* light) {
    if (VXL_SKY == VXL_SKY_MAP) {
        sky_map_light(&view->map, way, light);
        return;
    }
    global const SkyRecord* sky = view->record;
    const float zenith[3] = {sky->zenith.x, sky->zenith.y, sky->zenith.z};
    const float horizon[3] = {sky->horizon.x, sky->horizon.y, sky->horizon.z};
    const float ground[3] = {sky->ground.x, sky->ground.y, sky->ground.z};
    const lane_int below = LANE_MASK(way.y < 0.0f);
    if (VXL_SKY == VXL_SKY_SUN) daylight(sky, way, light);
    for (int c = 0; c < 3; ++c) {
        if (VXL_SKY != VXL_SKY_SUN)
            light[c] = fma(way.y, (lane_float)(zenith[c] - horizon[c]), (lane_float)horizon[c]);
        light[c] = LANES_SELECT(below, (lane_float)ground[c], light[c]);
    }
}

/// Adds the sun's disc to the `seeing` lanes. Its light is even over a disk in front of the viewer.
static inline void add_sun_disc(global const SkyRecord* sky, Vector way, lane_int seeing,
                                lane_float* light) {
    const float4 sun = sky->sun_direction;
    const float radiance[3] = {sky->sun_radiance.x, sky->sun_radiance.y, sky->sun_radiance.z};
    const lane_float cosine = fma(way.x, sun.x, fma(way.y, sun.y, way.z * sun.z));
    const lane_int inside = seeing & LANE_MASK(cosine >= sun.w);
    if (!lanes_any(inside)) return;
    const lane_float cube = LANES_SELECT(inside, cosine * cosine * cosine, (lane_float)1.0f);
    const lane_float scale = LANES_SELECT(inside, exact_reciprocal(cube), (lane_float)0.0f);
    for (int c = 0; c < 3; ++c) light[c] = fma((lane_float)radiance[c], scale, light[c]);
}

/// Multiplies the light of a map by the weight of rays that ran into it, where other rays are sent
/// to it: the two ways to find it share it (Veach & Guibas 1995).
static inline void share_sky_light(const SkyMap* map, Vector way, const RayBatch* batch, uint first,
                                   lane_float* light) {
    const uint stride = batch->stride;
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    const lane_uint state = LANES_LOAD(batch->paths, VXL_PATH_STATE * stride + first);
    const lane_uint word = LANES_LOAD(batch->paths, VXL_PATH_EMITTER * stride + first);
    const lane_int sent = LANE_MASK((state & VXL_STATE_TO_EMITTER) != 0u);
    const lane_int ran_in = ~sent & LANE_MASK(word != 0u);
    const lane_float own = LANES_AS_FLOAT(word);
    const lane_float other = sky_map_density(map, way) * map->of.chance;
    const lane_float all = LANES_SELECT(ran_in, own + other, one);
    lane_float share = LANES_SELECT(LANE_MASK(other > 0.0f), zero, one);
    if (VXL_SKY_RAYS == VXL_EMITTERS_BOTH)
        share = exact_divide(LANES_SELECT(ran_in, own, one), all);
    share = LANES_SELECT(ran_in, share, one);
    share = LANES_SELECT(sent & LANE_MASK(word != VXL_EMITTER_IS_SKY), zero, share);
    for (int c = 0; c < 3; ++c) light[c] *= share;
}

/// Mask: rays that see the background instead of a hidden sky: those that an observer sends and
/// nothing has scattered.
static inline lane_int sees_background(const RayBatch* batch, uint first, uint from_observer) {
    if (!VXL_GLOBAL) return (lane_int)(from_observer ? -1 : 0);
    const lane_uint state = LANES_LOAD(batch->paths, VXL_PATH_STATE * batch->stride + first);
    return LANE_MASK(((state >> VXL_STATE_BOUNCE_SHIFT) & VXL_STATE_BOUNCES) == 0u);
}

/// The radiance of the sky along `way`, in voxels with this edge. The sun's disc is seen by rays
/// that no matt surface has scattered last; matt surfaces sample it as a light.
static inline void see_sky(lane_int hit, Vector direction, float4 edge, const SkyView* sky,
                           const RayBatch* batch, uint first, uint from_observer,
                           lane_float* light) {
    const Vector way = unit(scaled(direction, edge));
    lane_float seen[3];
    sky_light(sky, way, seen);
    if (VXL_SKY_RAYS) share_sky_light(&sky->map, way, batch, first, seen);
    if (VXL_SKY == VXL_SKY_SUN) {
        lane_int sees = ~hit;
        if (VXL_GLOBAL) {
            const lane_uint state =
                LANES_LOAD(batch->paths, VXL_PATH_STATE * batch->stride + first);
            sees &= LANE_MASK((state & VXL_STATE_DIFFUSE) == 0u);
        }
        add_sun_disc(sky->record, way, sees, seen);
    }
    lane_int behind = (lane_int)0;
    if (VXL_SKY_HIDDEN) behind = sees_background(batch, first, from_observer);
    for (int c = 0; c < 3; ++c)
        light[c] = VXL_SKY_HIDDEN ? LANES_SELECT(behind, light[c], seen[c]) : seen[c];
}

#endif
