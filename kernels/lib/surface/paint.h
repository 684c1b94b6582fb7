// SPDX-License-Identifier: Apache-2.0
// The colours of the surfaces that rays have met, where some wear textures, averaged over the part
// of the surface that a sample covers.
#ifndef VXL_PAINT_H
#define VXL_PAINT_H

#include "lib/surface/shading_normal.h"
#include "lib/surface/source_mesh.h"
#include "lib/surface/surface_color.h"
#include "lib/surface/texture_maps.h"
#include "lib/surface/texture_mean.h"
#include "lib/traverse/medium_set.h"
#include "lib/traverse/ray_batch.h"
#include "lib/traverse/shaded_hit.h"
#include "shared/footprint.h"
#include "shared/paths.h"

/// The minimum cosine for which footprints on textures are computed; below it they would be
/// unbounded.
#define VXL_MIN_SEEN_COSINE 0.015625f

/// What rays span where they met surfaces: two vectors across the rays, in metres.
typedef struct {
    Vector side[2];
    lane_float lean[2];  // of TextureArea
    lane_float off[2];   // offset of the span's middle from the ray, in these vectors
    lane_float width;    // edge of a square of equal area
} RaySpan;

/// Two vectors of length `width` across the unit vectors `way`, one of them along the surface with
/// this normal.
static inline void span_square(Vector way, Vector normal, lane_float width, RaySpan* s) {
    Vector flat = cross_of(normal, way);
    const lane_int straight = LANE_MASK(dot_product(flat, flat) < 1e-6f);
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const lane_int along_x = LANE_MASK(fabs(way.x) > 0.6f);
    const Vector axis = {LANES_SELECT(along_x, zero, one), LANES_SELECT(along_x, one, zero), zero};
    flat = unit(select_vector(straight, cross_of(axis, way), flat));
    const Vector up = cross_of(way, flat);
    for (int i = 0; i < 2; ++i) {
        const Vector v = i == 0 ? flat : up;
        const Vector stretched = {v.x * width, v.y * width, v.z * width};
        s->side[i] = stretched;
    }
    for (int i = 0; i < 2; ++i) s->off[i] = s->lean[i] = (lane_float)0.0f;
    s->width = width;
}

/// The offset, in cells along `step`, from the end of `from`, a vector from the observer, to the
/// middle of the cell that this end lies in. `half_cells` lie on each side of the view's middle.
static inline lane_float off_middle(Vector from, float4 step, lane_float depth, float half_cells) {
    const lane_float along = dot_product(from, vector_of(step)) * step.w;
    const lane_float cells = exact_divide(along, depth) + half_cells;
    return LANES_SELECT(LANE_MASK(fabs(cells) < 1e6f), floor(cells) + 0.5f - cells,
                        (lane_float)0.0f);
}

