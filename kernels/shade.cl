// SPDX-License-Identifier: Apache-2.0
// hits -> surface points: the position, surface and normal that each ray met, and the light there
// that needs no light sources: ambient light and emission.
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/light/emission_share.h"
#include "lib/light/shading_point.h"
#include "lib/light/sky.h"
#include "lib/solid/solid_surface.h"
#include "lib/surface/cube_body.h"
#include "lib/surface/field.h"
#include "lib/surface/glass_faces.h"
#include "lib/surface/surface_color.h"
#include "lib/surface/texture_alpha.h"
#include "lib/surface/triangle.h"
#include "lib/traverse/medium_set.h"
#include "lib/traverse/segment.h"
#include "lib/traverse/shaded_hit.h"
#include "shared/paths.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

// These headers and parameters are needed only by scenes with textures.
#if VXL_TEXTURES
#include "lib/surface/paint.h"
#define VXL_FOOTPRINT_PARAMETER Footprint footprint,
#else
#define VXL_FOOTPRINT_PARAMETER
#endif
#if VXL_SOURCE_MESHES
#define VXL_SOURCE_PARAMETERS \
    global const SourceRecord *restrict source_objects, global const uint *restrict source_words,
#define VXL_SOURCE_VIEW \
    { source_objects, source_words }
#else
#define VXL_SOURCE_PARAMETERS
#define VXL_SOURCE_VIEW \
    { 0, 0 }
#endif

/// The parameters that `bind` of HitDetails sets, in its order. A comma ends them, if any exist.
#define VXL_HIT_DETAIL_PARAMETERS \
    VXL_FOOTPRINT_PARAMETER VXL_SOURCE_PARAMETERS VXL_CUBE_STEPS_PARAMETER

/// Where rays met surfaces: the position in the voxel, and the unit normal in metric space.
typedef struct {
    Vector point, normal;
} SurfacePoint;

/// Turns a gradient in the voxels of the hits into a unit normal in metric space.
static inline Vector normal_of(const WorldView* world, const ShadedHit* h, Vector gradient) {
    return unit(metric_gradient(world, h, gradient));
}

/// Sets the points of cubes, exactly on the crossed face, and that face's normals, towards the ray.
static inline void meet_cubes(const WorldView* world, const ShadedHit* h, SurfacePoint* p) {
    const Vector d = h->ray.direction;
    const lane_uint axis = (h->face >> VXL_FACE_AXIS_SHIFT) & VXL_FACE_AXIS_MASK;
    const lane_float up_x = LANES_FLOAT(LANE_MASK(d.x >= 0.0f)) * 2.0f + 1.0f;
    const lane_float up_y = LANES_FLOAT(LANE_MASK(d.y >= 0.0f)) * 2.0f + 1.0f;
    const lane_float up_z = LANES_FLOAT(LANE_MASK(d.z >= 0.0f)) * 2.0f + 1.0f;
    const lane_float zero = (lane_float)0.0f;
    const Vector face = {LANES_SELECT(LANE_MASK(axis == 0u), up_x, zero),
                         LANES_SELECT(LANE_MASK(axis == 1u), up_y, zero),
                         LANES_SELECT(LANE_MASK(axis == 2u), up_z, zero)};
    const lane_int cubes =
        LANE_MASK((h->packed >> VXL_KIND_SHIFT) == VXL_KIND_CUBES) & h->hit & ~h->exact;
    lane_float half_unit = (lane_float)0.5f;  // towards the face that was met
    if (VXL_CUBE_BODIES) half_unit = LANES_SELECT(is_exit(h->face), -half_unit, half_unit);
    const Vector on_face = {
        LANES_SELECT(LANE_MASK(axis == 0u), fma(up_x, half_unit, 0.5f), p->point.x),
        LANES_SELECT(LANE_MASK(axis == 1u), fma(up_y, half_unit, 0.5f), p->point.y),
        LANES_SELECT(LANE_MASK(axis == 2u), fma(up_z, half_unit, 0.5f), p->point.z)};
    p->point = select_vector(cubes, on_face, p->point);
    p->normal = select_vector(cubes, face, p->normal);
    if (VXL_INSTANCES)
        p->normal = select_vector(cubes & h->of_instance, normal_of(world, h, face), p->normal);
}

/// Sets the normals of smooth voxels: gradients of the distance field.
static inline void meet_smooth(const WorldView* world, const ShadedHit* h, SurfacePoint* p) {
    const Field field = read_field(world->surface.fields, h->voxel & LANES_AS_UINT(h->smooth));
    Vector g;
    field_gradient(&field, p->point.x, p->point.y, p->point.z, &g.x, &g.y, &g.z);
    p->normal = select_vector(h->smooth, normal_of(world, h, g), p->normal);
}

