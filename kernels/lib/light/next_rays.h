// SPDX-License-Identifier: Apache-2.0
// The rays with which light paths continue: their directions, and the objects that they are inside
// of.
#ifndef VXL_NEXT_RAYS_H
#define VXL_NEXT_RAYS_H

#include "lib/light/child_rays.h"
#include "lib/light/lobes.h"
#include "lib/sampling/directions.h"

/// The minimum cosine with a surface of a direction into which it scatters light.
static inline lane_float min_cosine(const ScatterPoint* p) {
    const lane_float zero = (lane_float)0.0f;
    if (!VXL_SHADING_NORMALS) return zero;
    return LANES_SELECT(p->curved, (lane_float)VXL_MIN_COSINE, zero);
}

/// The cosines of directions with surfaces' shading normals. Sets `above` to the mask of those
/// above.
static inline lane_float cosine_at(const ScatterPoint* p, const RayBatch* batch, uint first,
                                   Vector direction, lane_int* above) {
    Vector normal = p->normal;
    if (VXL_SHADING_NORMALS) normal = load_vector(batch->shading, batch->stride, first);
    const lane_float cosine = dot_product(normal, direction);
    *above =
        LANE_MASK(cosine > 0.0f) & LANE_MASK(dot_product(p->normal, direction) > min_cosine(p));
    return fmax(cosine, 0.0f);
}

/// The directions into which surfaces scatter light.
typedef struct {
    Vector ahead;    // a unit vector
    lane_int moved;  // mask: moved up to the minimum cosine
    // Only for physically based surfaces:
    lane_int is, lives;    // masks: physically based surface; direction above it or through it
    lane_int through;      // mask: direction through the surface
    lane_float density;    // of the direction, per solid angle
    lane_float weight[3];  // light from there over the mean of all directions
} ScatteredWay;

/// A way that leads nowhere: rays along the normals.
static inline ScatteredWay no_scattered_way(const ScatterPoint* p) {
    ScatteredWay s;
    s.ahead = p->normal;
    s.moved = s.is = s.lives = s.through = (lane_int)0;
    s.density = (lane_float)0.0f;
    for (int c = 0; c < 3; ++c) s.weight[c] = (lane_float)1.0f;
    return s;
}

/// Replaces ways from physically based surfaces by directions into which these scatter light.
/// `layer` chooses the part of the surface.
static inline void scatter_physically(const PhysicalView* view, Vector normal, SquarePoint at,
                                      lane_float layer, ScatteredWay* s) {
    lane_float value[3];
    lane_int down;
    const Vector ahead = physical_direction(view, at, layer, &down);
    s->is = view->is;
    s->lives = physical_value(view, ahead, value, &s->density);
    if (VXL_ROUGH_GLASS) {
        lane_float beyond[3], density;
        s->through = down & physical_through(view, ahead, beyond, &density) &
                     LANE_MASK(dot_product(ahead, normal) < 0.0f);
        s->lives = (s->lives & ~down) | s->through;
        s->density = LANES_SELECT(s->through, density, s->density);
        for (int c = 0; c < 3; ++c) value[c] = LANES_SELECT(s->through, beyond[c], value[c]);
    }
    s->lives &= LANE_MASK(s->density > 0.0f);
    s->ahead = select_vector(s->is, ahead, s->ahead);
    for (int c = 0; c < 3; ++c) {
        const lane_float even = 3.14159265f * s->density * view->albedo[c];
        const lane_int some = s->lives & LANE_MASK(even > 0.0f);
        const lane_float weight =
            exact_divide(value[c], LANES_SELECT(some, even, (lane_float)1.0f));
        s->weight[c] = LANES_SELECT(some, weight, (lane_float)0.0f);
    }
}

/// The directions in which surfaces scatter light, chosen by a point of the unit square.
static inline ScatteredWay scatter_by(const ScatterPoint* p, const RayBatch* batch, uint first,
                                      const PhysicalView* view, SquarePoint at, lane_float layer) {
    ScatteredWay s = no_scattered_way(p);
    Vector normal = p->normal;
    if (VXL_SHADING_NORMALS) normal = load_vector(batch->shading, batch->stride, first);
    s.ahead = cosine_direction(normal, at);
    if (VXL_PHYSICAL && lanes_any(view->is)) scatter_physically(view, p->normal, at, layer, &s);
    if (VXL_SHADING_NORMALS) {
        const lane_float lowest = min_cosine(p);
        s.moved = p->curved & ~s.through & LANE_MASK(dot_product(s.ahead, p->normal) < lowest);
        s.ahead = select_vector(s.moved, keep_on_side(s.ahead, p->normal, lowest), s.ahead);
    }
    return s;
}

/// VXL_PATH_EMITTER of rays that surfaces have scattered. It is 0 for `moved` rays, which all lie
/// on one cone that no ray to an emitter can lie on.
static inline lane_uint density_of(const ScatterPoint* p, const RayBatch* batch, uint first,
                                   const Choice* way, const ScatteredWay* scattered,
                                   const NewRays* r, float4 edge) {
    lane_int above;
    const Vector direction = unit(scaled(r->direction, edge));
    lane_float density = cosine_at(p, batch, first, direction, &above) * 0.318309886f * way->chance;
    if (VXL_PHYSICAL)
        density = LANES_SELECT(scattered->is, scattered->density * way->chance, density);
    return LANES_SELECT(way->diffuse & ~scattered->moved, LANES_AS_UINT(density), (lane_uint)0);
}

