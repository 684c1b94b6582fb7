// SPDX-License-Identifier: Apache-2.0
// The light of rays that were aimed at display voxels, as voxels store it.
#ifndef VXL_VOXEL_LIGHT_H
#define VXL_VOXEL_LIGHT_H

#include "lib/lanes/vector.h"
#include "lib/light/paths.h"
#include "lib/medium/space_medium.h"
#include "lib/medium/veil.h"
#include "lib/traverse/ray_batch.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

// The smallest transmittance of the medium by which a surface's light is divided to remove the
// medium before it. The medium's own light has three rounding errors of 2^-24 by then, and dividing
// by this limit makes them 18 % of it; through more medium, nothing but rounding errors would
// remain.
#define VXL_MIN_TRANSMITTANCE 1e-6f

/// What a packet's rays see of their surfaces.
typedef struct {
    lane_int hit;  // mask: the ray meets a surface
    lane_float color[3];
    lane_float opacity;
    Vector point;  // in the world's voxels
} SeenLight;

/// The light of rays first .. first + VXL_LANES - 1. The medium between a ray's start and its
/// surface is removed. Where surfaces let light through, the nodes hold the surface's own light and
/// coverage.
static inline SeenLight seen_light(PyramidShape shape, const SpaceMedium* medium,
                                   const RayBatch* batch, const NodeLight* nodes, uint first) {
    const uint stride = batch->stride;
    SeenLight s;
    s.hit = LANE_MASK(LANES_LOAD(batch->hits, VXL_HIT_VOXEL * stride + first) != VXL_NO_VOXEL);
    s.opacity = (lane_float)1.0f;
    if (VXL_TRANSMISSION) {
        s.opacity = LANES_LOAD(nodes->coverage, first);
        s.hit &= LANE_MASK(s.opacity > 0.0f);
        s.opacity = LANES_SELECT(s.hit, s.opacity, (lane_float)1.0f);
    }
    s.point = load_vector(batch->positions, stride, first);
    Veil veil;
    if (VXL_MEDIUM) {
        const lane_float t = LANES_AS_FLOAT(LANES_LOAD(batch->hits, VXL_HIT_T * stride + first));
        const Segment before = {load_vector(batch->rays, stride, first),
                                load_vector(batch->rays + VXL_RAY_DX * stride, stride, first),
                                (lane_float)0.0f, LANES_SELECT(s.hit, t, (lane_float)0.0f)};
        veil = veil_before(shape, medium->environment, &medium->density, medium->colors, &before,
                           s.hit);
    }
    for (uint channel = 0; channel < 3; ++channel) {
        lane_float value = LANES_LOAD(nodes->radiance, channel * nodes->stride + first);
        if (VXL_MEDIUM) {
            const lane_float transmittance =
                fmax(veil.transmittance[channel], VXL_MIN_TRANSMITTANCE);
            value = fmax(exact_divide(value - veil.emitted[channel], transmittance), 0.0f);
        }
        if (VXL_TRANSMISSION) value = exact_divide(value, s.opacity);
        s.color[channel] = LANES_SELECT(s.hit, value, (lane_float)0.0f);
    }
    return s;
}

#endif