/// The span of rays, in metres, at the points `position`, in voxels. Rays from other surfaces had
/// the width `before` there; rays from the observer had the width 0.
static inline RaySpan span_of(const Footprint* f, float4 edge, Vector position, Vector normal,
                              Vector way, lane_float before, lane_float travelled) {
    const Vector middle = vector_of(f->middle);
    const Vector from = scaled(difference(position, middle), edge);
    const lane_float distance = exact_sqrt(dot_product(from, from));
    const lane_int first = LANE_MASK(before == 0.0f);
    lane_float width = fma((lane_float)f->spread, distance, (lane_float)f->width);
    width = LANES_SELECT(first, width, fma((lane_float)f->spread, travelled, before));
    RaySpan s;
    span_square(way, normal, width, &s);
    if (f->shape == VXL_FOOTPRINT_CONE) return s;
    lane_float depth = (lane_float)1.0f;
    if (f->shape == VXL_FOOTPRINT_PYRAMID) depth = dot_product(from, vector_of(f->ahead));
    depth = LANES_SELECT(first & LANE_MASK(depth > 0.0f), depth, (lane_float)1.0f);
    const Vector across = vector_of(f->across), down = vector_of(f->down);
    const Vector none = {(lane_float)0.0f, (lane_float)0.0f, (lane_float)0.0f};
    s.side[0] = select_vector(first, add_scaled(none, across, depth), s.side[0]);
    s.side[1] = select_vector(first, add_scaled(none, down, depth), s.side[1]);
    const lane_float seen = dot_product(normal, from);
    const lane_int leans = first & LANE_MASK(seen < 0.0f);
    const lane_float per_seen = exact_reciprocal(LANES_SELECT(leans, seen, (lane_float)-1.0f));
    for (int i = 0; i < 2 && f->shape == VXL_FOOTPRINT_PYRAMID; ++i)
        s.lean[i] = LANES_SELECT(leans, dot_product(normal, s.side[i]) * per_seen, s.lean[i]);
    if (f->half_columns == 0.0f) return s;
    const lane_float column = off_middle(from, f->across, depth, f->half_columns);
    const lane_float row = off_middle(from, f->down, depth, f->half_rows);
    s.off[0] = LANES_SELECT(first, column, s.off[0]);
    s.off[1] = LANES_SELECT(first, row, s.off[1]);
    return s;
}

/// The vector moved along the unit vectors `way` onto the surface with this normal; `way` points
/// against the normal.
static inline Vector on_surface(Vector v, Vector normal, Vector way) {
    const lane_float seen = fmin(dot_product(normal, way), (lane_float)-VXL_MIN_SEEN_COSINE);
    return add_scaled(v, way, -exact_divide(dot_product(v, normal), seen));
}

/// Converts a vector in metres to the voxels of the hits.
static inline Vector in_hit_voxels(const ShadedHit* h, Vector metric, float4 inverse_edge) {
    const Vector v = scaled(metric, inverse_edge);
    if (!VXL_INSTANCES) return v;
    const lane_float* m = h->ray.map;
    const Vector own = {fma(m[0], v.x, fma(m[1], v.y, m[2] * v.z)),
                        fma(m[3], v.x, fma(m[4], v.y, m[5] * v.z)),
                        fma(m[6], v.x, fma(m[7], v.y, m[8] * v.z))};
    return select_vector(h->of_instance, own, v);
}

/// The triangles whose textures a packet's surfaces show, and the points on them.
typedef struct {
    lane_int wears;            // mask: there is one with a texture
    lane_uint worn;            // where the record of what it wears begins
    lane_uint texture;         // where its texture begins
    Vector ab, ac;             // its sides from the first corner
    lane_float weight[3];      // weights of the corners at the point
    const Vector* sides;       // the ray's span on the surface, in the space of `ab` and `ac`
    global const uint* words;  // the records
    global const uint* textures;
} WornTriangle;

/// The area on a texture that a ray sees: its middle, and how far positions on the texture move
/// along the sides of the span.
static inline TextureArea area_of(const WornTriangle* w, const RaySpan* span) {
    const Vector n = cross_of(w->ab, w->ac);
    const lane_float squared = dot_product(n, n);
    const lane_int some = LANE_MASK(squared > 0.0f);
    const lane_float inverse = LANES_SELECT(
        some, exact_reciprocal(LANES_SELECT(some, squared, (lane_float)1.0f)), (lane_float)0.0f);
    global const float* uvs = (global const float*)w->words;
    lane_float u[3], v[3];
    TextureArea area;
    area.u = area.v = (lane_float)0.0f;
    for (uint i = 0; i < 3; ++i) {
        u[i] = LANES_GATHER_FLOAT(uvs, w->worn + (VXL_WORN_UVS + 2u * i));
        v[i] = LANES_GATHER_FLOAT(uvs, w->worn + (VXL_WORN_UVS + 2u * i + 1u));
        area.u = fma(w->weight[i], u[i], area.u);
        area.v = fma(w->weight[i], v[i], area.v);
    }
    for (int i = 0; i < 2; ++i) {
        const lane_float b = dot_product(cross_of(w->sides[i], w->ac), n) * inverse;
        const lane_float c = dot_product(cross_of(w->ab, w->sides[i]), n) * inverse;
        area.side_u[i] = fma(b, u[1] - u[0], c * (u[2] - u[0]));
        area.side_v[i] = fma(b, v[1] - v[0], c * (v[2] - v[0]));
        area.off[i] = span->off[i];
        area.lean[i] = span->lean[i];
    }
    return area;
}

