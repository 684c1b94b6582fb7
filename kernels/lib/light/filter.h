// SPDX-License-Identifier: Apache-2.0
// The part of a shadow ray's light that transmitting surfaces and objects let through.
#ifndef VXL_FILTER_H
#define VXL_FILTER_H

#include "lib/lanes/fixed_point.h"
#include "lib/packets/instances.h"
#include "lib/surface/glass_faces.h"
#include "lib/surface/surface_color.h"
#include "lib/surface/texture_alpha.h"
#include "lib/traverse/surroundings.h"

/// Finds the body of cubes that the rays are inside of.
static inline void find_body(RayState* ray_state, global const float* restrict materials) {
    ray_state->body = body_inside(&ray_state->media);
    ray_state->joined = is_joined(ray_state->body, materials);
}

/// Density times t of the medium between t_first and t_last of the `open` lanes.
static inline lane_float medium_between(const PyramidView* p, const MediumView* medium,
                                        const Walk* w, lane_float t_first, lane_float t_last,
                                        lane_int open) {
    if (!VXL_MEDIUM_GRID) return LANES_SELECT(open, t_last - t_first, (lane_float)0.0f);
    Walk walk = begin_walk(w->ox, w->oy, w->oz, w->dx, w->dy, w->dz);
    return LANES_SELECT(open, walk_density(p, &medium->density, &walk, t_first, t_last, open),
                        (lane_float)0.0f);
}

/// The progress of shadow rays, and the light that surfaces and objects have let through so far.
typedef struct {
    lane_float throughput[3];  // of surfaces
    lane_float depth[3];       // optical depth of objects and of the medium between them
    lane_float t_last;         // where the last surface was
    lane_float t_out;          // where the ray leaves the world, in which all objects end
    lane_float metres;         // metres per unit of t
    lane_int layers;           // number of surfaces met
} Filter;

/// The filter of rays at their start.
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

#if VXL_FILTER

/// Adds the optical depth of the `ended` rays' way from the last surface to `t_now`: that of the
/// object `before`, the effective medium there, or of the medium of S.
static inline void add_depth(const WorldView* world, const Surroundings* around, const Walk* w,
                             lane_uint before, lane_float t_now, lane_int ended, Filter* filter) {
    const lane_uint record =
        material_offset(before) & LANES_AS_UINT(LANE_MASK(before != VXL_NO_MEDIUM));
    const lane_int absorbs = ended & LANE_MASK(before != VXL_NO_MEDIUM);
    const lane_float way =
        LANES_SELECT(absorbs, (t_now - filter->t_last) * filter->metres, (lane_float)0.0f);
    for (int channel = 0; channel < 3; ++channel)
        filter->depth[channel] =
            fma(LANES_GATHER_FLOAT(around->materials,
                                   record + (uint)(VXL_MATERIAL_ABSORPTION + channel)),
                way, filter->depth[channel]);
    const lane_int open = ended & ~absorbs;
    if (!VXL_MEDIUM || !lanes_any(open)) return;
    const MediumView* medium = &around->medium;
    const lane_float amount = medium_between(&world->pyramid, medium, w, filter->t_last,
                                             LANES_SELECT(open, t_now, filter->t_last), open) *
                              filter->metres;
    const float per_metre[3] = {medium->absorption.x, medium->absorption.y, medium->absorption.z};
    for (int channel = 0; channel < 3; ++channel)
        filter->depth[channel] =
            fma((lane_float)per_metre[channel], amount, filter->depth[channel]);
}

