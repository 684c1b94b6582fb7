// What transmitting surfaces and objects leave of the light along a shadow ray.
#ifndef VXL_FILTER_H
#define VXL_FILTER_H

#include "lib/lanes/fixed_point.h"
#include "lib/surface/surface_color.h"
#include "lib/traverse/density.h"
#include "lib/traverse/instances.h"

/// Finds the body of cubes that the rays are inside of.
static inline void find_body(RayState* ray_state, global const float* restrict materials) {
    ray_state->body = body_inside(&ray_state->media);
    ray_state->joined = is_joined(ray_state->body, materials);
}

/// The medium of S.
typedef struct {
    float4 absorption;  // per metre, at density 1
    DensityView density;
} MediumView;

/// Density times t of the medium between t_first and t_last of the `open` lanes.
static inline lane_float medium_between(const PyramidView* p, const MediumView* medium,
                                        const Walk* w, lane_float t_first, lane_float t_last,
                                        lane_int open) {
    if (!VXL_MEDIUM_GRID) return LANES_SELECT(open, t_last - t_first, (lane_float)0.0f);
    Walk walk = begin_walk(w->ox, w->oy, w->oz, w->dx, w->dy, w->dz);
    return LANES_SELECT(open, walk_density(p, &medium->density, &walk, t_first, t_last, open),
                        (lane_float)0.0f);
}

/// What the way of shadow rays is through.
typedef struct {
    uint constant_attribute;
    global const float* restrict materials;
    global const uint* restrict colors;
    global const uint* restrict ranks;
    global uint* medium_overflows;
    MediumView medium;
    InstanceView instances;
} FilterView;

/// How far shadow rays have come, and what surfaces and objects on the way leave of their light.
typedef struct {
    lane_float throughput[3];  // by surfaces
    lane_float depth[3];       // optical depth of objects and of the medium between them
    lane_float t_last;         // where the last surface was
    lane_float t_out;          // where the way leaves the world, in which objects end
    lane_float metres;         // of a unit of t
    lane_int layers;           // surfaces met
} Filter;

/// For rays that set out.
static inline Filter begin_filter(PyramidShape shape, const Walk* w, lane_float t_end) {
    Filter filter;
    for (int channel = 0; channel < 3; ++channel) {
        filter.throughput[channel] = (lane_float)1.0f;
        filter.depth[channel] = (lane_float)0.0f;
    }
    filter.t_last = (lane_float)0.0f;
    lane_float t_in = filter.t_last;
    filter.t_out = t_end;
    const Vector o = {w->ox, w->oy, w->oz}, d = {w->dx, w->dy, w->dz};
    clip_to_world(o, d, shape.size_x, shape.size_y, shape.size_z, &t_in, &filter.t_out);
    filter.metres = metres_per_t(shape.edge, d);
    filter.layers = (lane_int)0;
    return filter;
}

