// SPDX-License-Identifier: Apache-2.0
// The light that the medium of S, and the objects that rays go through, remove along a part of a
// ray.
#ifndef VXL_SIGHT_LOSS_H
#define VXL_SIGHT_LOSS_H

#include "lib/medium/veil.h"
#include "lib/traverse/surroundings.h"
#include "shared/scene.h"

/// In the `open` lanes, the density of the medium of S times metres along each segment; in lanes in
/// objects, metres alone.
static inline lane_float sight_depth(PyramidShape shape, const DensityView* density,
                                     const Segment* segment, lane_int open, lane_int in_object) {
    lane_float depth = (lane_float)0.0f;
    if (VXL_MEDIUM) depth = density_along(shape, density, segment, open);
    if (VXL_TRANSMISSION && lanes_any(in_object))
        depth = LANES_SELECT(in_object, length_in_world(shape, segment), depth);
    return LANES_SELECT(open | in_object, depth * metres_per_t(shape.edge, segment->direction),
                        (lane_float)0.0f);
}

/// The absorption of a material in a channel, per metre.
static inline lane_float material_absorption(global const float* materials, lane_uint material,
                                             lane_int in_object, int channel) {
    const lane_uint record = (material - 1u) * VXL_MATERIAL_FLOATS;
    return LANES_GATHER_FLOAT(
        materials, (record + (uint)(VXL_MATERIAL_ABSORPTION + channel)) & LANES_AS_UINT(in_object));
}

/// Sets the share of light that is left behind the segments of the `active` lanes. Their rays are
/// inside the `material` of an object, or in the medium, where they also lose the light that it
/// scatters.
static inline void let_through(PyramidShape shape, const Surroundings* around,
                               const Segment* segment, lane_uint material, lane_int active,
                               lane_float* share) {
    const lane_int in_object = LANE_MASK(material != 0u) & active;
    const lane_float depth =
        sight_depth(shape, &around->medium.density, segment, active & ~in_object, in_object);
    const float4 lost = around->medium.absorption;
    const float absorption[3] = {lost.x, lost.y, lost.z};
    for (int channel = 0; channel < 3; ++channel) {
        lane_float per_metre = (lane_float)absorption[channel];
        if (VXL_TRANSMISSION)
            per_metre = LANES_SELECT(
                in_object, material_absorption(around->materials, material, in_object, channel),
                per_metre);
        share[channel] = exact_exp(-per_metre * depth);
    }
}

#endif
