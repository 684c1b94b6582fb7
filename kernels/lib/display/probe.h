// SPDX-License-Identifier: Apache-2.0
// Probe points in the voxels of a lattice, and rays aimed at them.
#ifndef VXL_PROBE_H
#define VXL_PROBE_H

#include "lib/display/depth.h"
#include "shared/trace.h"

// How far in front of a probe point another surface must be to hide the point, in lattice voxels.
#define VXL_HIDING_DISTANCE 0.0625f

// How far before its probe point a voxel's light ray begins, and how far behind the point it may
// end, in lattice voxels.
#define VXL_LIGHT_DISTANCE 1.0f

/// The parameters that `bind` of ProbePoints sets, in its order.
#define VXL_POINTS_PARAMETERS \
    uint point_count, uint total, global float *restrict points, global uint *restrict view_of_point

/// `count` probe points, in arrays of `total`. Points without a view have the view 0xFFFFFFFF.
typedef struct {
    uint count, total;
    global float* restrict points;
    global uint* restrict views;
} ProbePoints;

/// The value of ProbePoints in a kernel with these parameters.
#define VXL_POINTS \
    { point_count, total, points, view_of_point }

/// Where rays look from at the voxels of a lattice: the parameters that `bind` of ProbeViews sets,
/// in its order. views[0] stands for E.
#define VXL_VIEW_PARAMETERS \
    Camera camera, PyramidShape shape, DisplayLattice lattice, global const float4 *restrict views

/// Converts lattice coordinates to the world's voxels.
static inline Vector point_in_world(const DisplayLattice* l, Vector p) {
    const Vector result = {
        fma(p.x, l->axis_x.x, fma(p.y, l->axis_y.x, fma(p.z, l->axis_z.x, l->origin.x))),
        fma(p.x, l->axis_x.y, fma(p.y, l->axis_y.y, fma(p.z, l->axis_z.y, l->origin.y))),
        fma(p.x, l->axis_x.z, fma(p.y, l->axis_y.z, fma(p.z, l->axis_z.z, l->origin.z)))};
    return result;
}

/// A packet's ways to its probe points, in the world's voxels.
typedef struct {
    Vector point;
    Vector way;       // from where the ray begins to the point
    lane_float near;  // the part of the way that lies before the display
    lane_int aimed;   // mask
} ProbeWay;

/// The way from E to a point.
static inline ProbeWay way_from_eye(const Camera* camera, float4 edge, Vector point) {
    const Vector eye = from_eye(camera, point);
    const Vector metres = scaled(eye, edge);
    const lane_float depth = along_sight(camera, edge, metres);
    ProbeWay w;
    w.point = point;
    lane_float length = exact_sqrt(dot_product(metres, metres));
    w.way = sight_way(camera, eye, depth, &length);
    w.aimed = LANE_MASK(length > 0.0f);
    w.near = exact_divide((lane_float)camera->near_plane,
                          LANES_SELECT(w.aimed, length, (lane_float)1.0f));
    return w;
}

/// Replaces the ways of points whose view is not E's by ways along their views.
static inline void look_along_views(global const float4* restrict views, lane_uint view,
                                    ProbeWay* w) {
    const lane_int parallel = LANE_MASK(view != 0u);
    if (!lanes_any(parallel)) return;
    global const float* numbers = (global const float*)views;
    const Vector along = {LANES_GATHER_FLOAT(numbers, view * 4u),
                          LANES_GATHER_FLOAT(numbers, view * 4u + 1u),
                          LANES_GATHER_FLOAT(numbers, view * 4u + 2u)};
    w->way = select_vector(parallel, along, w->way);
    w->near = LANES_SELECT(parallel, (lane_float)0.0f, w->near);
    w->aimed |= parallel;
}

/// The t in which a ray passes one lattice voxel along its fastest axis.
static inline lane_float t_per_voxel(const DisplayLattice* l, Vector d) {
    const lane_float rate =
        fmax(fabs(fma(d.x, l->row_x.x, fma(d.y, l->row_x.y, d.z * l->row_x.z))),
             fmax(fabs(fma(d.x, l->row_y.x, fma(d.y, l->row_y.y, d.z * l->row_y.z))),
                  fabs(fma(d.x, l->row_z.x, fma(d.y, l->row_z.y, d.z * l->row_z.z)))));
    return exact_reciprocal(rate);
}

/// Stores the rays along the ways, cut to the part that `search` asks for (see aim_rays) and to the
/// world.
static inline void store_ways(PyramidShape shape, const DisplayLattice* lattice, ProbeWay* w,
                              uint search, global float* restrict rays, uint stride, uint first) {
    w->way.x = LANES_SELECT(w->aimed, w->way.x, (lane_float)1.0f);
    const Vector way = w->way, p = w->point;
    const lane_float scale = power_of_two_scale(way.x, way.y, way.z);
    const Vector d = {snap_direction(way.x * scale), snap_direction(way.y * scale),
                      snap_direction(way.z * scale)};
    const lane_float t_point = exact_reciprocal(scale);
    const Vector o = {p.x - way.x, p.y - way.y, p.z - way.z};
    const lane_float per_voxel = t_per_voxel(lattice, d);
    lane_float t_first = w->near * t_point, t_last;
    if (search) {
        t_last = t_point - VXL_HIDING_DISTANCE * per_voxel;
    } else {
        t_first = fmax(t_first, t_point - VXL_LIGHT_DISTANCE * per_voxel);
        t_first = fmin(t_first, t_point - VXL_HIDING_DISTANCE * per_voxel);
        t_last = t_point + VXL_LIGHT_DISTANCE * per_voxel;
    }
    lane_float t_out = t_last;
    clip_to_world(o, d, shape.size_x, shape.size_y, shape.size_z, &t_first, &t_out);
    const lane_int aimed = w->aimed & LANE_MASK(t_first <= t_out);
    t_first = LANES_SELECT(aimed, t_first, (lane_float)0.0f);
    const lane_float zero = (lane_float)0.0f;
    const float fixed = shape.fixed_point;
    const Vector start = {
        snap_position(clamp(fma(d.x, t_first, o.x), 0.0f, (float)shape.size_x), zero, fixed),
        snap_position(clamp(fma(d.y, t_first, o.y), 0.0f, (float)shape.size_y), zero, fixed),
        snap_position(clamp(fma(d.z, t_first, o.z), 0.0f, (float)shape.size_z), zero, fixed)};
    store_vector(start, rays, stride, first);
    store_vector(d, rays + VXL_RAY_DX * stride, stride, first);
    LANES_STORE(LANES_SELECT(aimed, t_last - t_first, (lane_float)-1.0f), rays,
                VXL_RAY_END * stride + first);
}

#endif