/// Filters the light of the `ended` rays on their way to the surface that those of `hit` have
/// found, or to their light, and lets it go on through that surface: the mask of rays that do. The
/// surface numbered VXL_MAX_LAYERS ends a ray.
static inline lane_int pass_surface(const PyramidView* p, const SurfaceView* s, const FilterView* v,
                                    Walk* w, const SurfaceHit* found, lane_int ended, lane_int hit,
                                    RayState* ray_state, Filter* filter) {
    global const float* materials = v->materials;
    // The way up to here, to the light or out of the world, inside of the object that counts.
    const lane_uint before = effective_medium(&ray_state->media, v->ranks);
    const lane_uint medium =
        material_offset(before) & LANES_AS_UINT(LANE_MASK(before != VXL_NO_MEDIUM));
    const lane_float t_now = LANES_SELECT(hit, found->t, fmax(filter->t_out, filter->t_last));
    const lane_int absorbs = ended & LANE_MASK(before != VXL_NO_MEDIUM);
    const lane_float way =
        LANES_SELECT(absorbs, (t_now - filter->t_last) * filter->metres, (lane_float)0.0f);
    for (int channel = 0; channel < 3; ++channel)
        filter->depth[channel] =
            fma(LANES_GATHER_FLOAT(materials, medium + (uint)(VXL_MATERIAL_ABSORPTION + channel)),
                way, filter->depth[channel]);
    const lane_int open = ended & ~absorbs;
    if (VXL_MEDIUM && lanes_any(open)) {
        const lane_float amount = medium_between(p, &v->medium, w, filter->t_last,
                                                 LANES_SELECT(open, t_now, filter->t_last), open) *
                                  filter->metres;
        const float per_metre[3] = {v->medium.absorption.x, v->medium.absorption.y,
                                    v->medium.absorption.z};
        for (int channel = 0; channel < 3; ++channel)
            filter->depth[channel] =
                fma((lane_float)per_metre[channel], amount, filter->depth[channel]);
    }
    if (!lanes_any(hit)) return hit;

    const lane_uint voxel = found->voxel & LANES_AS_UINT(hit);
    lane_uint packed =
        attributes_of_hit(s->attributes, v->constant_attribute, s->triangle_attributes, s->solids,
                          voxel, found->primitive, hit);
    if (VXL_INSTANCES)
        packed =
            instance_attributes(v->instances.records, v->instances.group_materials, found->instance,
                                packed, hit & LANE_MASK(found->instance != VXL_NO_INSTANCE));
    const lane_int smooth = is_smooth(packed, found->primitive);
    const lane_uint material = material_offset(packed) & LANES_AS_UINT(hit);
    const lane_float opacity = surface_opacity(materials, material, v->colors, voxel);
    const lane_float refraction = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFRACTION);
    filter->layers -= hit;
    lane_int passing = hit & LANE_MASK(filter->layers < VXL_MAX_LAYERS);
    passing &= LANE_MASK(opacity < 1.0f) | LANE_MASK(refraction > 0.0f) | found->exit;
    lane_int leaving = medium_set_holds(&ray_state->media, packed, smooth);
    lane_int inner = (lane_int)0;
    if (VXL_CUBE_BODIES) {
        const lane_int cube = is_cube(packed, found->primitive);
        inner = cube & leaving & ~found->exit;
        leaving = LANES_SELECT(cube, found->exit, leaving);
    }
    lane_int full;
    ray_state->media =
        cross_medium_or_overflow(ray_state->media, packed, smooth, leaving, passing, &full);
    if (VXL_MEDIUM_SET_CAPPED && lanes_any(full))
        atomic_add(v->medium_overflows, (uint)lanes_count(full));
    lane_int hidden = same_medium(before, effective_medium(&ray_state->media, v->ranks)) & passing;
    if (VXL_CUBE_BODIES) {
        hidden |= found->exit & LANE_MASK(refraction == 0.0f);
        hidden = LANES_SELECT(inner, ~same_medium(before, packed), hidden);
        find_body(ray_state, materials);
    }
    const lane_uint color = color_offset(materials, material, fma(w->dx, found->t, w->ox),
                                         fma(w->dy, found->t, w->oy), fma(w->dz, found->t, w->oz));
    const lane_float clear = 1.0f - opacity;
    for (int channel = 0; channel < 3; ++channel) {
        const lane_float tint =
            fma(opacity, surface_color(materials, color, v->colors, voxel, channel), clear);
        lane_float part = clear * tint;
        if (VXL_FILTERED) part = fma(opacity, refraction, part);
        filter->throughput[channel] *= LANES_SELECT(passing & ~hidden, part, (lane_float)1.0f);
    }
    if (!VXL_FILTERED) passing &= hidden | LANE_MASK(clear > 0.0f);
    ray_state->goes_on |= passing;
    ray_state->on_surface |= passing;
    ray_state->source = LANES_SELECT(passing, found->primitive, ray_state->source);
    ray_state->instance = LANES_SELECT(passing, found->instance, ray_state->instance);
    ray_state->within_source = LANES_SELECT(passing, ~leaving, ray_state->within_source);
    ray_state->t_first = LANES_SELECT(passing, found->t, ray_state->t_first);
    filter->t_last = ray_state->t_first;
    w->t = LANES_SELECT(passing, fmax(found->t, w->t), w->t);
    w->axis = LANES_SELECT(passing & ~found->exit, (lane_int)3, w->axis);
    return passing;
}

#endif
