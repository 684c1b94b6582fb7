// SPDX-License-Identifier: Apache-2.0
// Points near a surface -> the closest points on the surface.
#ifndef VXL_PROJECT_H
#define VXL_PROJECT_H

#include "lib/lanes/vector.h"
#include "lib/solid/solid.h"
#include "lib/solid/solid_surface.h"
#include "lib/surface/field.h"
#include "shared/scene.h"
#include "shared/trace.h"

#define VXL_PROJECT_STEPS 6

/// Moves the points p, within voxels, onto the fields' surfaces by Newton's method. `g` becomes the
/// gradient there, `left` the remaining distance in voxels.
static inline void project_on_field(const Field* f, Vector* p, Vector* g, lane_float* left) {
    for (int step = 0; step <= VXL_PROJECT_STEPS; ++step) {
        const lane_float value = field_value(f, p->x, p->y, p->z);
        field_gradient(f, p->x, p->y, p->z, &g->x, &g->y, &g->z);
        const lane_float squared = dot_product(*g, *g);
        const lane_int sloped = LANE_MASK(squared > 0.0f);
        const lane_float share = LANES_SELECT(
            sloped, exact_divide(value, LANES_SELECT(sloped, squared, (lane_float)1.0f)),
            (lane_float)0.0f);
        *left =
            LANES_SELECT(sloped, fabs(value) * (1.0f / VXL_DISTANCE_UNITS), (lane_float)INFINITY);
        if (step == VXL_PROJECT_STEPS) return;
        p->x = clamp(fma(-share, g->x, p->x), -0.5f, 1.5f);
        p->y = clamp(fma(-share, g->y, p->y), -0.5f, 1.5f);
        p->z = clamp(fma(-share, g->z, p->z), -0.5f, 1.5f);
    }
}

/// Moves the points p onto the surface of solid `number` by steps along its normal; `g` and `left`
/// are as in project_on_field.
static inline void project_on_solid(PyramidShape shape, global const SolidShape* solids,
                                    uint number, lane_int x, lane_int y, lane_int z, Vector* p,
                                    Vector* g, lane_float* left) {
    const float shortest = fmin(shape.edge.x, fmin(shape.edge.y, shape.edge.z));
    for (int step = 0; step <= VXL_PROJECT_STEPS; ++step) {
        const LatticePoint at = {x, y, z, p->x, p->y, p->z};
        const SolidDistance distance = solid_distance(solids, number, at);
        // With t = 0, solid_normal evaluates the origin of the ray, so the direction doesn't
        // matter.
        const SolidRay ray = {LANES_FLOAT(x) + p->x, LANES_FLOAT(y) + p->y, LANES_FLOAT(z) + p->z,
                              (lane_float)1.0f,      (lane_float)0.0f,      (lane_float)0.0f};
        const SolidPoint gradient = solid_normal(solids, number, &ray, (lane_float)0.0f);
        g->x = gradient.x, g->y = gradient.y, g->z = gradient.z;
        *left = fabs(distance.distance);
        if (step == VXL_PROJECT_STEPS) return;
        const Vector slope = {g->x * shape.inverse_edge.x, g->y * shape.inverse_edge.y,
                              g->z * shape.inverse_edge.z};
        const Vector n = unit(slope);
        const lane_float metres = distance.distance * shortest;
        p->x = clamp(fma(-metres * n.x, shape.inverse_edge.x, p->x), -0.5f, 1.5f);
        p->y = clamp(fma(-metres * n.y, shape.inverse_edge.y, p->y), -0.5f, 1.5f);
        p->z = clamp(fma(-metres * n.z, shape.inverse_edge.z, p->z), -0.5f, 1.5f);
    }
}

#endif