/// VXL_PATH_DENSITY of rays that surfaces have scattered. It is 0 for directions that no ray to a
/// light can have, since these are tested against the shading normal.
static inline lane_float shared_density(const RayBatch* batch, uint first, const Choice* way,
                                        const ScatteredWay* scattered) {
    lane_int shared = way->diffuse & scattered->is & ~scattered->moved & shares_light(batch, first);
    if (VXL_SHADING_NORMALS) {
        const Vector normal = load_vector(batch->shading, batch->stride, first);
        shared &= LANE_MASK(dot_product(normal, scattered->ahead) > 0.0f);
    }
    return LANES_SELECT(shared, scattered->density, (lane_float)0.0f);
}

/// Sets the directions and sides of the rays that leave surfaces: scattered directions, mirrored
/// ones, and those that glass refracts.
static inline void set_out_ways(PyramidShape shape, const ScatterPoint* p, const RayBatch* batch,
                                uint first, const Choice* way, const ScatteredWay* scattered,
                                NewRays* r) {
    Vector side = p->normal;
    Vector ahead = select_vector(way->diffuse, scattered->ahead, mirrored_direction(p));
    if (VXL_REFRACTS) {
        const Vector into = opposite(p->normal);
        ahead = select_vector(way->refracted, bent_direction(p, into), ahead);
        side = select_vector(way->refracted, into, side);
        if (VXL_ROUGH_GLASS) ahead = select_vector(scattered->through, scattered->ahead, ahead);
    }
    set_out_child(r, shape,
                  offset_origin(shape, p->position, side, batch->hits, batch->stride, first), side,
                  ahead);
    if (VXL_LOOKS) r->emitter = density_of(p, batch, first, way, scattered, r, shape.edge);
    if (VXL_AREA_SHARES) r->density = shared_density(batch, first, way, scattered);
}

/// Completes rays in scenes with transmitting objects: sets the objects that they are inside of,
/// and lets unbent ones continue along the ray that met the surface. Rough glass has `bent` some.
static inline void enter_media(PyramidShape shape, const Surroundings* around,
                               const ScatterPoint* p, const RayBatch* batch, uint first,
                               const Choice* way, lane_int bent, NewRays* r) {
    global const uint* hits = batch->hits;
    const uint stride = batch->stride;
    const lane_int across = way->refracted | way->straight;
    const lane_int of_instance = are_of_instances(batch, first);
    const lane_int same =
        way->straight | (way->refracted & LANE_MASK(p->eta == 1.0f) & ~(of_instance | bent));
    MediumSet passed = load_medium_set(batch->paths, stride, first, p->valid);
    const lane_int bodies = way->straight & bodies_of(around, batch, first, p->packed, p->hit);
    passed = cross_counted(passed, p->packed, p->leaving, bodies, around->medium_overflows);
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i) {
        lane_uint member = LANES_SELECT(way->refracted, p->behind.members[i], p->before.members[i]);
        r->media.members[i] = LANES_SELECT(way->straight, passed.members[i], member);
    }
    r->medium = medium_inside(&r->media, around->ranks);
    r->flags |= LANES_AS_UINT(same) & VXL_PATH_GOES_ON;
    r->origin = select_vector(same, load_vector(batch->rays, stride, first), r->origin);
    r->direction = select_vector(
        same, load_vector(batch->rays + VXL_RAY_DX * stride, stride, first), r->direction);
    r->t_end = LANES_SELECT(way->straight, LANES_LOAD(batch->rays, VXL_RAY_END * stride + first),
                            r->t_end);
    r->start = LANES_SELECT(same, LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first)),
                            (lane_float)0.0f);
    r->cell_xy = LANES_LOAD(hits, VXL_HIT_CELL * stride + first);
    const lane_uint face = LANES_LOAD(hits, VXL_HIT_FACE * stride + first);
    r->cell_z = LANES_SELECT(across, face, face & 0xFFFFu);
    begin_behind(shape, batch, first, way->straight & of_instance, r);
    r->width = LANES_SELECT(same, width_straight(batch, first, of_instance), r->width);
    if (VXL_TRAVELS) {
        const lane_float before = path_float(batch->paths, VXL_PATH_TRAVELLED, stride, first);
        const lane_float t = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
        const lane_float now = LANES_SELECT(of_instance, before + t, before);
        r->travelled = LANES_SELECT(way->straight, now, (lane_float)0.0f);
    }
    if (!VXL_CUBE_BODIES) return;
    const lane_int in_cell = way->refracted | (p->leaving & ~across);
    r->flags |= joined_flag(&r->media, around->materials) |
                (LANES_AS_UINT(is_cube(p->packed, p->primitive) & in_cell) & VXL_PATH_FROM_CELL);
}

/// The rays that go on along the chosen ways.
static inline NewRays next_rays_of(PyramidShape shape, const Surroundings* around,
                                   const ScatterPoint* p, const RayBatch* batch, uint first,
                                   const Choice* way, const ScatteredWay* scattered) {
    NewRays r = begin_node(p, batch, first);
    const lane_int within = p->leaving ^ (way->refracted | way->straight);
    r.flags = VXL_PATH_ON_SURFACE | (LANES_AS_UINT(within) & VXL_PATH_WITHIN_SOURCE) |
              (LANES_AS_UINT(way->refracted) & VXL_PATH_REFRACTED);
    r.medium = (lane_uint)0;
    set_out_ways(shape, p, batch, first, way, scattered, &r);
    if (VXL_TRANSMISSION) enter_media(shape, around, p, batch, first, way, scattered->through, &r);
    for (int c = 0; c < 3; ++c) {
        r.throughput[c] = way->throughput[c];
        if (VXL_PHYSICAL)
            r.throughput[c] *= LANES_SELECT((way->diffuse & scattered->is) | scattered->through,
                                            scattered->weight[c], (lane_float)1.0f);
    }
    return r;
}

#endif