/// Sets the normals of triangles: those of their planes.
static inline void meet_triangles(const WorldView* world, const ShadedHit* h, lane_int triangles,
                                  SurfacePoint* p) {
    global const float* corners = world->surface.triangles;
    const lane_uint triangle = h->primitive & LANES_AS_UINT(triangles);
    const Vector n = unit(triangle_normal(corners, triangle, world->shape.edge));
    p->normal = select_vector(triangles, n, p->normal);
    if (VXL_INSTANCES) {
        const Vector g = triangle_normal(corners, triangle, (float4)(1.0f));
        p->normal = select_vector(triangles & h->of_instance, normal_of(world, h, g), p->normal);
    }
}

/// Sets the normals of solids: gradients of the solids' formulas.
static inline void meet_solids(const WorldView* world, const ShadedHit* h, lane_int solids,
                               SurfacePoint* p) {
    const lane_uint solid = (h->primitive & ~VXL_SOLID_PRIMITIVE) & LANES_AS_UINT(solids);
    const Vector o = h->ray.origin, d = h->ray.direction;
    const SolidRay ray = {o.x, o.y, o.z, d.x, d.y, d.z};
    const SolidPoint in_voxels =
        solid_normals(world->surface.solids, solid, &ray, h->ray.t, solids);
    const Vector g = {in_voxels.x, in_voxels.y, in_voxels.z};
    p->normal = select_vector(solids, normal_of(world, h, g), p->normal);
}

/// Mask: surfaces whose normals point along the rays, which see them from behind.
static inline lane_int faces_away(const WorldView* world, const ShadedHit* h, Vector normal) {
    const Vector metric = scaled(h->world_way, world->shape.edge);
    // A smooth surface's gradient may be off at its silhouette, but the walk knows the side.
    lane_int behind = LANE_MASK(dot_product(metric, normal) > 0.0f);
    if (VXL_SMOOTH)
        behind = LANES_SELECT(h->smooth, LANE_MASK((h->face & VXL_FACE_WITHIN) != 0u), behind);
    return behind;
}

/// The points that the rays have met, according to the kind of each surface.
static inline SurfacePoint meet_surface(const WorldView* world, const ShadedHit* h) {
    const Vector o = h->ray.origin, d = h->ray.direction, c = h->cell;
    const lane_float t = h->ray.t, zero = (lane_float)0.0f;
    SurfacePoint p = {
        {clamp(fma(d.x, t, o.x - c.x), 0.0f, 1.0f), clamp(fma(d.y, t, o.y - c.y), 0.0f, 1.0f),
         clamp(fma(d.z, t, o.z - c.z), 0.0f, 1.0f)},
        {zero, zero, zero}};
    if (VXL_CUBES) meet_cubes(world, h, &p);
    if (VXL_SMOOTH && lanes_any(h->smooth)) meet_smooth(world, h, &p);
    if (VXL_EXACT && lanes_any(h->exact)) {
        const lane_int solids = LANE_MASK((h->primitive & VXL_SOLID_PRIMITIVE) != 0u) & h->exact;
        if (VXL_TRIANGLES) meet_triangles(world, h, h->exact & ~solids, &p);
        if (VXL_SOLIDS && lanes_any(solids)) meet_solids(world, h, solids, &p);
        const Vector along = {fma(d.x, t, o.x - c.x), fma(d.y, t, o.y - c.y),
                              fma(d.z, t, o.z - c.z)};
        p.point = select_vector(h->exact, along, p.point);
    }
    return p;
}

/// Where the points are in the world, in voxels.
static inline Vector position_of(const ShadedHit* h, const SurfacePoint* p) {
    const Vector in_cell = {h->cell.x + p->point.x, h->cell.y + p->point.y, h->cell.z + p->point.z};
    if (!VXL_INSTANCES) return in_cell;
    const Vector o = h->world_origin, d = h->world_way;
    const Vector on_ray = {fma(d.x, h->world_t, o.x), fma(d.y, h->world_t, o.y),
                           fma(d.z, h->world_t, o.z)};
    return select_vector(h->of_instance, on_ray, in_cell);
}

