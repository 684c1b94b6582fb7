// SPDX-License-Identifier: Apache-2.0
// The light that sources send to points in a medium, and the shadow rays that decide whether it
// arrives.
#ifndef VXL_MEDIUM_LIGHT_H
#define VXL_MEDIUM_LIGHT_H

#include "lib/light/direct_light.h"
#include "lib/light/phase.h"
#include "lib/medium/medium_point.h"

/// Adds the light that a source sends to points in the medium and that the medium scatters towards
/// the viewer. `from` holds points of the source, which is around `middle`, or, for a directional
/// light, the vectors that lead to it. Every point in the medium gets a slot in the queue of shadow
/// rays. A light's intensity is pi times its power per solid angle, as for Lambertian surfaces.
static inline void shine_into_medium(PyramidShape shape, const Light* light, Vector middle,
                                     Vector from, float g, const ShadowQueue* queue,
                                     const RayBatch* batch, uint first, lane_int valid) {
    const uint stride = batch->stride;
    const float4 edge = shape.edge;
    const Vector at = load_vector(batch->rays, stride, first);
    const Vector way =
        unit(scaled(load_vector(batch->rays + VXL_RAY_DX * stride, stride, first), edge));
    const Vector nowhere = {(lane_float)0.0f, (lane_float)0.0f, (lane_float)0.0f};
    Incidence i;
    i.to_light = light->kind == VXL_LIGHT_DIRECTIONAL ? from : difference(from, at);
    const Vector metric = scaled(i.to_light, edge);
    const lane_float squared = dot_product(metric, metric);
    i.lit = valid & LANE_MASK(squared > 0.0f);
    i.l = unit(metric);
    i.falloff = falloff_of(light, i.l, squared, i.lit);
    i.lit &= LANE_MASK(i.falloff > 0.0f);
    if (!lanes_any(i.lit)) return;
    LitRays r;
    aim_at_light(shape, light, &i, at, nowhere, &r);
    lane_float scattered = 3.14159265f * phase_density(g, dot_product(way, i.l)) * i.falloff;
    if (VXL_NEAR_LIGHT && light->kind != VXL_LIGHT_DIRECTIONAL)
        scattered *= chance_weight(light, edge, scaled(difference(middle, at), edge), way,
                                   batch->hits, stride, first, i.lit);
    for (int c = 0; c < 3; ++c) r.contribution[c] = scattered * light->intensity[c];
    queue_rays(queue, &r, i.lit, (lane_uint)VXL_NO_PRIMITIVE, stride, first);
}

#endif
