// SPDX-License-Identifier: Apache-2.0
// Points of lights with an area.
#ifndef VXL_AREA_POINTS_H
#define VXL_AREA_POINTS_H

#include "lib/light/path_samples.h"
#include "lib/sampling/directions.h"
#include "shared/scene.h"

/// The points at `p` of areas around `middle`, in voxels.
static inline Vector point_of_area(SquarePoint p, Vector middle, Vector axis_x, Vector axis_y) {
    const Vector at = {fma(p.x, axis_x.x, fma(p.y, axis_y.x, middle.x)),
                       fma(p.x, axis_x.y, fma(p.y, axis_y.y, middle.y)),
                       fma(p.x, axis_x.z, fma(p.y, axis_y.z, middle.z))};
    return at;
}

/// The points of light number `number` that the paths' samples choose, in voxels. All points are
/// equally probable.
static inline Vector area_point(LightRecord light, LightAreaRecord area, const PathSamples* samples,
                                uint number) {
    SquarePoint p = path_point(samples, VXL_DECISION_LIGHT + number);
    if (area.axis_x.w != 0.0f) {
        p = disk_point(p);
    } else {
        p.x = fma(p.x, 2.0f, -1.0f);
        p.y = fma(p.y, 2.0f, -1.0f);
    }
    return point_of_area(p, vector_of(light.position), vector_of(area.axis_x),
                         vector_of(area.axis_y));
}

/// Where rays run into a light.
typedef struct {
    lane_int met;        // mask: rays that do, on the side that emits light
    lane_float t;        // of the rays
    lane_float falloff;  // cosine / d^2 of the light there, seen from where the ray was scattered
} AreaMeeting;

/// Where rays run into a light. They were scattered `travelled` before their origins.
static inline AreaMeeting meet_area(LightRecord light, LightAreaRecord area, float4 edge,
                                    Vector origin, Vector direction, lane_float travelled) {
    const lane_float one = (lane_float)1.0f;
    const Vector off = {origin.x - light.position.x, origin.y - light.position.y,
                        origin.z - light.position.z};
    const Vector from = scaled(off, edge), way = scaled(direction, edge);
    const Vector axis_x = scaled(vector_of(area.axis_x), edge);
    const Vector axis_y = scaled(vector_of(area.axis_y), edge);
    const Vector normal = vector_of(light.direction);
    const lane_float before = dot_product(normal, from), towards = -dot_product(normal, way);
    AreaMeeting m;
    m.met = LANE_MASK(before > 0.0f) & LANE_MASK(towards > 0.0f);
    m.t = exact_divide(before, LANES_SELECT(m.met, towards, one));
    const Vector at = add_scaled(from, way, m.t);
    const lane_float x = exact_divide(dot_product(at, axis_x), dot_product(axis_x, axis_x));
    const lane_float y = exact_divide(dot_product(at, axis_y), dot_product(axis_y, axis_y));
    const lane_float radius = area.axis_x.w != 0.0f ? fma(x, x, y * y) : fmax(fabs(x), fabs(y));
    m.met &= LANE_MASK(radius <= 1.0f);
    const lane_float squared = dot_product(way, way), t = m.t + travelled;
    const lane_float length = t * t * squared * exact_sqrt(squared);
    m.met &= LANE_MASK(length > 0.0f);
    m.falloff = exact_divide(towards, LANES_SELECT(m.met, length, one));
    return m;
}

#endif
