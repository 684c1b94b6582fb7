// SPDX-License-Identifier: Apache-2.0
// Points of lights with an area.
#ifndef VXL_AREA_POINTS_H
#define VXL_AREA_POINTS_H

#include "lib/light/path_samples.h"
#include "lib/sampling/directions.h"
#include "shared/scene.h"

/// The points of light number `number` that the paths' samples choose, all of which are equally
/// probable, in voxels.
static inline Vector area_point(LightRecord light, LightAreaRecord area, const PathSamples* samples,
                                uint number) {
    SquarePoint p = path_point(samples, VXL_DECISION_LIGHT + number);
    if (area.axis_x.w != 0.0f) {
        p = disk_point(p);
    } else {
        p.x = fma(p.x, 2.0f, -1.0f);
        p.y = fma(p.y, 2.0f, -1.0f);
    }
    const Vector from = {fma(p.x, area.axis_x.x, fma(p.y, area.axis_y.x, light.position.x)),
                         fma(p.x, area.axis_x.y, fma(p.y, area.axis_y.y, light.position.y)),
                         fma(p.x, area.axis_x.z, fma(p.y, area.axis_y.z, light.position.z))};
    return from;
}

#endif
