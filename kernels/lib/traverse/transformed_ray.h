// SPDX-License-Identifier: Apache-2.0
// Rays transformed into the space of an instance; see shared/instance.h.
//
// A ray is first moved to its point closest to the instance's centre: o - center + t d is rounded
// only there, and only once, however far away the ray began. From that point, distances to the
// centre and to the box are short.
#ifndef VXL_TRANSFORMED_RAY_H
#define VXL_TRANSFORMED_RAY_H

#include "lib/lanes/fixed_point.h"
#include "lib/lanes/vector.h"
#include "lib/traverse/world.h"
#include "shared/instance.h"
#include "shared/voxel.h"

/// A ray's segment in the box of an instance, in the instance's voxels: point + along * (t - base).
typedef struct {
    Vector point, along;
    lane_float base, from;  // the ray enters, or begins inside, at base + from
    lane_int axis;          // the axis across which it enters; 3: it begins inside
    lane_int met;           // mask: the ray passes through the box
} BoxPassage;

/// A ray of shared/trace.h in an instance's voxels. Its t corresponds to `base` + (`from` + t *
/// `scale`) in the world.
typedef struct {
    Vector origin, direction;
    lane_float base, from, scale;
} TransformedRay;

/// The 1 / d of a slab test, but finite.
static inline lane_float finite_inverse(lane_float d) {
    return clamp(exact_reciprocal(d), -1e30f, 1e30f);
}

static inline Vector object_vector(global const InstanceRecord* r, Vector v) {
    global const float* m = r->object_from_world;
    const Vector result = {fma(m[0], v.x, fma(m[1], v.y, m[2] * v.z)),
                           fma(m[3], v.x, fma(m[4], v.y, m[5] * v.z)),
                           fma(m[6], v.x, fma(m[7], v.y, m[8] * v.z))};
    return result;
}

/// Maps a point at `v` from the instance's centre to the object's voxels.
static inline Vector object_point(global const InstanceRecord* r, Vector v) {
    global const float* m = r->object_from_world;
    const Vector result = {fma(m[0], v.x, fma(m[1], v.y, fma(m[2], v.z, r->image[0]))),
                           fma(m[3], v.x, fma(m[4], v.y, fma(m[5], v.z, r->image[1]))),
                           fma(m[6], v.x, fma(m[7], v.y, fma(m[8], v.z, r->image[2])))};
    return result;
}

/// The t at which a ray enters and leaves the space between two planes of one axis.
static inline void between_planes(lane_float o, lane_float d, float low, float high,
                                  lane_float* enter, lane_float* leave) {
    const lane_float inverse = finite_inverse(d);
    const lane_float a = (low - o) * inverse, b = (high - o) * inverse;
    *enter = fmin(a, b);
    *leave = fmax(a, b);
}

/// A coordinate of a ray where it enters the box, or begins: exactly the side that it crosses.
static inline lane_float coordinate_in_box(lane_float o, lane_float d, lane_float t, lane_int side,
                                           float low, float high, float fixed_point) {
    const lane_float plane = LANES_SELECT(LANE_MASK(d >= 0.0f), (lane_float)low, (lane_float)high);
    const lane_float at = clamp(fma(d, t, o), low, high);
    return snap_position(LANES_SELECT(side, plane, at), (lane_float)0.0f, fixed_point);
}

