// SPDX-License-Identifier: Apache-2.0
// Beams: how far groups of 16 neighbouring rays run together through empty space.
//
// A beam is the straight line in the middle of its rays, along the axis that they mostly follow: at
// every coordinate s of that axis, it is less than 4 voxels from each of them. So the rays' leaves
// are empty as long as the beam's own leaf and all leaves around it are, which one leaf of the
// dilated occupancy (runtime/stages/trace/beam.hpp) tells. A dilated occupancy of bricks has voxels
// four times as long, and the beams' coordinates there are scaled by `scale` = 1/4. The slack of a
// quarter voxel covers two errors: the step of 1/64 beyond the planes at which the line is
// evaluated, and all rounding, since positions are sums of numbers up to 16 times the world's
// length (VXL_BEAM_MIN_DIRECTION), and six roundings of these are 0.1 voxel for 16384 voxels.
#ifndef VXL_BEAM_H
#define VXL_BEAM_H

#include "lib/lanes/exact_float.h"
#include "lib/traverse/pyramid.h"
#include "shared/beam.h"
#include "shared/trace.h"

#define VXL_BEAM_STEP 0.015625f
// A ray whose direction along the axis is smaller than this has no useful position at s.
#define VXL_BEAM_MIN_DIRECTION 0.0625f

typedef struct {
    global const float* restrict rays;
    uint stride;
    float scale;  // factor from the rays' coordinates to the dilated occupancy's
} BeamRays;

/// One component of rays, such as VXL_RAY_OX + axis or VXL_RAY_DX + axis.
static inline lane_float ray_value(const BeamRays* r, lane_int component, lane_uint ray) {
    return LANES_GATHER_FLOAT(r->rays, LANES_AS_UINT(component) * r->stride + ray);
}

/// The coordinates of rays' origins along an axis, in the dilated occupancy.
static inline lane_float ray_slot(const BeamRays* r, lane_int axis, lane_uint ray) {
    return r->scale * ray_value(r, (lane_int)VXL_RAY_OX + axis, ray);
}

/// Mask: slots that hold a ray.
static inline lane_int is_ray(const BeamRays* r, lane_uint ray) {
    return LANE_MASK(LANES_GATHER_FLOAT(r->rays, VXL_RAY_END * r->stride + ray) >= 0.0f);
}

/// The axis that a group mostly follows, and the sign of its direction there, found from the
/// corners of a tile of 4 x 4; 0 where none of these slots holds a ray.
static inline lane_int main_axis(const BeamRays* r, lane_uint first, lane_float* sign) {
    lane_float dx = (lane_float)0.0f, dy = dx, dz = dx;
    for (uint corner = 0; corner < 4; ++corner) {
        const lane_uint ray = first + (corner & 1u) * 3u + (corner >> 1) * 12u;
        const lane_int held = is_ray(r, ray);
        const lane_float zero = (lane_float)0.0f;
        dx += LANES_SELECT(held, ray_value(r, (lane_int)VXL_RAY_DX, ray), zero);
        dy += LANES_SELECT(held, ray_value(r, (lane_int)VXL_RAY_DY, ray), zero);
        dz += LANES_SELECT(held, ray_value(r, (lane_int)VXL_RAY_DZ, ray), zero);
    }
    const lane_float ax = fabs(dx), ay = fabs(dy), az = fabs(dz);
    const lane_int is_x = LANE_MASK(ax >= ay) & LANE_MASK(ax >= az);
    const lane_int is_y = LANE_MASK(ay >= az) & ~is_x;
    const lane_float d = LANES_SELECT(is_x, dx, LANES_SELECT(is_y, dy, dz));
    *sign = LANES_SELECT(LANE_MASK(d > 0.0f), (lane_float)1.0f,
                         LANES_SELECT(LANE_MASK(d < 0.0f), (lane_float)-1.0f, (lane_float)0.0f));
    return ~is_x & (2 + is_y);
}

/// The range of a group's rays along one axis, at the world's near and far side along the main
/// axis.
typedef struct {
    lane_float min_near, max_near, min_far, max_far;
} Span;

static inline Span empty_span(void) {
    const lane_float far = (lane_float)INFINITY;
    const Span span = {far, -far, far, -far};
    return span;
}

static inline void widen(lane_float near, lane_float far, lane_int held, Span* span) {
    span->min_near = LANES_SELECT(held, fmin(span->min_near, near), span->min_near);
    span->max_near = LANES_SELECT(held, fmax(span->max_near, near), span->max_near);
    span->min_far = LANES_SELECT(held, fmin(span->min_far, far), span->min_far);
    span->max_far = LANES_SELECT(held, fmax(span->max_far, far), span->max_far);
}

/// One axis of beams: their line b0 + m s, whose distance from their rays is at most r0 + e s.
typedef struct {
    lane_float b0, m, r0, e;
} BeamAxis;