/// Replaces the colours of surfaces that wear a texture by the texture's mean over the rays' spans,
/// times the interpolated colour of the corners. Sets the values of its maps. Returns the mean
/// alpha.
static inline lane_float paint_triangles(const WornTriangle* w, const RaySpan* span,
                                         lane_float* color, MapValues* maps) {
    lane_float mean[4];
    const TextureArea area = area_of(w, span);
    texture_mean(w->textures, w->texture, &area, w->wears, mean);
    if (VXL_TEXTURE_MAPS) set_maps(w->textures, w->texture, &area, w->wears, maps);
    global const float* curve = (global const float*)w->textures;
    lane_uint corner[3];
    for (uint i = 0; i < 3; ++i)
        corner[i] =
            LANES_GATHER_UINT(w->words, w->worn + (VXL_WORN_COLORS + i)) & LANES_AS_UINT(w->wears);
    for (int c = 0; c < 3; ++c) {
        lane_float between = (lane_float)0.0f;
        for (int i = 0; i < 3; ++i)
            between = fma(w->weight[i],
                          LANES_GATHER_FLOAT(curve, (corner[i] >> (uint)(8 * c)) & 255u), between);
        color[c] = LANES_SELECT(w->wears, mean[c] * between, color[c]);
    }
    return mean[3];
}

/// Paints hits on exact triangles.
static inline void paint_exact(const WorldView* world, const ShadedHit* h, const RaySpan* span,
                               const Vector* sides, lane_float* color, MapValues* maps) {
    const lane_int triangle = h->exact & LANE_MASK((h->primitive & VXL_SOLID_PRIMITIVE) == 0u);
    const lane_uint number = h->primitive & LANES_AS_UINT(triangle);
    WornTriangle w;
    w.words = world->surface.triangle_textures;
    w.textures = world->surface.textures;
    w.worn = number * (uint)VXL_WORN_WORDS;
    w.texture = LANES_GATHER_UINT(w.words, w.worn + (uint)VXL_WORN_TEXTURE);
    w.wears = triangle & LANE_MASK(w.texture != VXL_NO_TEXTURE);
    if (!lanes_any(w.wears)) return;
    Vector from[3];
    for (uint i = 0; i < 3; ++i) {
        const Vector corner = triangle_corner(world->surface.triangles, number, i);
        from[i] = add_scaled(difference(h->ray.origin, corner), h->ray.direction, h->ray.t);
    }
    corner_weights(from, w.weight);
    w.ab = difference(from[0], from[1]), w.ac = difference(from[0], from[2]);
    w.sides = sides;
    const lane_float alpha = paint_triangles(&w, span, color, maps);
    if (VXL_TEXTURE_ALPHA)
        color[VXL_PAINT_OPACITY] = LANES_SELECT(w.wears, alpha, color[VXL_PAINT_OPACITY]);
}