/// The passage of the world's ray o + d t, from t_first on, through an instance's box.
/// `inverse_squared` is 1 / (d d).
static inline BoxPassage pass_box(global const InstanceRecord* r, Vector o, Vector d,
                                  lane_float inverse_squared, lane_float t_first) {
    BoxPassage b;
    const Vector v = {o.x - r->center[0], o.y - r->center[1], o.z - r->center[2]};
    const lane_int near = LANE_MASK(dot_product(v, v) <= r->near_squared);
    const lane_float closest = fmax(-dot_product(v, d) * inverse_squared, 0.0f);
    const lane_float zero = (lane_float)0.0f;
    b.base = r->aligned ? zero : LANES_SELECT(near, zero, closest);
    const Vector at_base = {fma(d.x, b.base, v.x), fma(d.y, b.base, v.y), fma(d.z, b.base, v.z)};
    b.point = object_point(r, at_base);
    b.along = object_vector(r, d);
    Vector enter, leave;
    between_planes(b.point.x, b.along.x, r->low[0], r->high[0], &enter.x, &leave.x);
    between_planes(b.point.y, b.along.y, r->low[1], r->high[1], &enter.y, &leave.y);
    between_planes(b.point.z, b.along.z, r->low[2], r->high[2], &enter.z, &leave.z);
    const lane_float in = fmax(enter.x, fmax(enter.y, enter.z));
    const lane_float out = fmin(leave.x, fmin(leave.y, leave.z));
    const lane_float minimum = t_first - b.base;
    b.from = fmax(in, minimum);
    b.met = LANE_MASK(b.from <= out);
    const lane_int enters = LANE_MASK(in >= minimum);
    const lane_int z = LANE_MASK(enter.z == in), y = LANE_MASK(enter.y == in) & ~z;
    b.axis = LANES_SELECT(enters, (y & 1) | (z & 2), (lane_int)3);
    return b;
}

/// The ray in the instance's space, from where it enters the box or begins inside it.
///
/// Where the map is `aligned`, the ray's numbers are the world's except for their axes and signs.
/// Its origin may then lie outside the box, and the walk moves it in.
static inline TransformedRay transform_ray(global const InstanceRecord* r, const BoxPassage* b) {
    TransformedRay c;
    c.base = b->base;
    if (r->aligned) {
        c.origin = b->point, c.direction = b->along;
        c.from = (lane_float)0.0f;
        c.scale = (lane_float)1.0f;
        return c;
    }
    c.from = b->from;
    const Vector p = b->point, e = b->along;
    const float one = r->fixed_point;
    c.origin.x =
        coordinate_in_box(p.x, e.x, c.from, LANE_MASK(b->axis == 0), r->low[0], r->high[0], one);
    c.origin.y =
        coordinate_in_box(p.y, e.y, c.from, LANE_MASK(b->axis == 1), r->low[1], r->high[1], one);
    c.origin.z =
        coordinate_in_box(p.z, e.z, c.from, LANE_MASK(b->axis == 2), r->low[2], r->high[2], one);
    c.scale = power_of_two_scale(e.x, e.y, e.z);
    c.direction.x = snap_direction(e.x * c.scale);
    c.direction.y = snap_direction(e.y * c.scale);
    c.direction.z = snap_direction(e.z * c.scale);
    return c;
}

/// Converts a transformed ray's t to the world's t.
static inline lane_float world_t(const TransformedRay* c, lane_float t) {
    return c->base + fma(t, c->scale, c->from);
}

/// Converts the world's t to the transformed ray's t.
static inline lane_float transformed_t(const TransformedRay* c, lane_float t) {
    return exact_divide((t - c->base) - c->from, c->scale);
}

/// The packed attributes, as the scene numbers them, of hits on instances, whose own packed
/// attributes hold numbers of groups. Other lanes keep theirs.
static inline lane_uint instance_attributes(const InstanceView* v, lane_uint instance,
                                            lane_uint packed, lane_int of_instance) {
    const lane_uint record =
        (instance & LANES_AS_UINT(of_instance)) * (lane_uint)VXL_INSTANCE_WORDS;
    global const uint* words = (global const uint*)v->records;
    const lane_uint object = LANES_GATHER_UINT(words, record + (uint)VXL_INSTANCE_OBJECT);
    const lane_uint first = LANES_GATHER_UINT(words, record + (uint)VXL_INSTANCE_MATERIALS);
    const lane_uint count = LANES_GATHER_UINT(words, record + (uint)VXL_INSTANCE_GROUPS);
    const lane_uint group = min((packed >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK, count - 1u);
    const lane_uint material = LANES_GATHER_UINT(v->group_materials, first + group);
    const lane_uint kind = packed & ~(VXL_MATERIAL_MASK << VXL_MATERIAL_SHIFT | VXL_OBJECT_MASK);
    return LANES_SELECT(of_instance, kind | (material << VXL_MATERIAL_SHIFT) | object, packed);
}

#endif