/// The line and radius in the middle of a span; zeros in lanes that are not `active`.
static inline BeamAxis beam_axis(const Span* span, lane_float s_near, lane_float s_far,
                                 lane_int active) {
    const lane_float per_s = exact_reciprocal(s_far - s_near), zero = (lane_float)0.0f;
    const lane_float minimum = LANES_SELECT(active, span->min_near, zero);
    const lane_float maximum = LANES_SELECT(active, span->max_near, zero);
    const lane_float min_far = LANES_SELECT(active, span->min_far, zero);
    const lane_float max_far = LANES_SELECT(active, span->max_far, zero);
    const lane_float middle = 0.5f * (minimum + maximum), radius = 0.5f * (maximum - minimum);
    const lane_float middle_far = 0.5f * (min_far + max_far);
    const lane_float radius_far = 0.5f * (max_far - min_far);
    BeamAxis axis;
    axis.m = (middle_far - middle) * per_s;
    axis.e = (radius_far - radius) * per_s;
    axis.b0 = fma(-axis.m, s_near, middle);
    axis.r0 = fma(-axis.e, s_near, radius);
    return axis;
}

/// The s up to which beams that begin at `s` are narrow enough; -infinity where they are already
/// too wide there.
static inline lane_float narrow_until(const BeamAxis* axis, lane_float s) {
    const lane_int grows = LANE_MASK(axis->e > 0.0f);
    const lane_float widest =
        exact_divide(VXL_BEAM_RADIUS - axis->r0, LANES_SELECT(grows, axis->e, (lane_float)1.0f));
    const lane_int narrow = LANE_MASK(fma(axis->e, s, axis->r0) <= VXL_BEAM_RADIUS);
    return LANES_SELECT(narrow, LANES_SELECT(grows, widest, (lane_float)INFINITY),
                        (lane_float)-INFINITY);
}

/// The s at which a line leaves the block of 1 << log2_size around `cell` across a plane of this
/// axis. Cells at the world's sides extend outwards to infinity, and represent lines outside.
static inline lane_float block_exit(const BeamAxis* axis, lane_int cell, lane_int log2_size,
                                    lane_int size) {
    const lane_int edge = (lane_int)1 << log2_size;
    const lane_int low = cell & -edge, high = low + edge;
    const lane_int up = LANE_MASK(axis->m > 0.0f);
    const lane_int plane = LANES_SELECT(up, high, low);
    const lane_int endless =
        LANE_MASK(axis->m == 0.0f) | (up & LANE_MASK(high >= size)) | (~up & LANE_MASK(low <= 0));
    const lane_float m = LANES_SELECT(endless, (lane_float)1.0f, axis->m);
    return LANES_SELECT(endless, (lane_float)INFINITY,
                        exact_divide(LANES_FLOAT(plane) - axis->b0, m));
}

static inline lane_int cell_inside(lane_float position, lane_int size) {
    return LANES_INT(clamp(position, (lane_float)0.0f, LANES_FLOAT(size - 1)));
}

/// The s up to which the beams of the `active` lanes run from s0 through the dilated occupancy's
/// empty space; s_last or more where everything up to s_last is empty. s counts along `axis`, or
/// against it where `sign` is negative.
static inline lane_float run_beams(const PyramidView* p, lane_int axis, lane_float sign,
                                   const BeamAxis* b, const BeamAxis* c, lane_float s0,
                                   lane_float s_last, lane_int active) {
    const lane_int is_x = LANE_MASK(axis == 0), is_y = LANE_MASK(axis == 1);
    const lane_int size_a =
        LANES_SELECT(is_x, (lane_int)p->size_x, LANES_SELECT(is_y, (lane_int)p->size_y, p->size_z));
    const lane_int size_b = LANES_SELECT(is_x, (lane_int)p->size_y, (lane_int)p->size_x);
    const lane_int size_c = LANES_SELECT(is_x | is_y, (lane_int)p->size_z, (lane_int)p->size_y);
    const lane_int up = LANE_MASK(sign > 0.0f);
    lane_float s = s0 + VXL_BEAM_STEP;
    LastSector last = no_sector();
    lane_int running = active & LANE_MASK(s < s_last);
    while (lanes_any(running)) {
        const lane_int a_cell = cell_inside(s * sign, size_a);
        const lane_int b_cell = cell_inside(fma(b->m, s, b->b0), size_b);
        const lane_int c_cell = cell_inside(fma(c->m, s, c->b0), size_c);
        const lane_int x = LANES_SELECT(is_x, a_cell, b_cell);
        const lane_int y = LANES_SELECT(is_y, a_cell, LANES_SELECT(is_x, b_cell, c_cell));
        const lane_int z = LANES_SELECT(is_x | is_y, c_cell, a_cell);
        CellState state;
        const lane_int near = look_up_leaf(p, x, y, z, running, &last, &state);
        running &= ~near;
        const lane_int edge = (lane_int)1 << state.log2_size;
        const lane_int low = a_cell & -edge;
        const lane_float a_exit = LANES_FLOAT(LANES_SELECT(up, low + edge, -low));
        const lane_float side_exit = fmin(block_exit(b, b_cell, state.log2_size, size_b),
                                          block_exit(c, c_cell, state.log2_size, size_c));
        const lane_float next = fmax(fmin(a_exit, side_exit), s) + VXL_BEAM_STEP;
        s = LANES_SELECT(running, next, s);
        running &= LANE_MASK(s < s_last);
    }
    return s;
}

#endif
