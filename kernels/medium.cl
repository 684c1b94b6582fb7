// SPDX-License-Identifier: Apache-2.0
// radiance at surfaces -> radiance at the rays' starts: the light that the medium of S, and of
// objects that rays go through, absorbs and adds.
//
// The density of the medium scales its absorption alone, so one number describes a ray's whole way:
// the sum of density times length.
//     transmittance = exp(-absorption * sum), emitted = color * (1 - transmittance).
#include "lib/lanes/exact_exp.h"
#include "lib/lanes/work_item.h"
#include "lib/light/phase.h"
#include "lib/medium/sight_loss.h"
#include "lib/medium/veil.h"
#include "shared/scene.h"
#include "shared/trace.h"

/// Mask: lanes whose rays are followed. Slots beyond the queue's end hold stale rays.
lane_int followed_lanes(const RayBatch* batch, uint first, uint count) {
    return LANE_MASK(LANES_LOAD(batch->rays, VXL_RAY_END * batch->stride + first) >= 0.0f) &
           LANE_MASK(LANES_AS_INT(LANES_NUMBERS + (int)first) < (int)count);
}

/// The part of a channel's light that a coloured medium lets through. Rays sent to emitters,
/// `looks`, also lose the light that the medium scatters.
lane_float veil_transmittance(const Veil* veil, MediumScattering scattered, lane_int looks,
                              int channel) {
    lane_float transmittance = veil->transmittance[channel];
    if (VXL_SCATTERING && VXL_LOOKS) {
        const lane_float turned =
            exact_exp(-scattered.per_metre[channel] * (veil->depth - veil->lost));
        transmittance *= LANES_SELECT(looks, turned, (lane_float)1.0f);
    }
    return transmittance;
}

/// Applies the medium between the start of each ray, or of its segment, and its end to the ray's
/// radiance. Writes the part of the light that comes through to `transmittance`.
kernel void absorb_sight(PyramidShape shape, Environment environment,
                         VXL_SCATTERING_PARAMETER VXL_DENSITY_PARAMETERS,
                         global const float* restrict density_colors,
                         global const float* restrict materials, VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const DensityView density = VXL_DENSITY;
    const RayBatch batch = VXL_BATCH;
    const lane_int active = followed_lanes(&batch, first, count);
    const Segment segment = sight_segment(&batch, first);
    lane_uint material = (lane_uint)0u;
    if (VXL_TRANSMISSION) material = LANES_LOAD(inside, first);
    const lane_int in_object = LANE_MASK(material != 0u) & active;
    const lane_int open = VXL_MEDIUM_COLORS ? (lane_int)0 : active & ~in_object;
    const lane_float depth = sight_depth(shape, &density, &segment, open, in_object);
    lane_float shows = (lane_float)1.0f;  // the medium's own light
    lane_int looks = (lane_int)0;
    if (VXL_LOOKS) {
        const lane_uint state = LANES_LOAD(paths, VXL_PATH_STATE * stride + first);
        looks = LANE_MASK((state & VXL_STATE_TO_EMITTER) != 0u);
        shows = LANES_SELECT(looks, (lane_float)0.0f, shows);
    }
    const float absorption[3] = {environment.absorption.x, environment.absorption.y,
                                 environment.absorption.z};
    const float color[3] = {environment.color.x, environment.color.y, environment.color.z};
    const MediumScattering scattered = VXL_MEDIUM_SCATTERING;
    Veil veil;
    if (VXL_MEDIUM_COLORS)
        veil = veil_of(shape, &density, density_colors, absorption, &segment, active & ~in_object);
    for (int channel = 0; channel < 3; ++channel) {
        const uint index = (uint)channel * stride + first;
        lane_float per_metre = (lane_float)absorption[channel];
        // The medium scatters paths by chance, but rays sent to emitters lose the scattered part.
        if (VXL_SCATTERING && VXL_LOOKS)
            per_metre +=
                LANES_SELECT(looks, (lane_float)scattered.per_metre[channel], (lane_float)0.0f);
        lane_float shown = (lane_float)color[channel];
        if (VXL_LOOKS) shown *= shows;
        if (VXL_TRANSMISSION && lanes_any(in_object)) {
            per_metre = LANES_SELECT(
                in_object, material_absorption(materials, material, in_object, channel), per_metre);
            shown = LANES_SELECT(in_object, (lane_float)0.0f, shown);
        }
        const lane_float tau = per_metre * depth;
        lane_float weight = exact_exp(-tau), added = shown * exact_rise(tau);
        if (VXL_MEDIUM_COLORS) {
            weight = LANES_SELECT(in_object, weight,
                                  veil_transmittance(&veil, scattered, looks, channel));
            added = LANES_SELECT(in_object, added, veil.emitted[channel] * shows);
        }
        const lane_float behind = LANES_LOAD(radiance, index);
        LANES_STORE(fma(weight, behind, added), radiance, index);
        if (VXL_PATHS) LANES_STORE(weight, transmittance, index);
    }
}

/// Removes the light that the medium absorbs from the queue of shadow rays. Without shadows, adds
/// the rest to the radiance of the targets, each of which stands in the queue at most once.
kernel void absorb_shadows(PyramidShape shape, Environment environment, VXL_DENSITY_PARAMETERS,
                           VXL_SHADOW_QUEUE_PARAMETERS, VXL_BATCH_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    const ShadowQueue queue = VXL_SHADOW_QUEUE;
    const RayBatch batch = VXL_BATCH;
    const uint count = *queue.count;
    if (first >= count) return;
    const DensityView density = VXL_DENSITY;
    const lane_int active = LANE_MASK(LANES_AS_INT(LANES_NUMBERS + (int)first) < (int)count);
    // Slots beyond the queue's end hold stale rays.
    const Segment segment = {load_vector(queue.rays, stride, first),
                             load_vector(queue.rays + VXL_RAY_DX * stride, stride, first),
                             (lane_float)0.0f,
                             LANES_LOAD(queue.rays, VXL_RAY_END * stride + first)};
    const lane_float metres = metres_per_t(shape.edge, segment.direction);
    const lane_float depth = density_along(shape, &density, &segment, active) * metres;
    const float absorption[3] = {environment.absorption.x, environment.absorption.y,
                                 environment.absorption.z};
    float arriving[3 * VXL_LANES];
    for (int channel = 0; channel < 3; ++channel) {
        const uint index = (uint)channel * stride + first;
        const lane_float weight =
            LANES_LOAD(queue.contributions, index) * exact_exp(-absorption[channel] * depth);
        if (VXL_SHADOWS)
            LANES_STORE(weight, queue.contributions, index);
        else
            LANES_STORE(weight, arriving, channel * VXL_LANES);
    }
    if (VXL_SHADOWS) return;
    for (uint lane = 0; lane < VXL_LANES && first + lane < count; ++lane)
        for (uint channel = 0; channel < 3; ++channel)
            batch.radiance[channel * stride + queue.targets[first + lane]] +=
                arriving[channel * VXL_LANES + lane];
}
