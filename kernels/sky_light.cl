// SPDX-License-Identifier: Apache-2.0
// surface points + the sky -> a queue of shadow rays into it: the skylight that local light
// includes.
#include "lib/lanes/work_item.h"
#include "lib/light/direct_light.h"
#include "lib/light/sky.h"
#include "lib/sampling/directions.h"

/// A number that depends on the point alone, and so is equal in every image.
static inline lane_uint seed_of_point(Vector position) {
    const lane_uint hash =
        mixed_bits(mixed_bits(LANES_AS_UINT(position.x)) + LANES_AS_UINT(position.y));
    return decision_seed(mixed_number(hash), LANES_AS_UINT(position.z));
}

/// A direction to a sky map. Directions with an even `number` are chosen by the cosine with the
/// normal, those with an odd one by the map's brightness. Sets `weight` so that both choices
/// together count all light once.
static inline Vector direction_to_map(const SkyMap* map, Vector normal, uint number,
                                      uint directions, lane_uint seed, lane_float* weight) {
    const float to_map = (float)(directions / 2), evenly = (float)(directions - directions / 2);
    Vector way;
    lane_float density;
    if (number & 1u) {
        way = choose_sky_direction(map, sobol_bits((lane_uint)(number / 2), ~seed), &density);
    } else {
        way = cosine_direction(normal, sobol_point((lane_uint)(number / 2), seed));
        density = sky_map_density(map, way);
    }
    const lane_float cosine = fmax(dot_product(normal, way), 0.0f) * 0.318309886f;
    const lane_float all = fma((lane_float)evenly, cosine, to_map * density);
    const lane_int some = LANE_MASK(all > 0.0f) & LANE_MASK(cosine > 0.0f);
    *weight = LANES_SELECT(some, exact_divide(cosine, LANES_SELECT(some, all, (lane_float)1.0f)),
                           (lane_float)0.0f);
    return way;
}

/// Adds the sky's light from direction `number` of `directions` above each surface point.
/// Directions are distributed by the cosine with the normal; with a map, half of them are
/// distributed by the map's brightness. The point's position chooses them, so a point has the same
/// light in every image.
kernel void add_sky_light(VXL_WORLD_PARAMETERS, VXL_SKY_PARAMETERS uint number, uint directions,
                          global const float* restrict materials, VXL_SHADOW_QUEUE_PARAMETERS,
                          VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const WorldView world = VXL_WORLD;
    const RayBatch batch = VXL_BATCH;
    const ShadowQueue queue = VXL_SHADOW_QUEUE;
    const SkyView around = VXL_SKY_VIEW;
    LitPoints p;
    if (!load_lit_points(&world, &batch, first, &p)) return;
    const lane_uint seed = seed_of_point(p.position);
    lane_float weight = exact_reciprocal((lane_float)directions);
    Vector way;
    if (VXL_SKY == VXL_SKY_MAP)
        way = direction_to_map(&around.map, p.shading_normal, number, directions, seed, &weight);
    else
        way = cosine_direction(p.shading_normal, sobol_point((lane_uint)number, seed));
    Light light;
    light.kind = VXL_LIGHT_DIRECTIONAL;
    Incidence incidence;
    incidence.lit = p.lit;
    incidence.l = way;
    incidence.to_light = scaled(way, shape.inverse_edge);
    const lane_int behind = start_off_surface(&world, &batch, first, &light, &incidence, &p);
    if (!lanes_any(p.lit)) return;
    LitRays r;
    aim_at_light(shape, &light, &incidence, p.start, p.normal, &r);
    lane_float from_sky[3];
    sky_light(&around, way, from_sky);
    const lane_float scale = surface_diffuse(materials, p.material, p.colors) *
                             surface_opacity(materials, p.material, p.colors) * weight;
    const lane_uint color_at =
        color_offset(materials, p.material, p.position.x, p.position.y, p.position.z);
    lane_int some = (lane_int)0;
    for (int c = 0; c < 3; ++c) {
        r.contribution[c] = surface_color(materials, color_at, p.colors, c) * from_sky[c] * scale;
        some |= LANE_MASK(r.contribution[c] > 0.0f);
    }
    send_or_add(&queue, &r, p.lit & some, behind, &batch, first);
}
