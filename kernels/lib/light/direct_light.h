// SPDX-License-Identifier: Apache-2.0
// The light that a source sends to surface points, and the shadow rays that decide whether it
// arrives.
//
// Local light follows Whitted 1980: ambient light, Lambert's cosine, and the highlight of Blinn's
// half vector.
#ifndef VXL_DIRECT_LIGHT_H
#define VXL_DIRECT_LIGHT_H

#include "lib/lanes/vector.h"
#include "lib/light/physical_light.h"
#include "lib/traverse/offset_origin.h"
#include "lib/traverse/world.h"
#include "shared/scene.h"
#include "shared/trace.h"

/// The part of a spot light's intensity along the unit vector `to_surface`: a smoothstep of the
/// cosine.
static inline lane_float spot_falloff(const Light* light, Vector to_surface) {
    const lane_float cosine = dot_product(light->direction, to_surface);
    const lane_float width = fmax(light->inner_cosine - light->outer_cosine, 1.17549435e-38f);
    const lane_float s = clamp(exact_divide(cosine - light->outer_cosine, width), 0.0f, 1.0f);
    return s * s * fma(-2.0f, s, 3.0f);
}

/// The falloff of a small part of an emissive surface at a point at distance d, which sees the part
/// at an angle with this cosine: cosine / (d^2 + A/pi). Above a disk's middle this is exact; far
/// away it is the cosine over d^2; and near by it never exceeds the light that a surface can
/// receive (Wallace, Elmquist and Haines 1989).
static inline lane_float area_sample_falloff(const Light* light, Vector to_surface,
                                             lane_float squared) {
    const lane_float cosine = dot_product(light->direction, to_surface);
    const lane_int faces = LANE_MASK(cosine > 0.0f);
    const lane_float sum = LANES_SELECT(faces, squared + light->spread, (lane_float)1.0f);
    return LANES_SELECT(faces, cosine * exact_reciprocal(sum), (lane_float)0.0f);
}

/// The light's falloff at the `lit` points, whose squared distances to the light in square metres
/// are `squared`.
static inline lane_float falloff_of(const Light* light, Vector l, lane_float squared,
                                    lane_int lit) {
    lane_float falloff = (lane_float)1.0f;
    if (light->kind != VXL_LIGHT_DIRECTIONAL)
        falloff = exact_reciprocal(LANES_SELECT(lit, squared, (lane_float)1.0f));
    if (light->kind == VXL_LIGHT_SPOT) falloff *= spot_falloff(light, opposite(l));
    if (VXL_AREA_SAMPLES && light->kind == VXL_LIGHT_AREA_SAMPLE)
        falloff = area_sample_falloff(light, opposite(l), squared);
    return falloff;
}

/// The light as it arrives at surface points. `from` holds points of the light or, for a
/// directional light, the vectors that lead to it.
static inline Incidence incidence_of(const Light* light, Vector from, float4 edge, Vector position,
                                     Vector normal, lane_int lit) {
    Incidence i;
    i.to_light = from;
    if (light->kind != VXL_LIGHT_DIRECTIONAL)
        i.to_light.x -= position.x, i.to_light.y -= position.y, i.to_light.z -= position.z;
    const Vector metric = scaled(i.to_light, edge);
    const lane_float squared = dot_product(metric, metric);
    i.lit = lit & LANE_MASK(squared > 0.0f);
    i.l = unit(metric);
    i.cosine = dot_product(normal, i.l);
    i.lit &= LANE_MASK(i.cosine > 0.0f);
    i.falloff = falloff_of(light, i.l, squared, i.lit);
    i.lit &= LANE_MASK(i.falloff > 0.0f);
    return i;
}

/// Blinn-Phong: the cosine between the normal and the half vector of the directions to the light,
/// `l`, and to the viewer, who looks along `d`.
static inline lane_float highlight_of(Vector normal, Vector l, Vector d, float4 edge) {
    const Vector view = unit(scaled(opposite(d), edge));
    const Vector between = {l.x + view.x, l.y + view.y, l.z + view.z};
    return clamp(dot_product(normal, unit(between)), 0.0f, 1.0f);
}

/// Shadow rays from surface points to the light, and the light that each brings if nothing blocks
/// it.
typedef struct {
    Vector origin, direction;
    lane_float t_end;
    lane_float contribution[3];
} LitRays;

/// Aims rays at the light from `start`, which lies on the side of the surface that `normal` points
/// to.
static inline void aim_at_light(PyramidShape shape, const Light* light, const Incidence* i,
                                Vector start, Vector normal, LitRays* r) {
    const Vector to = i->to_light;
    const lane_float scale =
        power_of_two_scale(LANES_SELECT(i->lit, to.x, (lane_float)1.0f), to.y, to.z);
    r->direction.x = snap_direction(to.x * scale);
    r->direction.y = snap_direction(to.y * scale);
    r->direction.z = snap_direction(to.z * scale);
    const float one = shape.fixed_point;
    r->origin.x = clamp(snap_position(start.x, normal.x, one), 0.0f, (float)shape.size_x);
    r->origin.y = clamp(snap_position(start.y, normal.y, one), 0.0f, (float)shape.size_y);
    r->origin.z = clamp(snap_position(start.z, normal.z, one), 0.0f, (float)shape.size_z);
    r->t_end = (lane_float)INFINITY;
    if (light->kind != VXL_LIGHT_DIRECTIONAL) r->t_end = exact_reciprocal(scale);
}

