// SPDX-License-Identifier: Apache-2.0
// The normals used for the light on surfaces that rays have met, where these differ from the
// geometric normals.
#ifndef VXL_SHADING_POINT_H
#define VXL_SHADING_POINT_H

#include "lib/surface/shading_normal.h"
#include "lib/traverse/shaded_hit.h"
#include "lib/traverse/world.h"

/// The parameter that only scenes with resampled cubes need.
#if VXL_RESAMPLED_CUBES
#define VXL_CUBE_STEPS_PARAMETER global const float* restrict cube_steps,
#define VXL_CUBE_STEPS cube_steps
#else
#define VXL_CUBE_STEPS_PARAMETER
#define VXL_CUBE_STEPS 0
#endif

/// Converts a gradient in the voxels of the hits to metric space.
static inline Vector metric_gradient(const WorldView* world, const ShadedHit* h, Vector g) {
    const Vector of_world = VXL_INSTANCES ? world_gradient(&h->ray, g, h->of_instance) : g;
    return scaled(of_world, world->shape.inverse_edge);
}

/// Sets the normals of triangles: the mean of their corners' normals, flipped where the surface is
/// met from `behind`. Rays to lights begin as if the surface around each corner were round, at the
/// height of the tangent planes (Hanika 2021, "Hacking the Shadow Terminator", Ray Tracing Gems II,
/// chapter 4).
static inline void light_triangles(const WorldView* world, const ShadedHit* h, Vector normal,
                                   lane_int behind, ShadingPoint* s) {
    const lane_float zero = (lane_float)0.0f;
    const lane_int triangle = h->exact & LANE_MASK((h->primitive & VXL_SOLID_PRIMITIVE) == 0u);
    const lane_uint number = h->primitive & LANES_AS_UINT(triangle);
    global const uint* packed = world->surface.triangle_normals;
    const lane_uint index = number * (uint)VXL_TRIANGLE_NORMALS;
    const lane_int curved = triangle & LANE_MASK(LANES_GATHER_UINT(packed, index) != VXL_NO_NORMAL);
    if (!lanes_any(curved)) return;
    const Vector o = h->ray.origin, d = h->ray.direction;
    Vector from[3];
    lane_float weight[3];
    for (uint i = 0; i < 3; ++i) {
        const Vector corner = triangle_corner(world->surface.triangles, number, i);
        from[i] = add_scaled(difference(o, corner), d, h->ray.t);
    }
    corner_weights(from, weight);
    Vector sum = {zero, zero, zero}, offset = sum;
    for (uint i = 0; i < 3; ++i) {
        Vector g = unpack_normal(LANES_GATHER_UINT(packed, index + i));
        g = select_vector(behind, opposite(g), g);
        const Vector metric = metric_gradient(world, h, g);
        const lane_float inverse = exact_reciprocal(exact_sqrt(dot_product(metric, metric)));
        const lane_float below = fmax(-dot_product(g, from[i]) * inverse, 0.0f);
        const Vector n = unit(metric);
        sum = add_scaled(sum, n, weight[i]);
        offset = add_scaled(offset, n, weight[i] * below);
    }
    sum = unit(sum);
    s->normal = select_vector(curved & LANE_MASK(dot_product(sum, sum) > 0.0f), sum, s->normal);
    s->offset =
        select_vector(curved & LANE_MASK(dot_product(offset, normal) > 0.0f), offset, s->offset);
}

/// How far a gradient in the world's voxels rises across one voxel of the hit's object, for objects
/// whose cubes were resampled into the world's voxels; 0 for others. `cube_steps` are those of
/// runtime/analysis/cube_steps.hpp.
static inline lane_float rise_in_own_voxel(global const float* restrict cube_steps,
                                           const ShadedHit* h, lane_int cubes, Vector g) {
    lane_float rise = (lane_float)0.0f;
    const lane_uint first = (h->packed & VXL_OBJECT_MASK & LANES_AS_UINT(cubes)) * 9u;
    for (uint row = 0; row < 9; row += 3)
        rise += fabs(fma(LANES_GATHER_FLOAT(cube_steps, first + row), g.x,
                         fma(LANES_GATHER_FLOAT(cube_steps, first + row + 1u), g.y,
                             LANES_GATHER_FLOAT(cube_steps, first + row + 2u) * g.z)));
    return rise;
}

