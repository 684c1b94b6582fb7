// hits -> surface points with ambient light, then for each light -> a queue of shadow rays.
//
// `point` arrays hold, `stride` values apart: position in voxels (3), outward unit normal in metres' space (3).
#include "lib/exact_exp.h"
#include "lib/field.h"
#include "lib/fixed_point.h"
#include "lib/work_item.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

typedef struct {
    lane_float x, y, z;
} Vector;

static inline lane_float dot_product(Vector a, Vector b) {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}

/// v scaled to length 1; a vector without length stays as it is.
static inline Vector unit(Vector v) {
    const lane_float length = exact_sqrt(dot_product(v, v));
    const lane_float inverse =
        exact_reciprocal(LANES_SELECT(LANE_MASK(length > 0.0f), length, (lane_float)1.0f));
    Vector result = {v.x * inverse, v.y * inverse, v.z * inverse};
    return result;
}

static inline Vector select_vector(lane_int mask, Vector a, Vector b) {
    Vector result = {LANES_SELECT(mask, a.x, b.x), LANES_SELECT(mask, a.y, b.y),
                     LANES_SELECT(mask, a.z, b.z)};
    return result;
}

static inline Vector load_vector(global const float* restrict p, uint stride, uint first) {
    Vector v = {LANES_LOAD(p, first), LANES_LOAD(p, stride + first),
                LANES_LOAD(p, 2 * stride + first)};
    return v;
}

static inline void store_vector(Vector v, global float* restrict p, uint stride, uint first) {
    LANES_STORE(v.x, p, first);
    LANES_STORE(v.y, p, stride + first);
    LANES_STORE(v.z, p, 2 * stride + first);
}

static inline Vector triangle_normal(global const float* restrict triangles, lane_uint number,
                                     float4 edge) {
    const lane_uint first = number * 9u;
    const lane_float ax = LANES_GATHER_FLOAT(triangles, first);
    const lane_float ay = LANES_GATHER_FLOAT(triangles, first + 1u);
    const lane_float az = LANES_GATHER_FLOAT(triangles, first + 2u);
    const lane_float ux = (LANES_GATHER_FLOAT(triangles, first + 3u) - ax) * edge.x;
    const lane_float uy = (LANES_GATHER_FLOAT(triangles, first + 4u) - ay) * edge.y;
    const lane_float uz = (LANES_GATHER_FLOAT(triangles, first + 5u) - az) * edge.z;
    const lane_float vx = (LANES_GATHER_FLOAT(triangles, first + 6u) - ax) * edge.x;
    const lane_float vy = (LANES_GATHER_FLOAT(triangles, first + 7u) - ay) * edge.y;
    const lane_float vz = (LANES_GATHER_FLOAT(triangles, first + 8u) - az) * edge.z;
    Vector n = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
    return n;
}

/// 8-bit sRGB to linear, one channel of a packed colour.
static inline lane_float linear_channel(lane_uint color, int shift) {
    const lane_float s = LANES_FLOAT((color >> shift) & 255u) * (1.0f / 255.0f);
    const lane_float curved = exact_power(fma(s, 0.947867299f, 0.0521327014f), (lane_float)2.4f);
    return LANES_SELECT(LANE_MASK(s <= 0.04045f), s * 0.0773993808f, curved);
}

/// The colour of a surface point: its material's, times its voxel's own where the world has such.
static inline lane_float surface_color(global const float* restrict materials, lane_uint material,
                                       global const uint* restrict colors, lane_uint voxel,
                                       int channel) {
    lane_float color = LANES_GATHER_FLOAT(materials, material + (uint)channel);
    if (VXL_COLORS) color *= linear_channel(LANES_GATHER_UINT(colors, voxel), 8 * channel);
    return color;
}