/// The specular share of surfaces and, below, the exponent of their highlights, which maps change
/// in local light.
static inline lane_float surface_specular(global const float* restrict materials,
                                          lane_uint material, Colors colors) {
    if (VXL_GLOBAL) return LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_SPECULAR);
    return mapped_value(materials, material + VXL_MATERIAL_SPECULAR, colors, VXL_PAINT_SPECULAR);
}

static inline lane_float surface_shininess(global const float* restrict materials,
                                           lane_uint material, Colors colors) {
    if (VXL_GLOBAL) return LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_SHININESS);
    return mapped_value(materials, material + VXL_MATERIAL_SHININESS, colors, VXL_PAINT_SHININESS);
}

/// The light that surfaces of `material` at `position` return towards the viewer. Returns a mask of
/// the points that return any.
static inline lane_int find_contributions(const Light* light, const Incidence* i,
                                          lane_float highlight, Vector position, lane_uint material,
                                          Colors colors, global const float* restrict materials,
                                          lane_float* contribution) {
    const lane_float diffuse = surface_diffuse(materials, material, colors) * i->cosine;
    const lane_float specular =
        surface_specular(materials, material, colors) *
        exact_power(highlight, surface_shininess(materials, material, colors));
    lane_float tint = (lane_float)0.0f;
    if (VXL_TINTED)
        tint = mapped_value(materials, material + VXL_MATERIAL_HIGHLIGHT_TINT, colors,
                            VXL_PAINT_HIGHLIGHT_TINT);
    const lane_float falloff = i->falloff * surface_opacity(materials, material, colors);
    const lane_uint color_at =
        color_offset(materials, material, position.x, position.y, position.z);
    lane_int any_contribution = (lane_int)0;
    for (int channel = 0; channel < 3; ++channel) {
        const lane_float color = surface_color(materials, color_at, colors, channel);
        lane_float shine = specular;
        if (VXL_TINTED) shine *= tinted(color, tint);
        contribution[channel] = fma(color, diffuse, shine) * falloff * light->intensity[channel];
        any_contribution |= LANE_MASK(contribution[channel] > 0.0f);
    }
    return any_contribution;
}

/// Adds the `lit` lanes' contributions to the radiance of the rays from `first` on.
static inline void add_contributions(const lane_float* contribution, lane_int lit,
                                     const RayBatch* batch, uint first) {
    for (int channel = 0; channel < 3; ++channel) {
        const uint index = (uint)channel * batch->stride + first;
        const lane_float sum = LANES_LOAD(batch->radiance, index) + contribution[channel];
        LANES_STORE(LANES_SELECT(lit, sum, LANES_LOAD(batch->radiance, index)), batch->radiance,
                    index);
    }
}

/// The primitives that rays to the light begin on, and therefore don't meet. A ray that begins
/// above its triangle may meet it on its way to a light behind it.
static inline lane_uint sources_of(const RayBatch* batch, uint first, lane_int behind) {
    const lane_uint packed = LANES_LOAD(batch->hit_attributes, first);
    const lane_uint source = source_of_hits(batch->hits, batch->stride, first, packed);
    if (!VXL_SHADING_NORMALS) return source;
    return LANES_SELECT(behind, (lane_uint)VXL_NO_PRIMITIVE, source);
}

/// Writes the `lit` lanes' rays, which begin on the sources `begins_on`, to slots of the queue,
/// `stride` apart. All slots are reserved at once.
static inline void queue_rays(const ShadowQueue* queue, const LitRays* r, lane_int lit,
                              lane_uint begins_on, uint stride, uint first) {
    int lit_lane[VXL_LANES];
    LANES_STORE(lit, lit_lane, 0);
    uint wanted = 0;
    for (int lane = 0; lane < VXL_LANES; ++lane) wanted += (uint)(lit_lane[lane] & 1);
    if (wanted == 0) return;
    uint slot = atomic_add(queue->count, wanted);
    float queued[10 * VXL_LANES];
    uint source[VXL_LANES];
    LANES_STORE(r->origin.x, queued, 0 * VXL_LANES);
    LANES_STORE(r->origin.y, queued, 1 * VXL_LANES);
    LANES_STORE(r->origin.z, queued, 2 * VXL_LANES);
    LANES_STORE(r->direction.x, queued, 3 * VXL_LANES);
    LANES_STORE(r->direction.y, queued, 4 * VXL_LANES);
    LANES_STORE(r->direction.z, queued, 5 * VXL_LANES);
    LANES_STORE(r->t_end, queued, 6 * VXL_LANES);
    LANES_STORE(r->contribution[0], queued, 7 * VXL_LANES);
    LANES_STORE(r->contribution[1], queued, 8 * VXL_LANES);
    LANES_STORE(r->contribution[2], queued, 9 * VXL_LANES);
    if (VXL_SOURCES) LANES_STORE(begins_on, source, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane) {
        if (!lit_lane[lane]) continue;
        for (uint c = 0; c < VXL_RAY_COMPONENTS; ++c)
            queue->rays[c * stride + slot] = queued[c * VXL_LANES + (uint)lane];
        for (uint c = 0; c < 3; ++c)
            queue->contributions[c * stride + slot] =
                queued[(VXL_RAY_COMPONENTS + c) * VXL_LANES + (uint)lane];
        queue->targets[slot] = first + (uint)lane;
        if (VXL_SOURCES) queue->sources[slot] = source[lane];
        ++slot;
    }
}