/// VXL_SIDE_* bits of the faces at which the glass of two `cubes` touches.
static inline lane_uint glass_side(const WorldView* world, const ShadedHit* h,
                                   const MediumSet* before, lane_int cubes,
                                   global const float* restrict materials,
                                   global const uint* restrict ranks) {
    const lane_uint axis = (h->face >> VXL_FACE_AXIS_SHIFT) & VXL_FACE_AXIS_MASK;
    const lane_int exit = is_exit(h->face);
    const Vector d = h->ray.direction;
    const lane_float along =
        LANES_SELECT(LANE_MASK(axis == 0u), d.x, LANES_SELECT(LANE_MASK(axis == 1u), d.y, d.z));
    const lane_int ahead =
        LANES_SELECT(exit, LANE_MASK((h->face & VXL_FACE_UP) != 0u), LANE_MASK(along >= 0.0f));
    const FaceCell cell = {LANES_INT(h->cell.x), LANES_INT(h->cell.y), LANES_INT(h->cell.z)};
    const lane_uint beyond =
        glass_in(&world->pyramid, &world->surface, neighbor_of(cell, axis, ~(exit ^ ahead)),
                 materials, cubes & LANE_MASK(axis != 3u) & is_joined(h->packed, materials));
    const lane_int between = are_between_glass(before, h->packed, beyond, exit, ranks);
    const lane_int hidden = between & (~exit | bend_alike(h->packed, beyond, materials));
    const lane_uint inside = ((beyond >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK) + 1u;
    return (LANES_AS_UINT(hidden) & VXL_SIDE_HIDDEN) |
           (LANES_AS_UINT(between) & (inside << VXL_SIDE_BEYOND_SHIFT));
}

/// VXL_SIDE_* bits of surfaces met inside the objects of `before`. Hidden ones get the opacity 0.
static inline lane_uint side_of(const WorldView* world, const ShadedHit* h, const MediumSet* before,
                                lane_int behind, lane_uint material,
                                global const float* restrict materials,
                                global const uint* restrict ranks, lane_float* opacity) {
    lane_int leaving = medium_set_holds(before, h->packed) | behind;
    lane_int inner = (lane_int)0, exit = (lane_int)0;  // faces between cubes; faces out of them
    lane_uint glass = (lane_uint)0;
    if (VXL_CUBE_BODIES) {
        const lane_int cube = is_cube(h->packed, h->primitive) & h->hit;
        exit = cube & is_exit(h->face);
        inner = cube & leaving & ~exit;
        leaving = LANES_SELECT(cube, exit, leaving);
    }
    lane_int hidden = hides_surface(before, h->packed, leaving, ranks);
    if (VXL_CUBE_BODIES) {
        hidden |= exit & ~is_joined(h->packed, materials);
        hidden =
            LANES_SELECT(inner, ~same_medium(effective_medium(before, ranks), h->packed), hidden);
        // An observer inside a joined body is not on any face of it.
        const lane_uint axis = (h->face >> VXL_FACE_AXIS_SHIFT) & VXL_FACE_AXIS_MASK;
        hidden |= is_cube(h->packed, h->primitive) & LANE_MASK(axis == 3u) &
                  is_joined(h->packed, materials);
        glass = glass_side(world, h, before, is_cube(h->packed, h->primitive) & h->hit & ~inner,
                           materials, ranks);
        hidden |= LANE_MASK((glass & VXL_SIDE_HIDDEN) != 0u);
    }
    hidden &= h->hit & (transmits(materials, material, *opacity) | exit);
    if (VXL_TEXTURE_ALPHA) hidden &= have_bodies(materials, h->packed, h->primitive, h->hit);
    *opacity = LANES_SELECT(hidden, (lane_float)0.0f, *opacity);
    return (LANES_AS_UINT(leaving) & VXL_SIDE_LEAVING) | (LANES_AS_UINT(hidden) & VXL_SIDE_HIDDEN) |
           (glass & ~VXL_SIDE_HIDDEN);
}

/// Starts the radiance of the rays: ambient light and emission of surfaces, and the surroundings
/// for rays that miss. Maps multiply emission by `emission_factors`.
static inline void store_own_light(const WorldView* world, const ShadedHit* h,
                                   Environment environment, const SkyView* sky, uint from_observer,
                                   const Emitters* emitters, Vector position, lane_float opacity,
                                   lane_uint material, global const float* restrict materials,
                                   Colors colors, const lane_float* emission_factors,
                                   const RayBatch* batch, uint first) {
    const lane_float diffuse = surface_diffuse(materials, material, colors);
    const lane_uint offset = color_offset(materials, material, position.x, position.y, position.z);
    lane_float around[3] = {(lane_float)environment.background.x,
                            (lane_float)environment.background.y,
                            (lane_float)environment.background.z};
    if (VXL_SKY != VXL_SKY_NONE && lanes_any(~h->hit))
        see_sky(h->hit, h->world_way, world->shape.edge, sky, batch, first, from_observer, around);
    lane_float counts = (lane_float)1.0f;
    lane_int looks = (lane_int)0, to_sky = (lane_int)0;
    if (VXL_LOOKS) looks = looks_for_emitter(batch, first);
    if (VXL_SKY_RAYS) to_sky = looks & goes_to_sky(batch, first);
    if (VXL_EMITTERS) {
        counts = emission_share(emitters, h, world->shape.edge, batch, first,
                                looks | (h->hit & emits_light(materials, material)));
    }
    lane_int in_medium = (lane_int)0;  // mask: paths scattered before they come here
    if (VXL_SCATTERING) in_medium = scatters_before(batch, first);
    const float ambient[3] = {environment.ambient.x, environment.ambient.y, environment.ambient.z};
    for (int channel = 0; channel < 3; ++channel) {
        const lane_float color = surface_color(materials, offset, colors, channel);
        lane_float emission =
            LANES_GATHER_FLOAT(materials, material + (uint)(VXL_MATERIAL_EMISSION + channel));
        if (VXL_TEXTURE_MAPS) emission *= emission_factors[channel];
        if (VXL_EMITTERS) emission *= counts;
        if (VXL_SKY_RAYS) emission = LANES_SELECT(to_sky, (lane_float)0.0f, emission);
        if (VXL_LOOKS)
            around[channel] = LANES_SELECT(looks & ~to_sky, (lane_float)0.0f, around[channel]);
        const lane_float own = fma(color * diffuse, ambient[channel], emission) * opacity;
        lane_float light = LANES_SELECT(h->hit, own, around[channel]);
        if (VXL_SCATTERING) light = LANES_SELECT(in_medium, (lane_float)0.0f, light);
        LANES_STORE(light, batch->radiance, (uint)channel * batch->stride + first);
    }
}

/// Writes what is asked for each hit: its point, normal, packed attributes and `sides`; and in
/// `radiance` its ambient light and emission, or the surroundings of the world for a miss.
kernel void shade_surface(VXL_WORLD_PARAMETERS, Environment environment,
                          VXL_SKY_PARAMETERS VXL_SKY_DEPTH_PARAMETER VXL_EMITTER_PARAMETERS
                              VXL_HIT_DETAIL_PARAMETERS global const float* restrict materials,
                          global const uint* restrict ranks, VXL_BATCH_PARAMETERS, uint count) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const WorldView world = VXL_WORLD;
    const RayBatch batch = VXL_BATCH;
    const ShadedHit h = load_hits(&world, &batch, first);
    SurfacePoint p = meet_surface(&world, &h);
    const lane_int behind = faces_away(&world, &h, p.normal);
    p.normal = select_vector(behind, opposite(p.normal), p.normal);
    const Vector position = position_of(&h, &p);
    if (VXL_POSITIONS) store_vector(position, positions, stride, first);
    if (VXL_NORMALS) store_vector(p.normal, normals, stride, first);
    if (VXL_NORMALS && VXL_SHADING_NORMALS) {
        const ShadingPoint s = shading_point(&world, &h, VXL_CUBE_STEPS, p.point, p.normal, behind);
        store_vector(s.normal, shading, stride, first);
        store_vector(s.offset, shading + VXL_SHADING_OFFSET * stride, stride, first);
    }
    if (VXL_HIT_ATTRIBUTES) LANES_STORE(h.packed, hit_attributes, first);
    if (!VXL_RADIANCE) return;
    const lane_uint material = material_offset(h.packed) & LANES_AS_UINT(h.hit);
    lane_float emission_factors[3];  // what maps multiply emission by
    Colors own = colors_of_hits(colors, h.voxel, batch.paint, first);
#if VXL_TEXTURES
    const SourceMeshes sources = VXL_SOURCE_VIEW;
    lane_float fresh[VXL_PAINT_FLOATS(VXL_TEXTURE_MAPS)];
    paint_hits(&world, &sources, &h, &footprint, position, p.normal, materials, material, &batch,
               first, fresh, emission_factors);
    own.fresh = fresh;
#endif
    lane_float opacity = surface_opacity(materials, material, own);
    lane_uint side = LANES_AS_UINT(behind) & VXL_SIDE_LEAVING;
    if (VXL_TRANSMISSION) {
        const MediumSet before = load_medium_set(paths, stride, first, h.hit);
        side = side_of(&world, &h, &before, behind, material, materials, ranks, &opacity);
    }
    if (VXL_PATHS) LANES_STORE(side, sides, first);
    const Emitters table = VXL_EMITTER_TABLE;
    const SkyView around = VXL_SKY_VIEW;
    store_own_light(&world, &h, environment, &around, VXL_FROM_OBSERVER, &table, position, opacity,
                    material, materials, own, emission_factors, &batch, first);
}
