// SPDX-License-Identifier: Apache-2.0
// The reflection and refraction of rays at the surfaces that they meet: weights and directions.
#ifndef VXL_SCATTER_POINT_H
#define VXL_SCATTER_POINT_H

#include "lib/light/optics.h"
#include "lib/light/paths.h"
#include "lib/surface/shading_normal.h"
#include "lib/surface/surface_color.h"
#include "lib/traverse/hit_attributes.h"
#include "lib/traverse/ray_batch.h"

/// The rays of one kind, reflected or refracted, that leave a packet of surface points.
typedef struct {
    lane_float returned;  // the share of their light that the surface returns
    lane_int wanted;
} Scattered;

/// A packet of surface points. Directions are in metric space: `way` is along the ray, and the
/// normal points against it.
typedef struct {
    lane_int valid;         // mask: entries of the batch
    lane_int hit, leaving;  // masks: the surface is met; it is met from inside its object
    lane_uint packed, material, primitive;
    lane_uint beyond;  // the glass behind the face of other glass, as in VXL_SIDE_BEYOND_SHIFT
    lane_uint source;  // of the rays that leave the point
    Vector position, normal, way;
    Vector shading;     // the normal for reflection and refraction
    lane_int curved;    // mask: `shading` differs from the surface's normal
    lane_float cosine;  // of the angle of incidence with `shading`
    lane_float mirror;  // the share of light that is reflected, where maps change it
    lane_float eta;     // index of refraction before the surface over the one behind it
    Refraction bend;
    MediumSet before, behind;  // the objects that the ray is inside of
} ScatterPoint;

/// The points of the entries from `first` on that are below `end`. `eta` and `bend` are set for
/// equal media.
static inline ScatterPoint load_point(const RayBatch* batch, float4 edge, uint first, uint end) {
    const uint stride = batch->stride;
    ScatterPoint p;
    p.valid = below(first, end);
    const lane_uint number = LANES_LOAD(batch->hits, VXL_HIT_VOXEL * stride + first);
    const lane_uint side = LANES_LOAD(batch->sides, first);
    p.hit = LANE_MASK(number != VXL_NO_VOXEL) & p.valid & LANE_MASK((side & VXL_SIDE_HIDDEN) == 0u);
    p.leaving = LANE_MASK((side & VXL_SIDE_LEAVING) != 0u);
    p.beyond = VXL_CUBE_BODIES ? side >> VXL_SIDE_BEYOND_SHIFT : (lane_uint)0;
    p.packed = LANES_LOAD(batch->hit_attributes, first);
    p.material = material_offset(p.packed) & LANES_AS_UINT(p.hit);
    p.primitive = (lane_uint)VXL_NO_PRIMITIVE;
    if (VXL_EXACT) p.primitive = LANES_LOAD(batch->hits, VXL_HIT_PRIMITIVE * stride + first);
    p.source = source_of_hits(batch->hits, stride, first, p.packed);
    p.way = unit(scaled(load_vector(batch->rays + VXL_RAY_DX * stride, stride, first), edge));
    p.normal = load_vector(batch->normals, stride, first);
    p.position = load_vector(batch->positions, stride, first);
    p.shading = p.normal;
    p.curved = (lane_int)0;
    if (VXL_SHADING_NORMALS) {
        const Vector shading = load_vector(batch->shading, stride, first);
        p.curved = are_different(shading, p.normal);
        p.shading = select_vector(p.curved, reflecting_normal(p.way, p.normal, shading), p.normal);
    }
    p.cosine = clamp(-dot_product(p.way, p.shading), 0.0f, 1.0f);
    p.mirror = (lane_float)0.0f;
    if (!VXL_GLOBAL && VXL_TEXTURE_MAPS)
        p.mirror = LANES_GATHER_FLOAT(
            batch->paint, colors_of_hits(0, number, 0, first).number + VXL_PAINT_REFLECTION);
    p.eta = (lane_float)1.0f;
    const Refraction straight = {(lane_int)0, p.cosine, (lane_float)0.0f, (lane_float)1.0f};
    p.bend = straight;
    p.before = empty_medium_set();
    if (VXL_TRANSMISSION) p.before = load_medium_set(batch->paths, stride, first, p.valid);
    p.behind = p.before;
    return p;
}