/// Moves the starts of shadow rays off the surfaces, and clears `lit` for points that are lit from
/// behind. Returns the mask of rays that begin above a triangle and leave it on its back.
static inline lane_int start_off_surface(const WorldView* world, const RayBatch* batch, uint first,
                                         const Light* light, Incidence* incidence, LitPoints* p) {
    const uint stride = batch->stride;
    lane_int behind = (lane_int)0;
    if (VXL_SHADING_NORMALS) {
        behind = LANE_MASK(dot_product(p->normal, incidence->l) <= 0.0f);
        const Vector offset =
            load_vector(batch->shading + VXL_SHADING_OFFSET * stride, stride, first);
        p->lit &= ~behind | has_length(offset);
        const Vector up = scaled(offset, world->shape.inverse_edge);
        p->start = add_scaled(p->start, up, (lane_float)1.0f);
        if (light->kind != VXL_LIGHT_DIRECTIONAL)
            incidence->to_light = difference(incidence->to_light, up);
    }
    if (!(VXL_INSTANCES | VXL_TRIANGLES)) return behind;
    const Vector start =
        offset_origin(world->shape, p->start, p->normal, batch->hits, stride, first);
    if (light->kind != VXL_LIGHT_DIRECTIONAL)
        incidence->to_light = difference(incidence->to_light, difference(start, p->start));
    p->start = start;
    return behind;
}

/// True if something can block light.
#define VXL_QUEUES_LIGHT (VXL_SHADOWS || VXL_MEDIUM)

/// Queues the `lit` lanes' rays, or adds their light at once if nothing can block it. Lanes in
/// `behind` have the light behind the triangles that they begin above.
static inline void send_or_add(const ShadowQueue* queue, const LitRays* r, lane_int lit,
                               lane_int behind, const RayBatch* batch, uint first) {
    if (VXL_QUEUES_LIGHT) {
        lane_uint source = (lane_uint)VXL_NO_PRIMITIVE;
        if (VXL_SOURCES) source = sources_of(batch, first, behind);
        queue_rays(queue, r, lit, source, batch->stride, first);
    } else {
        add_contributions(r->contribution, lit, batch, first);
    }
}

/// Adds a light that shines on surface points from the points `from`: each of them that faces the
/// light and returns some of it gets a slot in the queue of shadow rays, with the light's
/// contribution. If neither an object nor the medium can block it, the contribution is added at
/// once. Paths that physically based surfaces scatter may also run into `area` square metres of the
/// light.
static inline void shine_on(const WorldView* world, const Light* light, Vector from,
                            lane_float area, global const float* restrict materials,
                            const ShadowQueue* queue, const RayBatch* batch, uint first,
                            LitPoints points) {
    LitPoints p = points;
    const float4 edge = world->shape.edge;
    Incidence incidence = incidence_of(light, from, edge, p.position, p.shading_normal, p.lit);
    p.lit = incidence.lit;
    const lane_int behind = start_off_surface(world, batch, first, light, &incidence, &p);
    if (!lanes_any(p.lit)) return;
    p.material &= LANES_AS_UINT(p.lit);
    const Vector d = load_vector(batch->rays + VXL_RAY_DX * batch->stride, batch->stride, first);
    const lane_float highlight = highlight_of(p.shading_normal, incidence.l, d, edge);
    LitRays r;
    aim_at_light(world->shape, light, &incidence, p.start, p.normal, &r);
    lane_int some = find_contributions(light, &incidence, highlight, p.position, p.material,
                                       p.colors, materials, r.contribution);
    if (VXL_PHYSICAL)
        some = find_physical_contributions(light, &incidence, area, &p, d, edge, materials, some,
                                           r.contribution);
    send_or_add(queue, &r, p.lit & some, behind, batch, first);
}

/// Adds a light in the same way to the surface points of a packet of hits.
static inline void shine_from(const WorldView* world, LightRecord record, Vector from,
                              lane_float area, global const float* restrict materials,
                              const ShadowQueue* queue, const RayBatch* batch, uint first) {
    LitPoints p;
    if (!load_lit_points(world, batch, first, &p)) return;
    const Light light = light_of(record);
    shine_on(world, &light, from, area, materials, queue, batch, first, p);
}

#endif