/// Paints the points `at` of smooth objects by the closest points of their meshes, in the lanes
/// that `ask`. Alpha is ignored there, because a smooth object is a body.
static inline void paint_smooth(const SourceMeshes* sources, Vector at, lane_uint object,
                                lane_int ask, const RaySpan* span, const Vector* sides,
                                lane_float* color, MapValues* maps) {
    const SourceHit s = closest_of_points(sources, at, object, ask, sides);
    WornTriangle w;
    w.words = w.textures = sources->words;
    w.worn = s.worn;
    w.texture = LANES_GATHER_UINT(w.words, w.worn + (uint)VXL_WORN_TEXTURE);
    w.wears = s.found & LANE_MASK(w.texture != VXL_NO_TEXTURE);
    w.texture += s.textures;
    if (!lanes_any(w.wears)) return;
    closest_on_triangle(s.from, w.weight);
    w.ab = difference(s.from[0], s.from[1]), w.ac = difference(s.from[0], s.from[2]);
    w.sides = s.sides;
    paint_triangles(&w, span, color, maps);
}

/// Sets `color` to the surfaces' colours and opacity: those of their voxels, or of textures that
/// they wear. Where textures have maps, sets their values.
static inline void paint_of_hits(const WorldView* world, const SourceMeshes* sources,
                                 const ShadedHit* h, const RaySpan* span, Vector normal, Vector way,
                                 lane_float* color, MapValues* maps) {
    if (VXL_TEXTURE_MAPS) *maps = no_map_values();
    for (int c = 0; c < 3; ++c) color[c] = voxel_color(world->surface.colors, h->voxel, c);
    color[VXL_PAINT_OPACITY] = voxel_opacity(world->surface.colors, h->voxel);
    Vector sides[2];
    for (int i = 0; i < 2; ++i)
        sides[i] =
            in_hit_voxels(h, on_surface(span->side[i], normal, way), world->shape.inverse_edge);
    if (VXL_WORN_TRIANGLES && lanes_any(h->exact)) paint_exact(world, h, span, sides, color, maps);
    if (VXL_SOURCE_MESHES && lanes_any(h->smooth)) {
        const Vector at = add_scaled(h->ray.origin, h->ray.direction, h->ray.t);
        paint_smooth(sources, at, h->packed & VXL_OBJECT_MASK, h->smooth, span, sides, color, maps);
    }
}

/// Writes the paint of a packet's hits.
static inline void store_paint(const lane_float* all, global float* restrict paint, uint first) {
    const uint count = VXL_PAINT_FLOATS(VXL_TEXTURE_MAPS);
    float values[VXL_PAINT_FLOATS(VXL_TEXTURE_MAPS) * VXL_LANES];
    for (uint c = 0; c < count; ++c) LANES_STORE(all[c], values, c * VXL_LANES);
    for (uint lane = 0; lane < VXL_LANES; ++lane)
        for (uint c = 0; c < count; ++c)
            paint[(first + lane) * count + c] = values[c * VXL_LANES + lane];
}

/// Finds and writes the paint of hits at `position` with these materials; `all` has room for it.
/// Where textures have maps, sets their factors of emission.
static inline void paint_hits(const WorldView* world, const SourceMeshes* sources,
                              const ShadedHit* h, const Footprint* f, Vector position,
                              Vector normal, global const float* restrict materials,
                              lane_uint material, const RayBatch* batch, uint first,
                              lane_float* all, lane_float* emission_factors) {
    const float4 edge = world->shape.edge;
    const Vector metres = scaled(h->world_way, edge);
    const Vector way = unit(metres);
    lane_float before = (lane_float)0.0f;
    if (VXL_WIDENS)
        before = LANES_AS_FLOAT(LANES_LOAD(batch->paths, VXL_PATH_WIDTH * batch->stride + first));
    const lane_float travelled = h->world_t * exact_sqrt(dot_product(metres, metres));
    const RaySpan span = span_of(f, edge, position, normal, way, before, travelled);
    MapValues maps;
    paint_of_hits(world, sources, h, &span, normal, way, all, &maps);
    all[VXL_PAINT_WIDTH] = span.width;
    if (VXL_TEXTURE_MAPS) {
        map_material(materials, material, &maps, all + (VXL_PAINT_WIDTH + 1));
        for (int c = 0; c < 3; ++c) emission_factors[c] = maps.emission[c];
    }
    store_paint(all, batch->paint, first);
}

#endif
