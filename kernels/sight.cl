// SPDX-License-Identifier: Apache-2.0
// observer -> rays: one sight ray for every sample of every pixel, clipped to the world.
//
// Rays come in tiles of 4 x 4 pixels, a tile's samples one after another. For every number of
// lanes, a ray's index is ((tile * samples) + sample) * 16 + pixel of the tile.
#include "lib/lanes/fixed_point.h"
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/traverse/beam.h"
#include "lib/traverse/display_shape.h"
#include "lib/traverse/lens.h"
#include "shared/scene.h"

/// Converts observer metres to voxels, along one axis of the world.
static inline lane_float along(float ax, float ay, float az, Vector v) {
    return fma(v.x, ax, fma(v.y, ay, v.z * az));
}

/// What all packets of sight rays have in common. `offsets` holds the x and y in [0, 1) of each
/// sample within its pixel; with VXL_SCATTERED_SIGHT, the positions that filter_positions gives.
typedef struct {
    Camera camera;
    PyramidShape shape;
    global const float* offsets;
    uint stride;
} SightCast;

/// The position along an axis before which a pixel's filter has this share of its weight.
static inline lane_float position_of_share(global const float* restrict positions,
                                           lane_float share) {
    const lane_float at = share * (float)VXL_FILTER_STEPS;
    const lane_uint step = min(LANES_UINT(at), (lane_uint)(VXL_FILTER_STEPS - 1u));
    const lane_float from = LANES_GATHER_FLOAT(positions, step);
    const lane_float to = LANES_GATHER_FLOAT(positions, step + 1u);
    return fma(at - LANES_FLOAT(step), to - from, from);
}

/// The positions of a sample within pixels of the whole frame, from their upper left corners. With
/// VXL_SCATTERED_SIGHT, the first sample lies in the middle and each pixel has others of its own.
static inline SquarePoint sample_positions(const SightCast* cast, lane_int column, lane_int row,
                                           uint sample) {
    const uint number = (uint)cast->camera.first_sample + sample;
    SquarePoint p = {(lane_float)0.5f, (lane_float)0.5f};
    if (!VXL_SCATTERED_SIGHT) {
        p.x = (lane_float)cast->offsets[2u * sample];
        p.y = (lane_float)cast->offsets[2u * sample + 1u];
    } else if (number != 0u) {
        const SampledPixels pixels =
            sampled_pixels(LANES_AS_UINT(column) | (LANES_AS_UINT(row) << 16), (lane_uint)number);
        const SquarePoint shares = pixel_point(&pixels, (lane_uint)VXL_DECISION_SIGHT);
        p.x = position_of_share(cast->offsets, shares.x);
        p.y = position_of_share(cast->offsets, shares.y);
    }
    return p;
}

/// Writes the rays of one packet: one sample of the pixels in these columns and rows, from ray
/// `first` on. Pixels outside the image get no ray.
static inline void cast_packet(const SightCast* cast, lane_int column, lane_int row, uint sample,
                               uint first, global float* restrict rays) {
    const Camera camera = cast->camera;
    const PyramidShape shape = cast->shape;
    const uint stride = cast->stride;
    lane_int seen = LANE_MASK(column < camera.width) & LANE_MASK(row < camera.height);

    const lane_int frame_column = column + camera.first_column, frame_row = row + camera.first_row;
    const SquarePoint at = sample_positions(cast, frame_column, frame_row, sample);
    const lane_float px = LANES_FLOAT(frame_column) + at.x;
    const lane_float py = LANES_FLOAT(frame_row) + at.y;
    const lane_float u = exact_divide(2.0f * px, (lane_float)(float)camera.frame_width) - 1.0f;
    const lane_float v = exact_divide(2.0f * py, (lane_float)(float)camera.frame_height) - 1.0f;
    SightRay ray = sight_ray(&camera, u, v, &seen);
    if (VXL_LENS)
        ray =
            through_lens(&camera, ray,
                         lens_point(&camera, LANES_AS_UINT(frame_column), LANES_AS_UINT(frame_row),
                                    (uint)camera.first_sample + sample));

    lane_float dx = along(camera.axis_x.x, camera.axis_y.x, camera.axis_z.x, ray.direction);
    lane_float dy = along(camera.axis_x.y, camera.axis_y.y, camera.axis_z.y, ray.direction);
    lane_float dz = along(camera.axis_x.z, camera.axis_y.z, camera.axis_z.z, ray.direction);
    const lane_float scale = power_of_two_scale(dx, dy, dz);
    const lane_float per_metre = exact_reciprocal(scale);
    dx = snap_direction(dx * scale), dy = snap_direction(dy * scale),
    dz = snap_direction(dz * scale);

    const lane_float lx =
        camera.origin_low.x + along(camera.axis_x.x, camera.axis_y.x, camera.axis_z.x, ray.start);
    const lane_float ly =
        camera.origin_low.y + along(camera.axis_x.y, camera.axis_y.y, camera.axis_z.y, ray.start);
    const lane_float lz =
        camera.origin_low.z + along(camera.axis_x.z, camera.axis_y.z, camera.axis_z.z, ray.start);
    const lane_float t_far = camera.far_plane * per_metre;
    lane_float t_first = camera.near_plane * per_metre, t_last = t_far;
    const Vector origin = {camera.origin.x + lx, camera.origin.y + ly, camera.origin.z + lz};
    const Vector direction = {dx, dy, dz};
    clip_to_world(origin, direction, shape.size_x, shape.size_y, shape.size_z, &t_first, &t_last);
    seen &= LANE_MASK(t_first <= t_last);
    t_first = LANES_SELECT(seen, t_first, (lane_float)0.0f);

    const lane_float zero = (lane_float)0.0f;
    const lane_float ox = start_coordinate(camera.origin.x, lx, dx, (float)shape.size_x, t_first);
    const lane_float oy = start_coordinate(camera.origin.y, ly, dy, (float)shape.size_y, t_first);
    const lane_float oz = start_coordinate(camera.origin.z, lz, dz, (float)shape.size_z, t_first);
    LANES_STORE(snap_position(ox, zero, shape.fixed_point), rays, VXL_RAY_OX * stride + first);
    LANES_STORE(snap_position(oy, zero, shape.fixed_point), rays, VXL_RAY_OY * stride + first);
    LANES_STORE(snap_position(oz, zero, shape.fixed_point), rays, VXL_RAY_OZ * stride + first);
    LANES_STORE(dx, rays, VXL_RAY_DX * stride + first);
    LANES_STORE(dy, rays, VXL_RAY_DY * stride + first);
    LANES_STORE(dz, rays, VXL_RAY_DZ * stride + first);
    // The ray ends at the far surface. The walk finds out exactly where it leaves the world.
    const lane_float t_end = LANES_SELECT(seen, t_far - t_first, (lane_float)-1.0f);
    LANES_STORE(t_end, rays, VXL_RAY_END * stride + first);
}

