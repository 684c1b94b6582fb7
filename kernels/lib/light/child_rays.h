// SPDX-License-Identifier: Apache-2.0
// The rays that leave surface points: where they begin, and in which state.
#ifndef VXL_CHILD_RAYS_H
#define VXL_CHILD_RAYS_H

#include "lib/lanes/fixed_point.h"
#include "lib/light/scatter_point.h"
#include "lib/surface/texture_alpha.h"
#include "lib/traverse/offset_origin.h"
#include "lib/traverse/ray_queue.h"

/// Sets out a ray from a surface point along `direction` in metric space. Its origin is rounded
/// towards `side`, which points to the side of the surface on which it begins.
static inline void set_out_child(NewRays* r, PyramidShape shape, Vector position, Vector side,
                                 Vector direction) {
    const lane_float x = direction.x * shape.inverse_edge.x;
    const lane_float y = direction.y * shape.inverse_edge.y;
    const lane_float z = direction.z * shape.inverse_edge.z;
    const lane_float scale = power_of_two_scale(x, y, z);
    r->direction.x = snap_direction(x * scale);
    r->direction.y = snap_direction(y * scale);
    r->direction.z = snap_direction(z * scale);
    const float one = shape.fixed_point;
    r->origin.x = clamp(snap_position(position.x, side.x, one), 0.0f, (float)shape.size_x);
    r->origin.y = clamp(snap_position(position.y, side.y, one), 0.0f, (float)shape.size_y);
    r->origin.z = clamp(snap_position(position.z, side.z, one), 0.0f, (float)shape.size_z);
    r->t_end = (lane_float)INFINITY;
}

/// Mask: hits on surfaces of objects with a body, which rays that go straight on from there enter
/// or leave.
static inline lane_int bodies_of(const Surroundings* around, const RayBatch* batch, uint first,
                                 lane_uint packed, lane_int hit) {
    if (!VXL_TEXTURE_ALPHA) return (lane_int)-1;
    const lane_uint primitive = LANES_LOAD(batch->hits, VXL_HIT_PRIMITIVE * batch->stride + first);
    return have_bodies(around->materials, packed, primitive, hit);
}

/// The widths of rays at the surfaces that they met, in metres.
static inline lane_float width_at(const RayBatch* batch, uint first) {
    if (!VXL_WIDENS) return (lane_float)0.0f;
    const lane_uint hit = first + LANES_AS_UINT((lane_int)LANES_NUMBERS);
    return LANES_GATHER_FLOAT(batch->paint,
                              hit * VXL_PAINT_FLOATS(VXL_TEXTURE_MAPS) + VXL_PAINT_WIDTH);
}

/// The widths of rays that go straight on at their origins. Those in the mask `restarted` begin at
/// their surfaces. Rays from an observer keep counting as such.
static inline lane_float width_straight(const RayBatch* batch, uint first, lane_int restarted) {
    if (!VXL_WIDENS) return (lane_float)0.0f;
    const lane_float before =
        LANES_AS_FLOAT(LANES_LOAD(batch->paths, VXL_PATH_WIDTH * batch->stride + first));
    return LANES_SELECT(restarted & LANE_MASK(before > 0.0f), width_at(batch, first), before);
}

/// What all rays that leave the points have in common. Each begins its own node.
static inline NewRays begin_node(const ScatterPoint* p, const RayBatch* batch, uint first) {
    const lane_float one = (lane_float)1.0f;
    NewRays r;
    r.source = p->source;
    if (VXL_INSTANCES)
        r.instance = LANES_LOAD(batch->hits, VXL_HIT_INSTANCE * batch->stride + first);
    r.width = width_at(batch, first);
    r.clear = r.throughput[0] = r.throughput[1] = r.throughput[2] = one;
    r.start = (lane_float)0.0f;
    r.cell_xy = r.cell_z = (lane_uint)0;
    return r;
}

/// Mask: entries whose surfaces belong to instances.
static inline lane_int are_of_instances(const RayBatch* batch, uint first) {
    if (!VXL_INSTANCES) return (lane_int)0;
    return LANE_MASK(LANES_LOAD(batch->hits, VXL_HIT_INSTANCE * batch->stride + first) !=
                     VXL_NO_INSTANCE);
}

