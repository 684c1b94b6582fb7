// SPDX-License-Identifier: Apache-2.0
// Hits on instances in the instances' own voxels.
#ifndef VXL_INSTANCE_HIT_H
#define VXL_INSTANCE_HIT_H

#include "lib/traverse/transformed_ray.h"

/// A ray in the voxels that its hit is in, and the map of gradients from there to the world's
/// voxels.
typedef struct {
    Vector origin, direction;
    lane_float t;
    lane_float map[9];  // object_from_world of the instance; zeros for other hits
} HitRay;

/// Transforms the ray of each lane of `of_instance` to the space of its instance. Other rays are
/// unchanged and get a map of zeros, because uninitialised numbers must not reach a built-in
/// function, even if its result is not used.
static inline HitRay transform_hits(global const InstanceRecord* restrict records,
                                    lane_uint instance, lane_int of_instance, HitRay in_world) {
    HitRay ray = in_world;
    const Vector o = ray.origin, d = ray.direction;
    const lane_float inverse_squared = exact_reciprocal(dot_product(d, d));
    const lane_float t = ray.t;
    for (int i = 0; i < 9; ++i) ray.map[i] = (lane_float)0.0f;
    lane_int left = of_instance;
    while (lanes_any(left)) {
        const uint one = lanes_min(LANES_SELECT(left, instance, (lane_uint)0xFFFFFFFFu));
        const lane_int same = left & LANE_MASK(instance == one);
        left &= ~same;
        global const InstanceRecord* r = records + one;
        const BoxPassage way = pass_box(r, o, d, inverse_squared, (lane_float)0.0f);
        const TransformedRay c = transform_ray(r, &way);
        ray.origin = select_vector(same, c.origin, ray.origin);
        ray.direction = select_vector(same, c.direction, ray.direction);
        ray.t = LANES_SELECT(same, transformed_t(&c, t), ray.t);
        for (int i = 0; i < 9; ++i)
            ray.map[i] = LANES_SELECT(same, (lane_float)r->object_from_world[i], ray.map[i]);
    }
    return ray;
}

/// Transforms a gradient in the voxels of a hit to the world's voxels, in the lanes of
/// `of_instance`.
static inline Vector world_gradient(const HitRay* ray, Vector g, lane_int of_instance) {
    const lane_float* m = ray->map;
    const Vector transformed = {fma(m[0], g.x, fma(m[3], g.y, m[6] * g.z)),
                                fma(m[1], g.x, fma(m[4], g.y, m[7] * g.z)),
                                fma(m[2], g.x, fma(m[5], g.y, m[8] * g.z))};
    return select_vector(of_instance, transformed, g);
}

#endif
