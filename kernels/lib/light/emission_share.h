// SPDX-License-Identifier: Apache-2.0
// The weight of an emissive surface's light for a ray that meets it, where rays are also sent to
// emitters: the two ways to find the light share it (Veach & Guibas 1995, the balance heuristic).
#ifndef VXL_EMISSION_SHARE_H
#define VXL_EMISSION_SHARE_H

#include "lib/light/emitters.h"
#include "lib/traverse/medium_set.h"
#include "lib/traverse/shaded_hit.h"
#include "shared/paths.h"
#include "shared/scene.h"

/// Mask: rays that end at an emitter and show nothing else.
static inline lane_int looks_for_emitter(const RayBatch* batch, uint first) {
    const lane_uint state = LANES_LOAD(batch->paths, VXL_PATH_STATE * batch->stride + first);
    return LANE_MASK((state & VXL_STATE_TO_EMITTER) != 0u);
}

/// Mask: rays that look for an emitter and go to the sky.
static inline lane_int goes_to_sky(const RayBatch* batch, uint first) {
    const lane_uint word = LANES_LOAD(batch->paths, VXL_PATH_EMITTER * batch->stride + first);
    return LANE_MASK(word == VXL_EMITTER_IS_SKY);
}

/// Mask: materials with emission.
static inline lane_int emits_light(global const float* restrict materials, lane_uint material) {
    lane_int emits = (lane_int)0;
    for (uint channel = 0; channel < 3; ++channel)
        emits |= LANE_MASK(
            LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_EMISSION + channel) > 0.0f);
    return emits;
}

/// The weight of the emission that rays find at their hits; 1 for hits that are not `asked` for. A
/// ray that ran into an emitter is weighted by the balance heuristic against a ray sent to it. A
/// ray that was sent counts only if it met its emitter; its weight is in its throughput.
static inline lane_float emission_share(const Emitters* e, const ShadedHit* h, float4 edge,
                                        const RayBatch* batch, uint first, lane_int asked) {
    const uint stride = batch->stride;
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    if (!e->count || !lanes_any(asked)) return one;
    const lane_int looks = looks_for_emitter(batch, first) & asked;
    const lane_uint word = LANES_LOAD(batch->paths, VXL_PATH_EMITTER * stride + first);
    const lane_int ran_in = asked & ~looks & LANE_MASK(word != 0u);
    lane_uint instance = (lane_uint)VXL_NO_INSTANCE;
    if (VXL_INSTANCES) instance = LANES_LOAD(batch->hits, VXL_HIT_INSTANCE * stride + first);
    const lane_uint number = emitter_at(e, h->voxel, instance, h->hit & (ran_in | looks));
    const lane_int known = h->hit & ran_in & LANE_MASK(number != VXL_NO_EMITTER);
    // A ray that was sent to an emitter chose it where the path was last scattered.
    Vector from = h->world_origin;
    if (VXL_TRAVELS) {
        const lane_float travelled =
            LANES_AS_FLOAT(LANES_LOAD(batch->paths, VXL_PATH_TRAVELLED * stride + first));
        from.x = fma(h->world_way.x, -travelled, from.x);
        from.y = fma(h->world_way.y, -travelled, from.y);
        from.z = fma(h->world_way.z, -travelled, from.z);
    }
    const BoxView box = view_box(e, number & LANES_AS_UINT(known), from);
    const Vector metric = scaled(h->world_way, edge);
    const lane_float sent =
        emitter_density(e, &box, h->world_way, exact_sqrt(dot_product(metric, metric)));
    const lane_int both = known & LANE_MASK(sent > 0.0f);
    const lane_float own = LANES_AS_FLOAT(word);
    lane_float share = zero;
    if (VXL_EMITTERS == VXL_EMITTERS_BOTH)
        share = exact_divide(LANES_SELECT(both, own, one), LANES_SELECT(both, own + sent, one));
    const lane_float met = LANES_SELECT(h->hit & LANE_MASK(number == word), one, zero);
    return LANES_SELECT(looks, met, LANES_SELECT(both, share, one));
}

#endif
