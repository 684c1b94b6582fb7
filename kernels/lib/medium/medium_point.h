// SPDX-License-Identifier: Apache-2.0
// Points in a medium that light comes from, stored as rays of a queue that begin there.
#ifndef VXL_MEDIUM_POINT_H
#define VXL_MEDIUM_POINT_H

#include "lib/lanes/exact_exp.h"
#include "lib/light/child_rays.h"
#include "lib/medium/near_light.h"
#include "lib/traverse/segment.h"

/// Mask: those of the rays first .. count-1 that exist and are not inside an object.
static inline lane_int in_the_open(const RayBatch* batch, uint first, uint count) {
    const lane_float end = LANES_LOAD(batch->rays, VXL_RAY_END * batch->stride + first);
    lane_int open = below(first, count) & LANE_MASK(end >= 0.0f);
    if (VXL_TRANSMISSION) open &= LANE_MASK(LANES_LOAD(batch->inside, first) == 0u);
    return open;
}

/// The state in which a point in the medium begins: with the direction in which the path came, and
/// no surface.
static inline NewRays point_of(PyramidShape shape, const Segment* s, lane_float t, lane_uint target,
                               lane_uint state) {
    const float one = shape.fixed_point;
    const lane_float zero = (lane_float)0.0f;
    NewRays r;
    // Points are rounded back along the way, so that none comes to lie in what is ahead.
    const Vector at = add_scaled(s->origin, s->direction, t), d = s->direction;
    r.origin.x = clamp(snap_position(at.x, -d.x, one), 0.0f, (float)shape.size_x);
    r.origin.y = clamp(snap_position(at.y, -d.y, one), 0.0f, (float)shape.size_y);
    r.origin.z = clamp(snap_position(at.z, -d.z, one), 0.0f, (float)shape.size_z);
    r.direction = s->direction;
    r.t_end = (lane_float)INFINITY;
    r.source = (lane_uint)VXL_NO_PRIMITIVE;
    r.instance = (lane_uint)VXL_NO_INSTANCE;
    r.flags = r.emitter = r.cell_xy = r.cell_z = r.medium = (lane_uint)0;
    r.travelled = r.width = r.start = r.clear = r.weight = zero;
    r.media = empty_medium_set();
    r.target = target;
    r.state = state;
    return r;
}

/// The parameters that `bind` of MediumPoints sets, in its order.
#define VXL_MEDIUM_POINTS_PARAMETERS                                \
    VXL_COUNTED_QUEUE_PARAMETERS, global uint *restrict point_hits, \
        global float *restrict point_radiance

/// Puts points into a queue, with the throughput of their light.
static inline void put_points(const RayQueue* points, const NewRays* point, const Slots* slots,
                              global uint* restrict hits, global float* restrict radiance) {
    put_rays(points, point, slots);
    put_uint(hits + VXL_HIT_VOXEL * points->stride, (lane_uint)VXL_NO_VOXEL, slots);
    if (VXL_INSTANCES)
        put_uint(hits + VXL_HIT_INSTANCE * points->stride, (lane_uint)VXL_NO_INSTANCE, slots);
    for (uint c = 0; c < 3; ++c) put_float(radiance + c * points->stride, (lane_float)0.0f, slots);
}

// What points store in place of a hit where lights near by matter: how far the path came to the
// point in the medium, and how far it would have continued from there, in metres, and the density
// per metre of being scattered there. The density is 0 where a light needs no other one, as at
// points near a light, which store the light's number in the tree if they have chosen it.
#define VXL_POINT_CAME VXL_HIT_T
#define VXL_POINT_LIGHT VXL_POINT_CAME
#define VXL_POINT_AHEAD VXL_HIT_CELL
#define VXL_POINT_DENSITY VXL_HIT_FACE

static inline void put_ways(global uint* restrict hits, uint stride, lane_float came,
                            lane_float ahead, lane_float density, const Slots* slots) {
    put_uint(hits + VXL_POINT_CAME * stride, LANES_AS_UINT(came), slots);
    put_uint(hits + VXL_POINT_AHEAD * stride, LANES_AS_UINT(ahead), slots);
    put_uint(hits + VXL_POINT_DENSITY * stride, LANES_AS_UINT(density), slots);
}

/// The weight in a light's estimate of a point found by chance; points chosen near the light have
/// the rest.
static inline lane_float chance_weight(const Light* light, float4 edge, Vector to_light, Vector way,
                                       global const uint* restrict hits, uint stride, uint first,
                                       lane_int valid) {
    const lane_float came = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_POINT_CAME * stride + first));
    const lane_float ahead = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_POINT_AHEAD * stride + first));
    const lane_float density = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_POINT_DENSITY * stride + first));
    valid &= LANE_MASK(density > 0.0f);
    const NearPart part = near_part(light, edge, to_light, way, -came, ahead, valid);
    const lane_float other = near_density(&part, -dot_product(to_light, way));
    return LANES_SELECT(
        valid, exact_divide(density, LANES_SELECT(valid, density + other, (lane_float)1.0f)),
        (lane_float)1.0f);
}

#endif