/// Finds the objects behind the surfaces. A ray that leaves a transmitting object that its set
/// doesn't hold began inside that object. Returns the mask of surfaces of transmitting objects.
static inline lane_int cross_objects(const Surroundings* around, ScatterPoint* p) {
    global const float* materials = around->materials;
    const lane_int open =
        p->hit & transmits(materials, p->material,
                           LANES_GATHER_FLOAT(materials, p->material + VXL_MATERIAL_OPACITY));
    const lane_int began = open & p->leaving & ~medium_set_holds(&p->before, p->packed);
    p->before = cross_counted(p->before, p->packed, (lane_int)0, began, around->medium_overflows);
    p->behind = cross_counted(p->before, p->packed, p->leaving, open, around->medium_overflows);
    return open;
}

/// Refracts between the media before and behind the surfaces; surfaces that aren't `open` refract
/// as if they were filled with their material. Divides the light between reflection and refraction
/// by Fresnel's law where the material asks for it.
static inline void refract_light(const Surroundings* around, ScatterPoint* p, lane_int open,
                                 Scattered* reflected, Scattered* refracted) {
    global const float* materials = around->materials;
    const lane_uint from = medium_inside(&p->before, around->ranks);
    lane_uint to = medium_inside(&p->behind, around->ranks);
    to = LANES_SELECT(open, to, ((p->packed >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK) + 1u);
    if (VXL_CUBE_BODIES) to = LANES_SELECT(p->leaving & LANE_MASK(p->beyond != 0u), p->beyond, to);
    p->eta = exact_divide(medium_ior(materials, from),
                          medium_ior(materials, to & LANES_AS_UINT(p->hit)));
    p->bend = refraction_at(p->eta, p->cosine);
    const Refraction bend = p->bend;
    const lane_int fresnel =
        LANE_MASK(LANES_GATHER_FLOAT(materials, p->material + VXL_MATERIAL_FRESNEL) != 0.0f);
    const lane_int total = bend.total & LANE_MASK(refracted->returned > 0.0f);
    const lane_float all = reflected->returned + refracted->returned;
    reflected->returned = LANES_SELECT(fresnel, reflected->returned * bend.reflected,
                                       LANES_SELECT(total, all, reflected->returned));
    refracted->returned = LANES_SELECT(
        bend.total, (lane_float)0.0f,
        LANES_SELECT(fresnel, refracted->returned * bend.refracted, refracted->returned));
}

/// Finds the shares of light that a packet's points reflect and refract.
static inline void scatter_light(const Surroundings* around, ScatterPoint* p, Scattered* reflected,
                                 Scattered* refracted) {
    global const float* materials = around->materials;
    const lane_float zero = (lane_float)0.0f;
    lane_float mirror = p->mirror;
    if (!VXL_TEXTURE_MAPS || VXL_GLOBAL)
        mirror = LANES_GATHER_FLOAT(materials, p->material + VXL_MATERIAL_REFLECTION);
    reflected->returned = LANES_SELECT(p->hit, mirror, zero);
    refracted->returned = zero;
    lane_int open = (lane_int)0;
    if (VXL_TRANSMISSION) {
        refracted->returned = LANES_SELECT(
            p->hit, LANES_GATHER_FLOAT(materials, p->material + VXL_MATERIAL_REFRACTION), zero);
        open = cross_objects(around, p);
    }
    if (VXL_REFRACTS) refract_light(around, p, open, reflected, refracted);
}

static inline Vector mirrored_direction(const ScatterPoint* p) {
    const lane_float twice = 2.0f * p->cosine;
    const Vector v = p->way, n = p->shading;
    const Vector mirrored = {fma(twice, n.x, v.x), fma(twice, n.y, v.y), fma(twice, n.z, v.z)};
    if (!VXL_SHADING_NORMALS) return mirrored;
    const lane_float above = fmax(-dot_product(v, p->normal), 0.0f);
    const Vector kept = keep_on_side(mirrored, p->normal, fmin(0.9f * above, 0.005f));
    return select_vector(p->curved, kept, mirrored);
}

/// The directions of the refracted rays. `into` points into the surface.
static inline Vector bent_direction(const ScatterPoint* p, Vector into) {
    const Vector bent = refracted_direction(p->way, p->shading, p->eta, p->cosine, &p->bend);
    if (!VXL_SHADING_NORMALS) return bent;
    const Vector kept = keep_on_side(bent, into, fmin(0.9f * p->bend.cosine, 0.005f));
    return select_vector(p->curved, kept, bent);
}

#endif