/// Finds the point and normal of every hit, and starts its radiance with ambient light and emission;
/// rays that hit nothing take the background. `words` keeps each hit's attribute word.
kernel void shade_surface(PyramidShape shape, Space space,
                          global const float* restrict materials,
                          global const uint* restrict attributes, uint constant_attribute,
                          global const uint* restrict colors, global const uint* restrict fields,
                          global const float* restrict triangles,
                          global const uint* restrict triangle_attributes,
                          global const float* restrict rays, global const uint* restrict hits,
                          uint count, uint stride, global float* restrict positions,
                          global float* restrict normals, global uint* restrict words,
                          global float* restrict radiance) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const float4 edge = shape.edge;
    const lane_float t = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    const lane_uint number = LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first);
    const lane_uint cell_xy = LANES_LOAD(hits, VXL_HIT_CELL * stride + first);
    const lane_uint cell_face = LANES_LOAD(hits, VXL_HIT_FACE * stride + first);
    const lane_int hit = LANE_MASK(number != VXL_NO_VOXEL);
    const lane_uint voxel = number & LANES_AS_UINT(hit);
    const lane_float cx = LANES_FLOAT(cell_xy & 0xFFFFu), cy = LANES_FLOAT(cell_xy >> 16);
    const lane_float cz = LANES_FLOAT(cell_face & 0xFFFFu);
    const lane_uint axis = cell_face >> 16;
    const Vector o = load_vector(rays, stride, first);
    const Vector d = load_vector(rays + VXL_RAY_DX * stride, stride, first);
    const lane_float at = LANES_SELECT(hit, t, (lane_float)0.0f);
    // The position inside the voxel: a cube's on the face that was crossed, exactly.
    Vector s = {clamp(fma(d.x, at, o.x - cx), 0.0f, 1.0f), clamp(fma(d.y, at, o.y - cy), 0.0f, 1.0f),
                clamp(fma(d.z, at, o.z - cz), 0.0f, 1.0f)};

    lane_uint word = (lane_uint)constant_attribute;
    if (VXL_ATTRIBUTES) word = LANES_GATHER_UINT(attributes, voxel);
    Vector normal = {(lane_float)0.0f, (lane_float)0.0f, (lane_float)0.0f};
    lane_uint primitive = (lane_uint)VXL_NO_PRIMITIVE;
    if (VXL_EXACT) primitive = LANES_LOAD(hits, VXL_HIT_PRIMITIVE * stride + first);
    const lane_int exact = LANE_MASK(primitive != VXL_NO_PRIMITIVE) & hit;
    const lane_uint kind = word >> VXL_KIND_SHIFT;
    if (VXL_CUBES) {
        const lane_float up_x = LANES_FLOAT(LANE_MASK(d.x >= 0.0f)) * 2.0f + 1.0f;
        const lane_float up_y = LANES_FLOAT(LANE_MASK(d.y >= 0.0f)) * 2.0f + 1.0f;
        const lane_float up_z = LANES_FLOAT(LANE_MASK(d.z >= 0.0f)) * 2.0f + 1.0f;
        const lane_float zero = (lane_float)0.0f;
        Vector face = {LANES_SELECT(LANE_MASK(axis == 0u), up_x, zero),
                       LANES_SELECT(LANE_MASK(axis == 1u), up_y, zero),
                       LANES_SELECT(LANE_MASK(axis == 2u), up_z, zero)};
        const lane_int cubes = LANE_MASK(kind == VXL_KIND_CUBES) & hit & ~exact;
        const lane_float half_unit = (lane_float)0.5f;
        const Vector on_face = {
            LANES_SELECT(LANE_MASK(axis == 0u), fma(up_x, half_unit, half_unit), s.x),
            LANES_SELECT(LANE_MASK(axis == 1u), fma(up_y, half_unit, half_unit), s.y),
            LANES_SELECT(LANE_MASK(axis == 2u), fma(up_z, half_unit, half_unit), s.z)};
        s = select_vector(cubes, on_face, s);
        normal = select_vector(cubes, face, normal);
    }
    const lane_int smooth = LANE_MASK(kind != VXL_KIND_CUBES) & hit & ~exact;
    if (VXL_SMOOTH && lanes_any(smooth)) {
        const Field field =
            read_field(fields, voxel & LANES_AS_UINT(smooth), shape.half_curvature);
        Vector g;
        field_gradient(&field, s.x, s.y, s.z, &g.x, &g.y, &g.z);
        g.x *= shape.inverse_edge.x, g.y *= shape.inverse_edge.y, g.z *= shape.inverse_edge.z;
        normal = select_vector(smooth, unit(g), normal);
    }
    if (VXL_EXACT && lanes_any(exact)) {
        const lane_uint triangle = primitive & LANES_AS_UINT(exact);
        normal = select_vector(exact, unit(triangle_normal(triangles, triangle, edge)), normal);
        word = LANES_SELECT(exact, LANES_GATHER_UINT(triangle_attributes, triangle), word);
        const Vector along = {fma(d.x, at, o.x - cx), fma(d.y, at, o.y - cy), fma(d.z, at, o.z - cz)};
        s = select_vector(exact, along, s);
    }
    // Surfaces without an inside, and insides that a ray began in, face the ray.
    const Vector metric = {d.x * edge.x, d.y * edge.y, d.z * edge.z};
    const lane_int behind = LANE_MASK(dot_product(metric, normal) > 0.0f);
    const Vector flipped = {-normal.x, -normal.y, -normal.z};
    normal = select_vector(behind, flipped, normal);

    Vector position = {cx + s.x, cy + s.y, cz + s.z};
    store_vector(position, positions, stride, first);
    store_vector(normal, normals, stride, first);
    LANES_STORE(word, words, first);
    const lane_uint material =
        (((word >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK) * VXL_MATERIAL_FLOATS) &
        LANES_AS_UINT(hit);
    const lane_float diffuse = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_DIFFUSE);
    const float ambient[3] = {space.ambient.x, space.ambient.y, space.ambient.z};
    const float background[3] = {space.background.x, space.background.y, space.background.z};
    for (int channel = 0; channel < 3; ++channel) {
        const lane_float color = surface_color(materials, material, colors, voxel, channel);
        const lane_float emission =
            LANES_GATHER_FLOAT(materials, material + (uint)(VXL_MATERIAL_EMISSION + channel));
        const lane_float own = fma(color * diffuse, ambient[channel], emission);
        LANES_STORE(LANES_SELECT(hit, own, (lane_float)background[channel]), radiance,
                    (uint)channel * stride + first);
    }
}

