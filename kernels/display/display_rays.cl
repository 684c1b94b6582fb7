// SPDX-License-Identifier: Apache-2.0
// lit sight rays -> P in the layout `rays`: the voxel of each surface, and the voxels of the medium
// before it.
//
// Rays are in the order of sight.cl, with one sample a pixel. The space between a ray's way into
// the world and its end is cut into steps. The voxels of P are written by ascending index, u +
// width (v + height k).
#include "lib/display/depth.h"
#include "lib/display/voxels.h"
#include "lib/lanes/exact_exp.h"
#include "lib/lanes/fixed_point.h"
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/traverse/ray_batch.h"
#include "shared/display.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

#define VXL_NO_STEP 0xFFFFFFFFu

// Transmittances below this limit count as this limit, so that nothing is divided by zero.
#define VXL_MIN_TRANSMITTANCE 9.5367431640625e-7f

/// The parameters that `bind` of RayDepths sets, in its order.
#define VXL_DEPTHS_PARAMETERS                                                 \
    global uint *restrict ray_steps, global float *restrict ray_depths,       \
        global uint *restrict ray_objects, global float *restrict ray_colors, \
        global float *restrict ray_spans, uint total

/// The data that each of `total` rays keeps for its voxels; see
/// runtime/stages/display/display_rays.hpp.
typedef struct {
    global uint* restrict steps;
    global float* restrict depths;
    global uint* restrict objects;
    global float* restrict colors;
    global float* restrict spans;
    uint total;
} RayDepths;

/// The value of RayDepths in a kernel with these parameters.
#define VXL_DEPTHS \
    { ray_steps, ray_depths, ray_objects, ray_colors, ray_spans, total }

// Values of the array `ray_spans`, `total` apart. Depths are metres beyond the near surface.
#define VXL_SPAN_FIRST 0  // where the ray enters the world
#define VXL_SPAN_END 1    // where it ends in the world, at a surface or not
#define VXL_SPAN_RATIO 2  // metres of the ray per metre of depth
#define VXL_SPAN_COMPONENTS 3

/// 1 - e^-x for x >= 0, with a small relative error near 0 as well.
static inline lane_float covered_part(lane_float x) {
    lane_float p = fma(x, 8.33333333e-3f, -4.16666667e-2f);
    p = fma(p, x, 1.66666667e-1f);
    p = fma(p, x, -0.5f);
    p = fma(p, x, 1.0f);
    return LANES_SELECT(LANE_MASK(x < 0.125f), x * p, 1.0f - exact_exp(-x));
}

/// Stores the span of a ray in the world, up to the surface that it met.
static inline void measure_span(const Camera* camera, PyramidShape shape, const RayBatch* batch,
                                uint first, lane_int hit, const RayDepths* kept, uint index) {
    const uint stride = batch->stride;
    const lane_float t_end = LANES_LOAD(batch->rays, VXL_RAY_END * stride + first);
    lane_float t_first = (lane_float)0.0f, t_last = t_end;
    const Vector o = load_vector(batch->rays, stride, first);
    const Vector d = load_vector(batch->rays + VXL_RAY_DX * stride, stride, first);
    clip_to_world(o, d, shape.size_x, shape.size_y, shape.size_z, &t_first, &t_last);
    const lane_float t_hit = LANES_AS_FLOAT(LANES_LOAD(batch->hits, VXL_HIT_T * stride + first));
    const lane_float t = fmax(LANES_SELECT(hit, t_hit, t_last), 0.0f);
    const DepthScale scale = depth_scale(camera, shape.edge, o, d);
    const lane_float begin = scale.origin;
    const lane_float end = fma(scale.along, t, begin);
    const lane_int seen = LANE_MASK(t_end >= 0.0f);
    LANES_STORE(begin, kept->spans, VXL_SPAN_FIRST * kept->total + index);
    LANES_STORE(LANES_SELECT(seen, end, begin), kept->spans, VXL_SPAN_END * kept->total + index);
    const lane_float ratio =
        exact_divide(scale.metres, LANES_SELECT(seen, scale.along, (lane_float)1.0f));
    LANES_STORE(ratio, kept->spans, VXL_SPAN_RATIO * kept->total + index);
}