/// Casts the sight rays of tiles from `first_tile` on.
kernel void cast_sight(Camera camera, PyramidShape shape, global const float* restrict offsets,
                       uint first_tile, uint count, uint stride, global float* restrict rays) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const uint group = first / 16u;
    const uint tile = first_tile + group / (uint)camera.samples;
    const uint tiles_x = ((uint)camera.width + 3u) / 4u;
    const lane_int pixel = LANES_NUMBERS + (int)(first % 16u);
    const lane_int column = (int)(tile % tiles_x * 4u) + (pixel & 3);
    const lane_int row = (int)(tile / tiles_x * 4u) + (pixel >> 2);
    const SightCast cast = {camera, shape, offsets, stride};
    cast_packet(&cast, column, row, group % (uint)camera.samples, first, rays);
}

/// Casts the sight rays of the pixels that a list names, 16 a tile. `pixels` holds their numbers
/// along the image's rows, or VXL_NO_PIXEL.
kernel void cast_listed(Camera camera, PyramidShape shape, global const float* restrict offsets,
                        global const uint* restrict pixels, uint first_tile, uint count,
                        uint stride, global float* restrict rays) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const uint group = first / 16u;
    const uint tile = first_tile + group / (uint)camera.samples;
    const lane_uint pixel = LANES_LOAD(pixels, tile * (size_t)16 + first % 16u);
    const lane_uint row = pixel / (uint)camera.width;
    const lane_uint column = pixel - row * (uint)camera.width;
    const SightCast cast = {camera, shape, offsets, stride};
    const lane_int known = LANE_MASK(pixel != VXL_NO_PIXEL);
    cast_packet(&cast, LANES_SELECT(known, LANES_AS_INT(column), (lane_int)camera.width),
                LANES_AS_INT(row), group % (uint)camera.samples, first, rays);
}

/// Groups of 16 rays, one a lane, and the beam of each. A beam's s is the coordinate along its main
/// axis, times the sign of its direction there.
typedef struct {
    lane_uint first_ray;
    lane_int axis, axis_b, axis_c;  // the main axis, and the two across it
    lane_float sign, s_near, s_far;
    lane_int active;      // mask: the beam can be sent
    lane_int idle;        // mask: the group has no rays
    Span b_span, c_span;  // across the axis: the range of the rays at s_near and s_far
    lane_float s_first;   // s where the first ray begins
} BeamGroup;