/// Mask: `passing` rays meet hidden faces between the glass of two bodies of cubes.
static inline lane_int passes_glass_face(const WorldView* world, const Surroundings* around,
                                         const Packet* f, lane_uint packed, lane_int passing) {
    const Walk* w = &f->walk;
    const lane_int exit = f->found.exit;
    // Rays that enter a body directly from another one have left that one at the same t.
    const lane_int follows = f->ray_state.goes_on & LANE_MASK(f->found.t == f->ray_state.t_first);
    const lane_int faces = passing & (exit | follows) & is_cube(packed, f->found.primitive) &
                           LANE_MASK(w->axis != 3) & is_joined(packed, around->materials);
    if (!lanes_any(faces)) return faces;
    FaceCell other = {w->x, w->y, w->z};  // for rays that leave, the cell behind the face
    const FaceCell before = neighbor_of(other, LANES_AS_UINT(w->axis), ~crossed_upwards(w));
    other.x = LANES_SELECT(exit, other.x, before.x);
    other.y = LANES_SELECT(exit, other.y, before.y);
    other.z = LANES_SELECT(exit, other.z, before.z);
    const lane_uint beyond =
        glass_in(&world->pyramid, &world->surface, other, around->materials, faces);
    return are_between_glass(&f->ray_state.media, packed, beyond, exit, around->ranks) &
           (~exit | bend_alike(packed, beyond, around->materials));
}

/// Moves the `passing` rays across a surface: updates their medium sets. Returns the mask of those
/// for which the surface is hidden: the same object is the effective medium before and behind it.
static inline lane_int cross_surface(const Surroundings* around, const SurfaceHit* found,
                                     lane_uint packed, lane_uint before, lane_float refraction,
                                     lane_int passing, lane_int* leaving, RayState* ray_state) {
    *leaving = medium_set_holds(&ray_state->media, packed);
    lane_int inner = (lane_int)0;
    if (VXL_CUBE_BODIES) {
        const lane_int cube = is_cube(packed, found->primitive);
        inner = cube & *leaving & ~found->exit;
        *leaving = LANES_SELECT(cube, found->exit, *leaving);
    }
    lane_int full;
    lane_int bodies = passing;
    if (VXL_TEXTURE_ALPHA)
        bodies &= have_bodies(around->materials, packed, found->primitive, passing);
    ray_state->media = cross_medium_or_overflow(ray_state->media, packed, *leaving, bodies, &full);
    if (VXL_MEDIUM_SET_CAPPED && lanes_any(full))
        atomic_add(around->medium_overflows, (uint)lanes_count(full));
    lane_int hidden =
        same_medium(before, effective_medium(&ray_state->media, around->ranks)) & bodies;
    if (VXL_CUBE_BODIES) {
        hidden |= found->exit & LANE_MASK(refraction == 0.0f);
        hidden = LANES_SELECT(inner, ~same_medium(before, packed), hidden);
        find_body(ray_state, around->materials);
    }
    return hidden;
}

/// Reduces the light of the `tinted` rays by the part that a surface with this opacity and
/// refraction absorbs.
static inline void tint_light(const Surroundings* around, const Walk* w, lane_float t,
                              lane_uint material, Colors colors, lane_float opacity,
                              lane_float refraction, lane_int tinted, Filter* filter) {
    global const float* materials = around->materials;
    const lane_uint color = color_offset(materials, material, fma(w->dx, t, w->ox),
                                         fma(w->dy, t, w->oy), fma(w->dz, t, w->oz));
    const lane_float clear = 1.0f - opacity;
    for (int channel = 0; channel < 3; ++channel) {
        lane_float part = clear;
        if (!VXL_GLOBAL)  // paths that go straight on aren't tinted
            part *= fma(opacity, surface_color(materials, color, colors, channel), clear);
        if (VXL_FILTERED) part = fma(opacity, refraction, part);
        filter->throughput[channel] *= LANES_SELECT(tinted, part, (lane_float)1.0f);
    }
}

/// Restarts the walks of rays in the mask `restarted`, which go on from the surfaces of instances.
static inline void leave_instances(const PyramidView* p, lane_int restarted, Packet* f,
                                   Filter* filter) {
    RayState* ray_state = &f->ray_state;
    const lane_float zero = (lane_float)0.0f;
    const lane_float t = LANES_SELECT(restarted, f->found.t, zero);
    restart_walks(p, &f->walk, t, restarted);
    f->t_end -= t;
    filter->t_out -= t;
    ray_state->goes_on &= ~restarted;
    ray_state->asks_side &= ~restarted;
    ray_state->t_first = LANES_SELECT(restarted, zero, ray_state->t_first);
}