/// Makes rays that go straight on and are in the mask `restarted` begin behind their surface. From
/// a surface of the world, a ray begins again at its old origin and skips what it has already met.
/// From a surface of an instance this is impossible, because the cell of the world in which it
/// would continue is unknown.
static inline void begin_behind(PyramidShape shape, const RayBatch* batch, uint first,
                                lane_int restarted, NewRays* r) {
    if (!VXL_INSTANCES) return;
    global const uint* hits = batch->hits;
    const uint stride = batch->stride;
    const lane_float t = LANES_SELECT(
        restarted, LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first)), (lane_float)0.0f);
    Vector into = {(lane_float)0.0f, (lane_float)0.0f, (lane_float)0.0f};
    if (VXL_NORMALS) into = opposite(load_vector(batch->normals, stride, first));
    const Vector at =
        offset_origin(shape, add_scaled(r->origin, r->direction, t), into, hits, stride, first);
    const float one = shape.fixed_point;
    const Vector begin = {clamp(snap_position(at.x, into.x, one), 0.0f, (float)shape.size_x),
                          clamp(snap_position(at.y, into.y, one), 0.0f, (float)shape.size_y),
                          clamp(snap_position(at.z, into.z, one), 0.0f, (float)shape.size_z)};
    r->origin = select_vector(restarted, begin, r->origin);
    r->t_end = LANES_SELECT(restarted, r->t_end - t, r->t_end);
    r->start = LANES_SELECT(restarted, (lane_float)0.0f, r->start);
    r->flags &= ~(LANES_AS_UINT(restarted) & (VXL_PATH_GOES_ON | VXL_PATH_FROM_CELL));
}

/// Sets what all rays have in common that stay on the side from which the surfaces were met.
static inline void stay_on_side(const Surroundings* around, const ScatterPoint* p,
                                const RayBatch* batch, uint first, NewRays* r) {
    const uint stride = batch->stride;
    r->flags = LANES_SELECT(p->leaving, (lane_uint)VXL_PATH_WITHIN_SOURCE, (lane_uint)0) |
               VXL_PATH_ON_SURFACE;
    r->media = p->before;
    r->medium = (lane_uint)0;
    if (VXL_TRANSMISSION) r->medium = medium_inside(&p->before, around->ranks);
    if (!VXL_CUBE_BODIES) return;
    // Rays that stay inside a cube begin in a known cell.
    const lane_int cube = is_cube(p->packed, p->primitive);
    r->flags |= joined_flag(&p->before, around->materials) |
                (LANES_AS_UINT(cube & p->leaving) & VXL_PATH_FROM_CELL);
    r->cell_xy = LANES_LOAD(batch->hits, VXL_HIT_CELL * stride + first);
    r->cell_z = LANES_LOAD(batch->hits, VXL_HIT_FACE * stride + first) & 0xFFFFu;
}

/// Turns `r` into the rays that the surfaces reflect.
static inline void reflect_rays(PyramidShape shape, const Surroundings* around,
                                const ScatterPoint* p, const RayBatch* batch, uint first,
                                NewRays* r) {
    stay_on_side(around, p, batch, first, r);
    const Vector n = p->normal;
    set_out_child(r, shape, offset_origin(shape, p->position, n, batch->hits, batch->stride, first),
                  n, mirrored_direction(p));
}

/// Turns `r` into the rays that the surfaces refract. Between equal media the ray continues from
/// its old origin. Like every refracted ray it has no end, even if the ray that met the surface has
/// one: rays aimed at the voxels of a display end shortly behind them.
static inline void refract_rays(PyramidShape shape, const Surroundings* around,
                                const ScatterPoint* p, const RayBatch* batch, uint first,
                                NewRays* r) {
    global const uint* hits = batch->hits;
    const uint stride = batch->stride;
    r->flags = LANES_SELECT(p->leaving, (lane_uint)0, (lane_uint)VXL_PATH_WITHIN_SOURCE) |
               (VXL_PATH_ON_SURFACE | VXL_PATH_REFRACTED);
    r->media = p->behind;
    r->medium = medium_inside(&p->behind, around->ranks);
    const Vector into = opposite(p->normal);
    const Vector bent = bent_direction(p, into);
    set_out_child(r, shape, offset_origin(shape, p->position, into, hits, stride, first), into,
                  bent);
    const lane_int same = LANE_MASK(p->eta == 1.0f) & ~are_of_instances(batch, first);
    const Vector o = load_vector(batch->rays, stride, first);
    const Vector d = load_vector(batch->rays + VXL_RAY_DX * stride, stride, first);
    const lane_float t = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    r->origin = select_vector(same, o, r->origin);
    r->direction = select_vector(same, d, r->direction);
    r->start = LANES_SELECT(same, t, (lane_float)0.0f);
    r->flags |= LANES_AS_UINT(same) & VXL_PATH_GOES_ON;
    r->width = LANES_SELECT(same, width_straight(batch, first, (lane_int)0), r->width);
    if (VXL_CUBE_BODIES)
        r->flags |= joined_flag(&p->behind, around->materials) |
                    (LANES_AS_UINT(is_cube(p->packed, p->primitive)) & VXL_PATH_FROM_CELL);
    r->cell_xy = LANES_LOAD(hits, VXL_HIT_CELL * stride + first);
    r->cell_z = LANES_LOAD(hits, VXL_HIT_FACE * stride + first);
}

#endif