/// For rays 0 .. count-1, which are the image's rays from `first_ray` on, stores what their voxels
/// need: the step of the surface met (VXL_NO_STEP for none), its depth in metres, its object and
/// light, and the span in the medium.
kernel void measure_steps(Camera camera, PyramidShape shape, DisplaySteps steps,
                          VXL_BATCH_PARAMETERS, uint count, uint first_ray, VXL_DEPTHS_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const RayDepths kept = VXL_DEPTHS;
    const uint index = first_ray + first;
    const lane_int hit =
        LANE_MASK(LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first) != VXL_NO_VOXEL);
    const lane_float depth =
        depth_of(&camera, shape.edge, from_eye(&camera, load_vector(positions, stride, first)));
    const lane_uint step = step_of(&steps, depth - camera.near_plane);
    LANES_STORE(LANES_SELECT(hit, step, (lane_uint)VXL_NO_STEP), ray_steps, index);
    LANES_STORE(depth + camera.lead, ray_depths, index);
    const lane_uint object = (LANES_LOAD(hit_attributes, first) & VXL_OBJECT_MASK) + 1u;
    LANES_STORE(object & LANES_AS_UINT(hit), ray_objects, index);
    for (uint channel = 0; channel < 3; ++channel)
        LANES_STORE(LANES_LOAD(radiance, channel * stride + first), ray_colors,
                    channel * total + index);
    if (VXL_MEDIUM) measure_span(&camera, shape, &batch, first, hit, &kept, index);
}

/// The index of pixel (u, v)'s ray in the order of sight.cl.
static inline uint ray_of_pixel(uint u, uint v, uint width) {
    const uint tile = v / 4u * ((width + 3u) / 4u) + u / 4u;
    return tile * 16u + (v & 3u) * 4u + (u & 3u);
}

/// Steps first .. end-1 of a ray hold space that shows; step `hit` holds a surface.
typedef struct {
    uint first, end, hit;
} RaySteps;

static inline RaySteps steps_of_ray(DisplaySteps steps, const RayDepths* kept, uint ray) {
    RaySteps s = {0, 0, kept->steps[ray]};
    if (!VXL_MEDIUM) return s;
    const float begin = kept->spans[VXL_SPAN_FIRST * kept->total + ray];
    const float end = kept->spans[VXL_SPAN_END * kept->total + ray];
    if (!(begin < end) || steps.absorption == 0.0f) return s;
    const float maximum = (float)(steps.count - 1);
    s.first = (uint)clamp(begin * steps.inverse_step, 0.0f, maximum);
    s.end =
        s.hit != VXL_NO_STEP ? s.hit : (uint)clamp(end * steps.inverse_step, 0.0f, maximum) + 1u;
    return s;
}

/// Counts the voxels of row v in every layer k: counts[v + height k]. One work-item takes one row.
kernel void count_voxels(uint width, uint height, DisplaySteps steps, VXL_DEPTHS_PARAMETERS,
                         global uint* restrict counts) {
    const uint v = work_item();
    if (v >= height) return;
    const RayDepths kept = VXL_DEPTHS;
    for (uint u = 0; u < width; ++u) {
        const RaySteps s = steps_of_ray(steps, &kept, ray_of_pixel(u, v, width));
        for (uint k = s.first; k < s.end; ++k) ++counts[v + (size_t)height * k];
        if (s.hit != VXL_NO_STEP) ++counts[v + (size_t)height * s.hit];
    }
}

/// Writes the indices of row v's voxels from starts[v + height k] on, and advances these starts.
/// Writes the ray of each voxel to `sources`.
kernel void place_voxels(uint width, uint height, DisplaySteps steps, VXL_DEPTHS_PARAMETERS,
                         global uint* restrict starts, global ulong* restrict indices,
                         global uint* restrict sources) {
    const uint v = work_item();
    if (v >= height) return;
    const RayDepths kept = VXL_DEPTHS;
    for (uint u = 0; u < width; ++u) {
        const uint ray = ray_of_pixel(u, v, width);
        const RaySteps s = steps_of_ray(steps, &kept, ray);
        for (uint k = s.first; k < s.end; ++k) {
            const uint voxel = starts[v + (size_t)height * k]++;
            indices[voxel] = u + (ulong)width * (v + (ulong)height * k);
            sources[voxel] = ray;
        }
        if (s.hit == VXL_NO_STEP) continue;
        const uint voxel = starts[v + (size_t)height * s.hit]++;
        indices[voxel] = u + (ulong)width * (v + (ulong)height * s.hit);
        sources[voxel] = ray;
    }
}

/// The medium before and inside a packet's voxels, in metres.
typedef struct {
    lane_float before, inside;
    lane_float throughput;  // transmittance of the voxels before
} Immersion;