static inline BeamGroup begin_group(PyramidShape shape, const BeamRays* r, lane_uint first_ray) {
    BeamGroup g;
    g.first_ray = first_ray;
    g.axis = main_axis(r, first_ray, &g.sign);
    const lane_int is_x = LANE_MASK(g.axis == 0), is_y = LANE_MASK(g.axis == 1);
    g.axis_b = 1 & is_x, g.axis_c = 1 + (1 & (is_x | is_y));
    const lane_int size =
        LANES_SELECT(is_x, (lane_int)shape.size_x,
                     LANES_SELECT(is_y, (lane_int)shape.size_y, (lane_int)shape.size_z));
    g.s_near = LANES_SELECT(LANE_MASK(g.sign > 0.0f), (lane_float)0.0f, -LANES_FLOAT(size));
    g.s_far = g.s_near + LANES_FLOAT(size);
    g.b_span = g.c_span = empty_span();
    g.s_first = g.s_far;
    g.idle = (lane_int)-1;
    g.active = LANE_MASK(g.sign != 0.0f);
    return g;
}

/// Widens the beams to hold ray number `i` of their groups.
static inline void add_ray(BeamGroup* g, const BeamRays* r, uint i) {
    const lane_uint ray = g->first_ray + i;
    const lane_int found = is_ray(r, ray), held = found & g->active;
    g->idle &= ~found;
    const lane_float s0 = g->sign * ray_slot(r, g->axis, ray);
    const lane_float d = g->sign * ray_value(r, g->axis + VXL_RAY_DX, ray);
    g->active &= ~held | LANE_MASK(d >= VXL_BEAM_MIN_DIRECTION);
    const lane_float per_s = exact_reciprocal(LANES_SELECT(g->active & held, d, (lane_float)1.0f));
    const lane_float mb = ray_value(r, g->axis_b + VXL_RAY_DX, ray) * per_s;
    const lane_float mc = ray_value(r, g->axis_c + VXL_RAY_DX, ray) * per_s;
    const lane_float b = ray_slot(r, g->axis_b, ray), c = ray_slot(r, g->axis_c, ray);
    widen(fma(mb, g->s_near - s0, b), fma(mb, g->s_far - s0, b), held, &g->b_span);
    widen(fma(mc, g->s_near - s0, c), fma(mc, g->s_far - s0, c), held, &g->c_span);
    g->s_first = LANES_SELECT(held, fmin(g->s_first, s0), g->s_first);
}

/// One work-item sends VXL_LANES beams, each along the 16 rays of its group; see shared/trace.h.
/// `scale`, a power of two, turns the rays' coordinates into the dilated occupancy's. Adds the
/// number of clear beams to `cleared`, a low and a high word.
kernel void start_beams(PyramidShape shape, global const uint* restrict sectors,
                        global const uint* restrict bricks, float scale,
                        global const float* restrict rays, uint count, uint stride,
                        global uint* restrict beams, global uint* restrict cleared) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const PyramidView dilated_occupancy = pyramid_view(shape, sectors, bricks, 0, 0);
    const BeamRays r = {rays, stride, scale};
    const lane_uint beam = min(LANES_AS_UINT(LANES_NUMBERS + (int)first), (lane_uint)(count - 1u));
    BeamGroup g = begin_group(shape, &r, beam * VXL_BEAM_RAYS);
    for (uint i = 0; i < VXL_BEAM_RAYS; ++i) add_ray(&g, &r, i);
    const BeamAxis b = beam_axis(&g.b_span, g.s_near, g.s_far, g.active);
    const BeamAxis c = beam_axis(&g.c_span, g.s_near, g.s_far, g.active);
    const lane_float s_last =
        fmin(fmin(narrow_until(&b, g.s_first), narrow_until(&c, g.s_first)), g.s_far);
    const lane_float end =
        run_beams(&dilated_occupancy, g.axis, g.sign, &b, &c, g.s_first, s_last, g.active);
    const lane_float start = (fmin(end, s_last) - 2.0f * VXL_BEAM_STEP) * inverse_of_power(scale);
    const uint slots = VXL_BEAM_SLOTS(stride);
    LANES_STORE(LANES_AS_UINT(start), beams, VXL_BEAM_START * slots + first);
    // The dilated occupancy's last leaf extends 4 voxels beyond the world, which covers the step
    // past its planes. A beam that begins within a step of the far side has looked at nothing.
    const lane_int clear = LANE_MASK(s_last >= g.s_far) & LANE_MASK(end >= g.s_far) &
                           LANE_MASK(g.s_first + VXL_BEAM_STEP < g.s_far);
    lane_int towards = g.axis | (~LANE_MASK(g.sign > 0.0f) & VXL_BEAM_DOWN);
    towards = LANES_SELECT(g.active, towards, (lane_int)VXL_BEAM_NONE);
    const lane_int ended = (g.active & clear) | g.idle;
    towards = LANES_SELECT(ended, (lane_int)VXL_BEAM_CLEAR, towards);
    LANES_STORE(LANES_AS_UINT(towards), beams, VXL_BEAM_AXIS * slots + first);
    const uint sum =
        (uint)lanes_count(ended & LANE_MASK(LANES_AS_UINT(LANES_NUMBERS + (int)first) < count));
    if (sum > 0 && atomic_add(&cleared[0], sum) > ~0u - sum) atomic_inc(&cleared[1]);
}
