// SPDX-License-Identifier: Apache-2.0
// The coverage of textured triangles where shadow rays meet them, and which surfaces have a body.
#ifndef VXL_TEXTURE_ALPHA_H
#define VXL_TEXTURE_ALPHA_H

#include "lib/surface/shading_normal.h"
#include "lib/surface/surface_color.h"
#include "lib/surface/texture_mean.h"
#include "lib/traverse/instance_hit.h"
#include "lib/traverse/world.h"
#include "shared/trace.h"

/// Mask: surfaces of bodies, which rays are inside of behind the surface. A surface that lets light
/// through only because of a texture's alpha is a sheet.
static inline lane_int have_bodies(global const float* restrict materials, lane_uint packed,
                                   lane_uint primitive, lane_int hit) {
    const lane_int triangle = LANE_MASK((primitive & VXL_SOLID_PRIMITIVE) == 0u) & hit;
    const lane_uint material = material_offset(packed) & LANES_AS_UINT(hit);
    return ~triangle | transmits(materials, material,
                                 LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_OPACITY));
}

/// The alpha of the textures at rays' hits; 1 where the surface wears none.
static inline lane_float alpha_of_hits(const WorldView* world, Vector origin, Vector direction,
                                       lane_float t, lane_uint primitive, lane_uint instance,
                                       lane_int hit) {
    const lane_float one = (lane_float)1.0f;
    const lane_int triangle = hit & LANE_MASK((primitive & VXL_SOLID_PRIMITIVE) == 0u);
    const lane_uint number = primitive & LANES_AS_UINT(triangle);
    const lane_uint worn = number * (uint)VXL_WORN_WORDS;
    global const uint* words = world->surface.triangle_textures;
    const lane_uint texture = LANES_GATHER_UINT(words, worn + (uint)VXL_WORN_TEXTURE);
    const lane_int wears = triangle & LANE_MASK(texture != VXL_NO_TEXTURE);
    if (!lanes_any(wears)) return one;
    HitRay ray;
    ray.origin = origin, ray.direction = direction;
    ray.t = LANES_SELECT(wears, t, (lane_float)0.0f);
    if (VXL_INSTANCES)
        ray = transform_hits(world->instances.records, instance,
                             wears & LANE_MASK(instance != VXL_NO_INSTANCE), ray);
    Vector from[3];
    lane_float weight[3], mean[4];
    for (uint i = 0; i < 3; ++i) {
        const Vector corner = triangle_corner(world->surface.triangles, number, i);
        from[i] = add_scaled(difference(ray.origin, corner), ray.direction, ray.t);
    }
    corner_weights(from, weight);
    TextureArea area;
    area.u = area.v = (lane_float)0.0f;
    for (uint i = 0; i < 3; ++i) {
        const lane_uint index = worn + (VXL_WORN_UVS + 2u * i);
        area.u = fma(weight[i], LANES_GATHER_FLOAT((global const float*)words, index), area.u);
        area.v = fma(weight[i], LANES_GATHER_FLOAT((global const float*)words, index + 1u), area.v);
    }
    for (int i = 0; i < 2; ++i)
        area.side_u[i] = area.side_v[i] = area.off[i] = area.lean[i] = (lane_float)0.0f;
    texture_mean(world->surface.textures, texture, &area, wears, mean);
    return LANES_SELECT(wears, mean[3], one);
}

#endif
