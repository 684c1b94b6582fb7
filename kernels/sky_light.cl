// SPDX-License-Identifier: Apache-2.0
// surface points + the sky -> a queue of shadow rays into it: local light's share of skylight.
#include "lib/lanes/work_item.h"
#include "lib/light/direct_light.h"
#include "lib/light/directions.h"
#include "lib/light/sky.h"

/// Adds the sky's light from direction `number` of `directions` above each surface point. They are
/// as dense as the cosine with the normal; the place of the point chooses them, so the same point
/// has the same light in every image.
kernel void add_sky_light(VXL_WORLD_PARAMETERS, global const SkyRecord* restrict sky, uint number,
                          uint directions, global const float* restrict materials,
                          VXL_SHADOW_QUEUE_PARAMETERS, VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const WorldView world = VXL_WORLD;
    const RayBatch batch = VXL_BATCH;
    const ShadowQueue queue = VXL_SHADOW_QUEUE;
    LitPoints p;
    if (!load_lit_points(&world, &batch, first, &p)) return;
    const lane_uint place =
        mixed_bits(mixed_bits(LANES_AS_UINT(p.position.x)) + LANES_AS_UINT(p.position.y));
    const lane_uint seed = decision_seed(place, LANES_AS_UINT(p.position.z));
    const Vector way = cosine_direction(p.shading_normal, sobol_point((lane_uint)number, seed));
    LightRecord light;
    light.kind = VXL_LIGHT_DIRECTIONAL;
    Incidence incidence;
    incidence.lit = p.lit;
    incidence.l = way;
    incidence.to_light = scaled(way, shape.inverse_edge);
    const lane_int behind = start_off_surface(&world, &batch, first, light, &incidence, &p);
    if (!lanes_any(p.lit)) return;
    LitRays r;
    aim_at_light(shape, light, &incidence, p.start, p.normal, &r);
    lane_float from_sky[3];
    sky_light(sky, way, from_sky);
    const lane_float scale = LANES_GATHER_FLOAT(materials, p.material + VXL_MATERIAL_DIFFUSE) *
                             surface_opacity(materials, p.material, p.colors) *
                             (1.0f / (float)directions);
    const lane_uint color_at =
        color_offset(materials, p.material, p.position.x, p.position.y, p.position.z);
    lane_int some = (lane_int)0;
    for (int c = 0; c < 3; ++c) {
        r.contribution[c] = surface_color(materials, color_at, p.colors, c) * from_sky[c] * scale;
        some |= LANE_MASK(r.contribution[c] > 0.0f);
    }
    send_or_add(&queue, &r, p.lit & some, behind, &batch, first);
}