/// The part of a spot's light that goes along the unit vector `to_surface`: smoothstep of the cosine.
static inline lane_float spot_share(LightRecord light, Vector to_surface) {
    const Vector along = {(lane_float)light.direction.x, (lane_float)light.direction.y,
                          (lane_float)light.direction.z};
    const lane_float cosine = dot_product(along, to_surface);
    const float width = fmax(light.inner_cosine - light.outer_cosine, 1.17549435e-38f);
    const lane_float s =
        clamp(exact_divide(cosine - light.outer_cosine, (lane_float)width), 0.0f, 1.0f);
    return s * s * fma(-2.0f, s, 3.0f);
}

/// Adds one light: every surface point that faces it, and to which it gives any light, gets a place in
/// the queue of shadow rays with the light's share. Without shadows the share is added at once.
kernel void shade_light(PyramidShape shape, Space space, LightRecord light,
                        global const float* restrict materials, global const uint* restrict colors,
                        global const float* restrict rays, global const uint* restrict hits,
                        uint count, uint stride, global const float* restrict positions,
                        global const float* restrict normals, global const uint* restrict words,
                        global float* restrict radiance, global uint* restrict queue_count,
                        global float* restrict queue_rays, global uint* restrict targets,
                        global uint* restrict sources, global float* restrict shares) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const float4 edge = shape.edge;
    const lane_uint number = LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first);
    lane_int lit = LANE_MASK(number != VXL_NO_VOXEL);
    if (!lanes_any(lit)) return;
    const lane_uint voxel = number & LANES_AS_UINT(lit);
    const Vector position = load_vector(positions, stride, first);
    const Vector normal = load_vector(normals, stride, first);

    Vector to_light = {light.position.x - position.x, light.position.y - position.y,
                       light.position.z - position.z};
    if (light.kind == VXL_LIGHT_DIRECTIONAL) {
        to_light.x = (lane_float)light.position.x;
        to_light.y = (lane_float)light.position.y;
        to_light.z = (lane_float)light.position.z;
    }
    const Vector metric = {to_light.x * edge.x, to_light.y * edge.y, to_light.z * edge.z};
    const lane_float squared = dot_product(metric, metric);
    lit &= LANE_MASK(squared > 0.0f);
    const Vector l = unit(metric);
    const lane_float cosine = dot_product(normal, l);
    lit &= LANE_MASK(cosine > 0.0f);
    lane_float falloff = (lane_float)1.0f;
    if (light.kind != VXL_LIGHT_DIRECTIONAL)
        falloff = exact_reciprocal(LANES_SELECT(lit, squared, (lane_float)1.0f));
    if (light.kind == VXL_LIGHT_SPOT) {
        const Vector to_surface = {-l.x, -l.y, -l.z};
        falloff *= spot_share(light, to_surface);
    }
    lit &= LANE_MASK(falloff > 0.0f);
    if (!lanes_any(lit)) return;

    // Blinn-Phong: the half vector between the light's direction and the viewer's.
    const Vector d = load_vector(rays + VXL_RAY_DX * stride, stride, first);
    const Vector towards = {-d.x * edge.x, -d.y * edge.y, -d.z * edge.z};
    const Vector view = unit(towards);
    const Vector between = {l.x + view.x, l.y + view.y, l.z + view.z};
    const lane_float highlight = clamp(dot_product(normal, unit(between)), 0.0f, 1.0f);
    const lane_uint word = LANES_LOAD(words, first);
    const lane_uint material =
        (((word >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK) * VXL_MATERIAL_FLOATS) &
        LANES_AS_UINT(lit);
    const lane_float diffuse =
        LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_DIFFUSE) * cosine;
    const lane_float specular =
        LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_SPECULAR) *
        exact_power(highlight, LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_SHININESS));

    const lane_float scale = power_of_two_scale(
        LANES_SELECT(lit, to_light.x, (lane_float)1.0f), to_light.y, to_light.z);
    const Vector direction = {snap_direction(to_light.x * scale),
                              snap_direction(to_light.y * scale),
                              snap_direction(to_light.z * scale)};
    const Vector origin = {
        clamp(snap_position(position.x, normal.x, shape.fixed_point), 0.0f, (float)shape.size_x),
        clamp(snap_position(position.y, normal.y, shape.fixed_point), 0.0f, (float)shape.size_y),
        clamp(snap_position(position.z, normal.z, shape.fixed_point), 0.0f, (float)shape.size_z)};
    lane_float t_end = (lane_float)INFINITY;
    if (light.kind != VXL_LIGHT_DIRECTIONAL) t_end = exact_reciprocal(scale);
    lane_float path = (lane_float)0.0f;
    if (VXL_MEDIUM) {  // metres of medium on the way: to the light, or to the end of the world
        lane_float t_first = (lane_float)0.0f, t_last = t_end;
        clip_axis(origin.x, direction.x, (float)shape.size_x, &t_first, &t_last);
        clip_axis(origin.y, direction.y, (float)shape.size_y, &t_first, &t_last);
        clip_axis(origin.z, direction.z, (float)shape.size_z, &t_first, &t_last);
        path = fmax(t_last, 0.0f) * scale * exact_sqrt(squared);
    }
    const float energy[3] = {light.energy.x, light.energy.y, light.energy.z};
    const float absorption[3] = {space.absorption.x, space.absorption.y, space.absorption.z};
    lane_float share[3];
    lane_int any_share = (lane_int)0;
    for (int channel = 0; channel < 3; ++channel) {
        const lane_float color = surface_color(materials, material, colors, voxel, channel);
        share[channel] = fma(color, diffuse, specular) * falloff * energy[channel];
        if (VXL_MEDIUM) share[channel] *= exact_exp(-absorption[channel] * path);
        any_share |= LANE_MASK(share[channel] > 0.0f);
    }
    lit &= any_share;
    if (!VXL_SHADOWS) {
        for (int channel = 0; channel < 3; ++channel) {
            const uint place = (uint)channel * stride + first;
            const lane_float sum = LANES_LOAD(radiance, place) + share[channel];
            LANES_STORE(LANES_SELECT(lit, sum, LANES_LOAD(radiance, place)), radiance, place);
        }
        return;
    }
    // One place in the queue for each lit lane, all reserved at once.
    int lit_lane[VXL_LANES];
    LANES_STORE(lit, lit_lane, 0);
    uint wanted = 0;
    for (int lane = 0; lane < VXL_LANES; ++lane) wanted += (uint)(lit_lane[lane] & 1);
    if (wanted == 0) return;
    uint place = atomic_add(queue_count, wanted);
    float queued[10 * VXL_LANES];
    uint source[VXL_LANES];
    LANES_STORE(origin.x, queued, 0 * VXL_LANES);
    LANES_STORE(origin.y, queued, 1 * VXL_LANES);
    LANES_STORE(origin.z, queued, 2 * VXL_LANES);
    LANES_STORE(direction.x, queued, 3 * VXL_LANES);
    LANES_STORE(direction.y, queued, 4 * VXL_LANES);
    LANES_STORE(direction.z, queued, 5 * VXL_LANES);
    LANES_STORE(t_end, queued, 6 * VXL_LANES);
    LANES_STORE(share[0], queued, 7 * VXL_LANES);
    LANES_STORE(share[1], queued, 8 * VXL_LANES);
    LANES_STORE(share[2], queued, 9 * VXL_LANES);
    if (VXL_EXACT) LANES_STORE(LANES_LOAD(hits, VXL_HIT_PRIMITIVE * stride + first), source, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane) {
        if (!lit_lane[lane]) continue;
        for (uint c = 0; c < VXL_RAY_COMPONENTS; ++c)
            queue_rays[c * stride + place] = queued[c * VXL_LANES + (uint)lane];
        for (uint c = 0; c < 3; ++c)
            shares[c * stride + place] = queued[(VXL_RAY_COMPONENTS + c) * VXL_LANES + (uint)lane];
        targets[place] = first + (uint)lane;
        if (VXL_EXACT) sources[place] = source[lane];
        ++place;
    }
}