/// Lets the `passing` rays continue from the surface that they have found, whose packed attributes
/// are `packed`.
static inline void go_on(const PyramidView* p, lane_uint packed, lane_int leaving, lane_int passing,
                         Packet* f, Filter* filter) {
    const SurfaceHit* found = &f->found;
    RayState* ray_state = &f->ray_state;
    Walk* w = &f->walk;
    ray_state->goes_on |= passing;
    ray_state->on_surface |= passing;
    const lane_uint source = source_of_hit(found->primitive, found->voxel, packed);
    ray_state->source = LANES_SELECT(passing, source, ray_state->source);
    ray_state->instance = LANES_SELECT(passing, found->instance, ray_state->instance);
    ray_state->within_source = LANES_SELECT(passing, ~leaving, ray_state->within_source);
    ray_state->t_first = LANES_SELECT(passing, found->t, ray_state->t_first);
    w->t = LANES_SELECT(passing, fmax(found->t, w->t), w->t);
    w->axis = LANES_SELECT(passing & ~found->exit, (lane_int)3, w->axis);
    if (VXL_INSTANCES)
        leave_instances(p, passing & LANE_MASK(found->instance != VXL_NO_INSTANCE), f, filter);
    filter->t_last = ray_state->t_first;
}

/// Filters the light of the `ended` rays on their way to the surface that those in `hit` have
/// found, or to their light. Lets the light continue through that surface, and returns the mask of
/// rays that do. The surface numbered VXL_MAX_LAYERS ends a ray.
static inline lane_int pass_surface(const WorldView* world, const Surroundings* around, Packet* f,
                                    lane_int ended, lane_int hit, Filter* filter) {
    const SurfaceHit* found = &f->found;
    RayState* ray_state = &f->ray_state;
    const Walk* w = &f->walk;
    global const float* materials = around->materials;
    // The way up to here, or to the light, or out of the world, lies inside the effective medium.
    const lane_uint before = effective_medium(&ray_state->media, around->ranks);
    const lane_float t_now = LANES_SELECT(hit, found->t, fmax(filter->t_out, filter->t_last));
    add_depth(world, around, w, before, t_now, ended, filter);
    if (!lanes_any(hit)) return hit;

    const lane_uint voxel = found->voxel & LANES_AS_UINT(hit);
    lane_uint packed = attributes_of_hit(&world->surface, voxel, found->primitive, hit);
    if (VXL_INSTANCES)
        packed = instance_attributes(&world->instances, found->instance, packed,
                                     hit & LANE_MASK(found->instance != VXL_NO_INSTANCE));
    const lane_uint material = material_offset(packed) & LANES_AS_UINT(hit);
    const Colors colors = colors_of_voxels(world->surface.colors, voxel);
    lane_float opacity = surface_opacity(materials, material, colors);
    if (VXL_TEXTURE_ALPHA) {
        const Vector o = {w->ox, w->oy, w->oz}, d = {w->dx, w->dy, w->dz};
        opacity *= alpha_of_hits(world, o, d, found->t, found->primitive, found->instance, hit);
    }
    const lane_float refraction = LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFRACTION);
    filter->layers -= hit;
    lane_int passing = hit & LANE_MASK(filter->layers < VXL_MAX_LAYERS);
    passing &= LANE_MASK(opacity < 1.0f) | LANE_MASK(refraction > 0.0f) | found->exit;
    lane_int leaving, hidden = (lane_int)0;
    if (VXL_CUBE_BODIES) hidden = passes_glass_face(world, around, f, packed, passing);
    hidden |=
        cross_surface(around, found, packed, before, refraction, passing, &leaving, ray_state);
    tint_light(around, w, found->t, material, colors, opacity, refraction, passing & ~hidden,
               filter);
    if (!VXL_FILTERED) passing &= hidden | LANE_MASK(1.0f - opacity > 0.0f);
    go_on(&world->pyramid, packed, leaving, passing, f, filter);
    return passing;
}

#else

/// No light passes through surfaces. So the kernel doesn't depend on what they are made of.
static inline lane_int pass_surface(const WorldView* world, const Surroundings* around, Packet* f,
                                    lane_int ended, lane_int hit, Filter* filter) {
    (void)world, (void)around, (void)f, (void)ended, (void)hit, (void)filter;
    return (lane_int)0;
}

#endif

#endif
