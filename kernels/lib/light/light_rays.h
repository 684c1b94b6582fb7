// SPDX-License-Identifier: Apache-2.0
// Rays from surface points to light sources: to an emitter, or to a sky that is a map.
#ifndef VXL_LIGHT_RAYS_H
#define VXL_LIGHT_RAYS_H

#include "lib/light/emitters.h"
#include "lib/light/path_samples.h"
#include "lib/light/sky_map.h"

/// The map's parameters, where paths send rays to it. A comma ends them.
#if VXL_SKY_RAYS
#define VXL_SOUGHT_SKY_PARAMETERS VXL_SKY_MAP_PARAMETERS
#define VXL_SOUGHT_SKY VXL_SKY_MAP_VIEW
#else
#define VXL_SOUGHT_SKY_PARAMETERS
#define VXL_SOUGHT_SKY \
    { {0, 0, 0, 0, 0, 0, 0, 0}, 0, 0 }
#endif

/// Chooses for each path where it looks for light, seen from `origin` in the world's voxels.
static inline EmitterRays choose_light(const Emitters* emitters, const SkyMap* sky,
                                       const PathSamples* samples, Vector origin, float4 edge) {
    const SquareBits choice = path_bits(samples, VXL_DECISION_EMITTER);
    EmitterRays s = {(lane_int)0,
                     (lane_uint)VXL_EMITTER_IS_SKY,
                     {(lane_float)0.0f, (lane_float)1.0f, (lane_float)0.0f},
                     (lane_float)1.0f,
                     (lane_float)0.0f};
    lane_int is_sky = (lane_int)-1;
    if (VXL_EMITTERS && emitters->count) {
        s = choose_emitter(emitters, origin, edge, choice,
                           path_point(samples, VXL_DECISION_EMITTER_POINT));
        is_sky = (lane_int)0;
        if (VXL_SKY_RAYS)
            is_sky =
                LANE_MASK(path_point(samples, VXL_DECISION_SKY).x < (lane_float)sky->of.chance);
    }
    if (!VXL_SKY_RAYS) return s;
    lane_float density;
    const Vector way = choose_sky_direction(sky, choice, &density);
    density *= sky->of.chance;
    s.found = LANES_SELECT(is_sky, LANE_MASK(density > 0.0f), s.found);
    s.number = LANES_SELECT(is_sky, (lane_uint)VXL_EMITTER_IS_SKY, s.number);
    s.direction = select_vector(is_sky, way, s.direction);
    s.density = LANES_SELECT(is_sky, density, s.density);
    return s;
}

#endif
