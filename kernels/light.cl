// surface points + a light -> a queue of shadow rays, each with the light that it would bring.
//
// Whitted 1980: ambient, Lambert's cosine, and the highlight of Blinn's half vector.
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/surface/surface_color.h"
#include "lib/traverse/offset_origin.h"
#include "shared/scene.h"
#include "shared/trace.h"

/// The part of a spot's light that goes along the unit vector `to_surface`: smoothstep of the
/// cosine.
static inline lane_float spot_falloff(LightRecord light, Vector to_surface) {
    const Vector along = {(lane_float)light.direction.x, (lane_float)light.direction.y,
                          (lane_float)light.direction.z};
    const lane_float cosine = dot_product(along, to_surface);
    const float width = fmax(light.inner_cosine - light.outer_cosine, 1.17549435e-38f);
    const lane_float s =
        clamp(exact_divide(cosine - light.outer_cosine, (lane_float)width), 0.0f, 1.0f);
    return s * s * fma(-2.0f, s, 3.0f);
}

/// What a small patch of an emissive surface gives to a point at distance d, where it is seen at an
/// angle with this cosine: cosine / (d^2 + A/pi). Beside a disk's middle that is exact, from far
/// away it is the cosine over d^2, and no nearness makes it more than all the light that a
/// surface can get (Wallace, Elmquist and Haines 1989).
static inline lane_float area_sample_falloff(LightRecord light, Vector to_surface,
                                             lane_float squared) {
    const Vector normal = {(lane_float)light.direction.x, (lane_float)light.direction.y,
                           (lane_float)light.direction.z};
    const lane_float cosine = dot_product(normal, to_surface);
    const lane_int faces = LANE_MASK(cosine > 0.0f);
    const lane_float sum = LANES_SELECT(faces, squared + light.spread, (lane_float)1.0f);
    return LANES_SELECT(faces, cosine * exact_reciprocal(sum), (lane_float)0.0f);
}

/// Adds one light: every surface point that faces it, and to which it gives any light, gets a place
/// in the queue of shadow rays with the light's share. Where neither an object nor the medium can
/// come between, the share is added at once.
kernel void add_light(PyramidShape shape, LightRecord light, global const float* restrict materials,
                      global const uint* restrict colors, global const float* restrict rays,
                      global const uint* restrict hits, uint count, uint stride,
                      global const float* restrict positions, global const float* restrict normals,
                      global const uint* restrict hit_attributes, global const uint* restrict sides,
                      global float* restrict radiance, global uint* restrict queue_count,
                      global float* restrict queue_rays, global uint* restrict targets,
                      global uint* restrict sources, global float* restrict contributions) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const float4 edge = shape.edge;
    const lane_uint number = LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first);
    lane_int lit = LANE_MASK(number != VXL_NO_VOXEL);
    if (VXL_TRANSMISSION) lit &= LANE_MASK((LANES_LOAD(sides, first) & VXL_SIDE_HIDDEN) == 0u);
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
        falloff *= spot_falloff(light, to_surface);
    }
    if (VXL_AREA_SAMPLES && light.kind == VXL_LIGHT_AREA_SAMPLE) {
        const Vector to_surface = {-l.x, -l.y, -l.z};
        falloff = area_sample_falloff(light, to_surface, squared);
    }
    lit &= LANE_MASK(falloff > 0.0f);
    if (!lanes_any(lit)) return;

    // Blinn-Phong: the half vector between the light's direction and the viewer's.
    const Vector d = load_vector(rays + VXL_RAY_DX * stride, stride, first);
    const Vector towards = {-d.x * edge.x, -d.y * edge.y, -d.z * edge.z};
    const Vector view = unit(towards);
    const Vector between = {l.x + view.x, l.y + view.y, l.z + view.z};
    const lane_float highlight = clamp(dot_product(normal, unit(between)), 0.0f, 1.0f);
    const lane_uint packed = LANES_LOAD(hit_attributes, first);
    const lane_uint material = material_offset(packed) & LANES_AS_UINT(lit);
    const lane_float diffuse =
        LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_DIFFUSE) * cosine;
    const lane_float specular =
        LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_SPECULAR) *
        exact_power(highlight, LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_SHININESS));

    const lane_float scale =
        power_of_two_scale(LANES_SELECT(lit, to_light.x, (lane_float)1.0f), to_light.y, to_light.z);
    const Vector direction = {snap_direction(to_light.x * scale),
                              snap_direction(to_light.y * scale),
                              snap_direction(to_light.z * scale)};
    const Vector start = offset_origin(shape, position, normal, hits, stride, first);
    const Vector origin = {
        clamp(snap_position(start.x, normal.x, shape.fixed_point), 0.0f, (float)shape.size_x),
        clamp(snap_position(start.y, normal.y, shape.fixed_point), 0.0f, (float)shape.size_y),
        clamp(snap_position(start.z, normal.z, shape.fixed_point), 0.0f, (float)shape.size_z)};
    lane_float t_end = (lane_float)INFINITY;
    if (light.kind != VXL_LIGHT_DIRECTIONAL) t_end = exact_reciprocal(scale);
    const float intensity[3] = {light.intensity.x, light.intensity.y, light.intensity.z};
    falloff *= surface_opacity(materials, material, colors, voxel);
    const lane_uint color_at =
        color_offset(materials, material, position.x, position.y, position.z);
    lane_float contribution[3];
    lane_int any_contribution = (lane_int)0;
    for (int channel = 0; channel < 3; ++channel) {
        const lane_float color = surface_color(materials, color_at, colors, voxel, channel);
        contribution[channel] = fma(color, diffuse, specular) * falloff * intensity[channel];
        any_contribution |= LANE_MASK(contribution[channel] > 0.0f);
    }
    lit &= any_contribution;
    if (!(VXL_SHADOWS | VXL_MEDIUM)) {
        for (int channel = 0; channel < 3; ++channel) {
            const uint place = (uint)channel * stride + first;
            const lane_float sum = LANES_LOAD(radiance, place) + contribution[channel];
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
    LANES_STORE(contribution[0], queued, 7 * VXL_LANES);
    LANES_STORE(contribution[1], queued, 8 * VXL_LANES);
    LANES_STORE(contribution[2], queued, 9 * VXL_LANES);
    if (VXL_EXACT) LANES_STORE(LANES_LOAD(hits, VXL_HIT_PRIMITIVE * stride + first), source, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane) {
        if (!lit_lane[lane]) continue;
        for (uint c = 0; c < VXL_RAY_COMPONENTS; ++c)
            queue_rays[c * stride + place] = queued[c * VXL_LANES + (uint)lane];
        for (uint c = 0; c < 3; ++c)
            contributions[c * stride + place] =
                queued[(VXL_RAY_COMPONENTS + c) * VXL_LANES + (uint)lane];
        targets[place] = first + (uint)lane;
        if (VXL_EXACT) sources[place] = source[lane];
        ++place;
    }
}
