// SPDX-License-Identifier: Apache-2.0
// The light that the medium of S removes and adds along a part of a ray.
#ifndef VXL_VEIL_H
#define VXL_VEIL_H

#include "lib/lanes/exact_exp.h"
#include "lib/traverse/segment.h"
#include "shared/scene.h"

/// The sum of density times t along the segments of the `active` lanes.
static inline lane_float density_along(PyramidShape shape, const DensityView* density,
                                       const Segment* s, lane_int active) {
    if (!VXL_MEDIUM_GRID) return length_in_world(shape, s);
    const PyramidView p = grid_view(shape);
    Walk walk = walk_along(s);
    return walk_density(&p, density, &walk, s->t_first, s->t_last, active);
}

/// The effect on light of a medium whose colour varies from voxel to voxel, channel by channel.
typedef struct {
    lane_float depth, lost;       // sum of density times metres, as in add_exactly
    lane_float transmittance[3];  // share of the light behind that comes through
    lane_float emitted[3];        // radiance that the medium adds
} Veil;

/// Adds a stretch of a voxel, with its mean density and colour, behind all earlier stretches.
static inline void add_stretch(const DensityCell* cell, global const float* restrict colors,
                               const float* absorption, lane_float depth, lane_int adding,
                               Veil* veil) {
    add_exactly(&veil->depth, &veil->lost, depth, adding);
    for (int channel = 0; channel < 3; ++channel) {
        const lane_float color = LANES_GATHER_FLOAT(colors, cell->index * 3u + (uint)channel);
        const lane_float shown =
            veil->transmittance[channel] * exact_rise(absorption[channel] * depth);
        veil->emitted[channel] = fma(shown, color, veil->emitted[channel]);
        veil->transmittance[channel] = exact_exp(-absorption[channel] * (veil->depth - veil->lost));
    }
}

/// The veil of the medium along the segments of the `active` lanes.
static inline Veil veil_of(PyramidShape shape, const DensityView* density,
                           global const float* restrict colors, const float* absorption,
                           const Segment* s, lane_int active) {
    Veil veil;
    veil.depth = veil.lost = (lane_float)0.0f;
    for (int channel = 0; channel < 3; ++channel) {
        veil.transmittance[channel] = (lane_float)1.0f;
        veil.emitted[channel] = (lane_float)0.0f;
    }
    const PyramidView p = grid_view(shape);
    Walk walk = walk_along(s);
    const lane_float metres = metres_per_t(shape.edge, s->direction);
    lane_float entered = s->t_first, entered_low = (lane_float)0.0f;
    lane_int walking = active & in_grid(&p, &walk) & LANE_MASK(s->t_first < s->t_last);
    while (lanes_any(walking)) {
        const DensityCell cell = look_up_density(density, walk.x, walk.y, walk.z, walking);
        const Stretch stretch = cross_cell(&p, density, &walk, &cell, s->t_first, s->t_last,
                                           &entered, &entered_low, walking);
        const lane_float depth = cell.density * stretch.length * metres;
        const lane_int counts = stretch.counts & LANE_MASK(depth > 0.0f);
        if (lanes_any(counts))
            add_stretch(&cell, colors, absorption, LANES_SELECT(counts, depth, (lane_float)0.0f),
                        counts, &veil);
        walking &= ~stretch.ends & in_grid(&p, &walk);
    }
    return veil;
}

/// The effect on light of any kind of medium, from the start of the `active` rays to the surfaces
/// that they met.
static inline Veil veil_before(PyramidShape shape, Environment environment,
                               const DensityView* density, global const float* restrict colors,
                               const Segment* s, lane_int active) {
    const float absorption[3] = {environment.absorption.x, environment.absorption.y,
                                 environment.absorption.z};
    if (VXL_MEDIUM_COLORS) return veil_of(shape, density, colors, absorption, s, active);
    const float color[3] = {environment.color.x, environment.color.y, environment.color.z};
    const lane_float metres = metres_per_t(shape.edge, s->direction);
    Veil veil;
    veil.depth =
        LANES_SELECT(active, density_along(shape, density, s, active) * metres, (lane_float)0.0f);
    veil.lost = (lane_float)0.0f;
    for (int channel = 0; channel < 3; ++channel) {
        const lane_float tau = absorption[channel] * veil.depth;
        veil.transmittance[channel] = exact_exp(-tau);
        veil.emitted[channel] = color[channel] * exact_rise(tau);
    }
    return veil;
}

#endif