/// Sets the normals of cubes: those of the surface that they stand for, flipped where both the
/// face, whose normal is `normal`, and the ray are behind that surface.
///
/// Rays to lights begin above the steps that the cubes of a flat surface form, so that the steps
/// cast no shadows. With the gradient g of the surface, a set of voxels around it reaches up to
/// |g|_1 above it (for a supercover; less for others). The voxel in front of a face across axis a
/// is empty, so the surface lies so low that no step is higher than |g_a| + |g|_1 / 2 above the
/// voxel's centre.
///
/// Resampled cubes also have the steps of their object's voxels. A voxel of the world takes on an
/// object voxel that its centre lies in or near: with the gradient h in the object's voxels, a
/// filled voxel's centre lies at most |h|_1 higher above the surface than the lowest centre of an
/// empty voxel. Some of their faces look down from overhanging steps, and are lit like the others.
static inline void light_cubes(const WorldView* world, const ShadedHit* h,
                               global const float* restrict cube_steps, Vector position,
                               Vector normal, ShadingPoint* s) {
    const lane_int cubes =
        LANE_MASK((h->packed >> VXL_KIND_SHIFT) == VXL_KIND_CUBES) & h->hit & ~h->exact;
    const lane_uint code =
        LANES_GATHER_UINT(world->surface.normals, h->voxel & LANES_AS_UINT(cubes));
    const lane_int curved = cubes & LANE_MASK(code != VXL_NO_NORMAL);
    if (!lanes_any(curved)) return;
    Vector g = unpack_normal(code);
    Vector metric = metric_gradient(world, h, g);
    const Vector way = scaled(h->world_way, world->shape.edge);
    const lane_int behind =
        LANE_MASK(dot_product(metric, normal) < 0.0f) & LANE_MASK(dot_product(metric, way) > 0.0f);
    g = select_vector(behind, opposite(g), g);
    metric = select_vector(behind, opposite(metric), metric);
    const lane_uint axis = (h->face >> VXL_FACE_AXIS_SHIFT) & VXL_FACE_AXIS_MASK;
    const Vector size = {fabs(g.x), fabs(g.y), fabs(g.z)};
    const lane_float across = LANES_SELECT(LANE_MASK(axis == 0u), size.x,
                                           LANES_SELECT(LANE_MASK(axis == 1u), size.y, size.z));
    const Vector from = {position.x - 0.5f, position.y - 0.5f, position.z - 0.5f};
    const lane_float top = fma((lane_float)0.5f, size.x + size.y + size.z, across);
    lane_float rise = (lane_float)0.0f;
    if (VXL_RESAMPLED_CUBES) rise = rise_in_own_voxel(cube_steps, h, curved, g);
    const lane_float inverse = exact_reciprocal(exact_sqrt(dot_product(metric, metric)));
    const lane_float below = fmax(top + rise - dot_product(g, from), 0.0f) * inverse;
    const Vector n = unit(metric);
    const Vector offset = {n.x * below, n.y * below, n.z * below};
    lane_int begins_above = LANE_MASK(dot_product(offset, normal) > 0.0f);
    if (VXL_RESAMPLED_CUBES)
        begins_above |= LANE_MASK(rise > 0.0f) & LANE_MASK(dot_product(metric, way) < 0.0f);
    s->normal = select_vector(curved, n, s->normal);
    s->offset = select_vector(curved & begins_above, offset, s->offset);
}

/// The normals used for the light on points whose geometric normals are `normal`, at `position` in
/// their voxels, and how far above the surface rays to lights begin.
static inline ShadingPoint shading_point(const WorldView* world, const ShadedHit* h,
                                         global const float* restrict cube_steps, Vector position,
                                         Vector normal, lane_int behind) {
    const lane_float zero = (lane_float)0.0f;
    ShadingPoint s = {normal, {zero, zero, zero}};
    if (VXL_CORNER_NORMALS) light_triangles(world, h, normal, behind, &s);
    if (VXL_VOXEL_NORMALS) light_cubes(world, h, cube_steps, position, normal, &s);
    return s;
}

#endif