static inline Immersion immersion_of(const DisplaySteps* steps, const RayDepths* kept,
                                     lane_uint ray, lane_uint k) {
    const uint total = kept->total;
    const lane_float begin = LANES_GATHER_FLOAT(kept->spans, ray + VXL_SPAN_FIRST * total);
    const lane_float end = LANES_GATHER_FLOAT(kept->spans, ray + VXL_SPAN_END * total);
    const lane_float ratio = LANES_GATHER_FLOAT(kept->spans, ray + VXL_SPAN_RATIO * total);
    const lane_float from = fmax(LANES_FLOAT(k) * steps->step, begin);
    const lane_float to = fmin((LANES_FLOAT(k) + 1.0f) * steps->step, end);
    Immersion m;
    m.before = fmax(from - begin, 0.0f) * ratio;
    m.inside = fmax(to - from, 0.0f) * ratio;
    m.throughput = fmax(exact_exp(-steps->absorption * m.before), VXL_MIN_TRANSMITTANCE);
    return m;
}

/// The colour of voxels in the medium, as if nothing covered them. For a voxel of space, it is the
/// light that the medium in it adds; for a surface, it is its radiance `value` less the light of
/// the medium before it.
static inline lane_float color_in_medium(const Immersion* m, float absorption, float color,
                                         lane_int is_object, lane_float opacity, lane_float value) {
    const lane_float kept = exact_exp(-absorption * m->before);
    const lane_float added = color * covered_part(absorption * m->inside) * kept;
    const lane_float of_surface = fma(-color, covered_part(absorption * m->before), value);
    const lane_float part = LANES_SELECT(is_object, of_surface, added);
    const lane_float share = fmax(m->throughput * opacity, 1.17549435e-38f);
    return fmax(exact_divide(part, share), 0.0f);
}

/// Gives voxels 0 .. count-1 their colours (three each, one after another), opacities, depths and
/// objects. On entry, `objects` holds the ray of each.
///
/// A voxel of space adds color (1 - exp(-absorption x)) over its x metres of medium. Its opacity
/// lets through what the least absorbed channel keeps; what the other channels lose in addition is
/// taken from the colours behind. A surface's radiance came through all of the medium, so what the
/// voxels before it add is subtracted, and what they cover is restored.
kernel void fill_voxels(uint width, uint height, DisplaySteps steps, float near_depth,
                        Environment environment, VXL_DEPTHS_PARAMETERS, uint count,
                        VXL_VOXEL_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayDepths kept = VXL_DEPTHS;
    const VoxelArrays voxels = VXL_VOXELS;
    const lane_int there = LANE_MASK(LANES_NUMBERS + (int)first < (int)count);
    uint layer[VXL_LANES];
    for (uint i = 0; i < VXL_LANES; ++i)
        layer[i] = first + i < count ? (uint)(indices[first + i] / ((ulong)width * height)) : 0;
    const lane_uint k = LANES_LOAD(layer, 0);
    const lane_uint ray = LANES_LOAD(objects, first) & LANES_AS_UINT(there);
    const lane_int is_object = LANE_MASK(LANES_GATHER_UINT(ray_steps, ray) == k);
    lane_float depth = LANES_GATHER_FLOAT(ray_depths, ray);
    lane_float opacity = (lane_float)1.0f;
    Immersion medium;
    if (VXL_MEDIUM) {
        medium = immersion_of(&steps, &kept, ray, k);
        opacity = LANES_SELECT(is_object, opacity, covered_part(steps.absorption * medium.inside));
        const lane_float middle = fma(LANES_FLOAT(k) + 0.5f, steps.step, near_depth);
        depth = LANES_SELECT(is_object, depth, middle);
    }
    const float absorption[3] = {environment.absorption.x, environment.absorption.y,
                                 environment.absorption.z};
    const float color[3] = {environment.color.x, environment.color.y, environment.color.z};
    VoxelValues values;
    for (uint channel = 0; channel < 3; ++channel) {
        lane_float value = LANES_GATHER_FLOAT(ray_colors, ray + channel * total);
        if (VXL_MEDIUM)
            value = color_in_medium(&medium, absorption[channel], color[channel], is_object,
                                    opacity, value);
        LANES_STORE(value, values.color, channel * VXL_LANES);
    }
    LANES_STORE(opacity, values.opacity, 0);
    LANES_STORE(depth, values.depth, 0);
    const lane_uint object = LANES_GATHER_UINT(ray_objects, ray) & LANES_AS_UINT(is_object);
    LANES_STORE(object, values.object, 0);
    for (uint i = 0; i < VXL_LANES && first + i < count; ++i)
        store_voxel(&voxels, first + i, &values, i);
}
