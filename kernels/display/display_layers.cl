// SPDX-License-Identifier: Apache-2.0
// lit sight rays, layer by layer -> records of what each shows in P, in the layout `rays`.
//
// This file is for worlds whose surfaces let light through, or whose medium varies. The host makes
// the voxels from the records.
#include "lib/display/depth.h"
#include "lib/lanes/exact_exp.h"
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/light/paths.h"
#include "lib/medium/space_medium.h"
#include "lib/traverse/ray_batch.h"
#include "shared/display.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

/// The light that a layer adds to an entry's node, and its coverage.
typedef struct {
    float light[3];
    float clear_before, clear;  // the uncovered parts before and behind the layer
} LayerLight;

/// Subtracts the light of earlier layers, `seen`, from the node's light, and adds the layer to
/// `seen`. With VXL_OWN_LIGHT, nodes hold one layer alone.
static inline LayerLight take_light(const NodeLight* nodes, uint ray, bool goes_on, bool hit,
                                    global float* restrict seen) {
    const uint stride = nodes->stride;
    LayerLight l;
    if (VXL_OWN_LIGHT) {
        for (uint c = 0; c < 3; ++c) l.light[c] = nodes->radiance[c * stride + ray];
        l.clear_before = 1.0f;
        l.clear = 1.0f - nodes->coverage[ray];
        return l;
    }
    for (uint c = 0; c < 3; ++c) {
        const float before = goes_on ? seen[c * stride + ray] : 0.0f;
        l.light[c] = nodes->radiance[c * stride + ray] - before;
        if (VXL_TRANSMISSION) seen[c * stride + ray] = nodes->radiance[c * stride + ray];
    }
    l.clear_before = goes_on ? 1.0f - seen[3 * stride + ray] : 1.0f;
    l.clear = VXL_TRANSMISSION ? 1.0f - nodes->coverage[ray] : hit ? 0.0f : 1.0f;
    if (VXL_TRANSMISSION) seen[3 * stride + ray] = nodes->coverage[ray];
    return l;
}

/// Vector `n` of an array, in every lane.
static inline Vector one_vector(global const float* restrict p, uint stride, uint n) {
    const Vector v = {(lane_float)p[n], (lane_float)p[stride + n], (lane_float)p[2 * stride + n]};
    return v;
}

/// Writes the depths of entry n's way: VXL_LAYER_STEP, and VXL_LAYER_DEPTH to VXL_LAYER_RATIO. All
/// lanes compute the same ray, so depths equal those of the other kernels bit for bit.
static inline void write_depths(const Camera* camera, PyramidShape shape, const DisplaySteps* steps,
                                const RayBatch* batch, uint n, uint count, bool goes_on, bool hit,
                                global uint* restrict records) {
    const uint stride = batch->stride;
    const Vector o = one_vector(batch->rays, stride, n);
    const Vector d = one_vector(batch->rays + VXL_RAY_DX * stride, stride, n);
    const Vector at = one_vector(batch->positions, stride, n);
    const float t_end = batch->rays[VXL_RAY_END * stride + n];
    lane_float t_first = (lane_float)0.0f, t_last = (lane_float)t_end;
    clip_to_world(o, d, shape.size_x, shape.size_y, shape.size_z, &t_first, &t_last);
    const lane_float from = fmax(t_first, goes_on ? batch->starts[n] : 0.0f);
    const lane_float to = hit ? (lane_float)as_float(batch->hits[VXL_HIT_T * stride + n]) : t_last;
    const DepthScale scale = depth_scale(camera, shape.edge, o, d);
    const lane_float depth = depth_of(camera, shape.edge, from_eye(camera, at));
    const bool idle = t_end < 0.0f;
    const lane_float begin = fma(scale.along, from, scale.origin);
    const lane_float values[5] = {depth + camera->lead, begin,
                                  idle ? begin : fmax(fma(scale.along, to, scale.origin), begin),
                                  idle ? (lane_float)1.0f : exact_divide(scale.metres, scale.along),
                                  depth - camera->near_plane};
    float one[5 * VXL_LANES];
    for (int i = 0; i < 5; ++i) LANES_STORE(values[i], one, i * VXL_LANES);
    uint step[VXL_LANES];
    LANES_STORE(step_of(steps, values[4]), step, 0);
    records[VXL_LAYER_STEP * count + n] = step[0];
    for (uint i = 0; i < 4; ++i)
        records[(VXL_LAYER_DEPTH + i) * count + n] = as_uint(one[i * VXL_LANES]);
}

/// Writes a record of VXL_LAYER_WORDS words, `count` apart, for every entry 0 .. count-1 of a layer
/// of surfaces. On entry, `seen` holds the light and the coverage of the rays' nodes before the
/// layer.
kernel void measure_layer(Camera camera, PyramidShape shape, DisplaySteps steps, uint is_first,
                          VXL_BATCH_PARAMETERS, uint count, VXL_NODE_PARAMETERS, uint first_ray,
                          global float* restrict seen, global uint* restrict records) {
    const uint n = work_item();
    if (n >= count) return;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const bool goes_on = VXL_TRANSMISSION && !is_first;
    const uint ray = goes_on ? paths[VXL_PATH_TARGET * stride + n] : n;
    const bool hit = hits[VXL_HIT_VOXEL * stride + n] != VXL_NO_VOXEL;
    const bool idle = rays[VXL_RAY_END * stride + n] < 0.0f;
    const LayerLight l = take_light(&nodes, ray, goes_on, hit, seen);
    write_depths(&camera, shape, &steps, &batch, n, count, goes_on, hit, records);
    records[VXL_LAYER_RAY * count + n] = first_ray + ray;
    records[VXL_LAYER_OBJECT * count + n] =
        hit && !idle ? (hit_attributes[n] & VXL_OBJECT_MASK) + 1u : 0u;
    records[VXL_LAYER_IN_MEDIUM * count + n] = !VXL_TRANSMISSION || inside[n] == 0u;
    const float opacity =
        l.clear < l.clear_before ? 1.0f - exact_quotient(l.clear, l.clear_before) : 0.0f;
    records[VXL_LAYER_OPACITY * count + n] = as_uint(l.clear > 0.0f ? opacity : 1.0f);
    for (uint c = 0; c < 3; ++c) {
        records[(VXL_LAYER_LIGHT + c) * count + n] = as_uint(l.light[c]);
        records[(VXL_LAYER_THROUGHPUT + c) * count + n] =
            VXL_TRANSMISSION ? paths[(VXL_PATH_THROUGHPUT + c) * stride + n] : as_uint(1.0f);
    }
}

/// The steps of one entry, `stride` values apart, each as density times metres. Where the medium's
/// colour varies, a plane for each channel follows: the light that a step adds if nothing covers
/// it.
typedef struct {
    global float* amounts;
    uint stride;
    size_t plane;
    float absorption[3];  // of the medium, per metre at density 1
    float color[3];       // of the cell whose amount is added
} StepSums;

/// The number in lane 0, where all lanes hold the same number.
static inline float lane_0_of(lane_float v) {
    float all[VXL_LANES];
    LANES_STORE(v, all, 0);
    return all[0];
}

/// Adds an amount of medium behind what step k already holds.
static inline void add_amount(const StepSums* sums, uint k, float amount) {
    global float* at = sums->amounts + (size_t)k * sums->stride;
    for (uint c = 0; VXL_MEDIUM_COLORS && c < 3; ++c) {
        const lane_float absorption = (lane_float)sums->absorption[c];
        const lane_float transmittance = exact_exp(-absorption * at[0]);
        const lane_float light = transmittance * exact_rise(absorption * amount) * sums->color[c];
        at[(c + 1u) * sums->plane] += lane_0_of(light);
    }
    at[0] += amount;
}

/// Distributes the medium between two depths beyond the near surface over the steps there.
static inline void add_to_steps(DisplaySteps steps, float from, float to, float amount,
                                const StepSums* sums) {
    const float maximum = (float)(steps.count - 1);
    const uint first = (uint)clamp(from * steps.inverse_step, 0.0f, maximum);
    const uint last = (uint)clamp(to * steps.inverse_step, 0.0f, maximum);
    if (first >= last) {
        add_amount(sums, first, amount);
        return;
    }
    const float share = exact_quotient(amount, to - from);
    for (uint k = first; k <= last; ++k) {
        const float begin = k == first ? from : (float)k * steps.step;
        const float end = k == last ? to : (float)(k + 1u) * steps.step;
        add_amount(sums, k, fmax(end - begin, 0.0f) * share);
    }
}

/// Sums density times metres in every step k of entries first_entry .. first_entry+count-1 of a
/// layer, in amounts[k * amount_stride + n]. On entry these are zero, as are the planes of light
/// that StepSums describes.
kernel void measure_density(Camera camera, PyramidShape shape, DisplaySteps steps,
                            VXL_SPACE_MEDIUM_PARAMETERS, uint is_first, VXL_BATCH_PARAMETERS,
                            uint first_entry, uint count, uint amount_stride,
                            global float* restrict amounts) {
    const uint lane_0 = work_item() * VXL_LANES, first = first_entry + lane_0;
    if (lane_0 >= count) return;
    const SpaceMedium medium = VXL_SPACE_MEDIUM;
    const RayBatch batch = VXL_BATCH;
    const PyramidView p = grid_view(shape);
    const Vector o = load_vector(batch.rays, batch.stride, first);
    const Vector d = load_vector(batch.rays + VXL_RAY_DX * batch.stride, batch.stride, first);
    const lane_float t_end = LANES_LOAD(batch.rays, VXL_RAY_END * batch.stride + first);
    const lane_int hit =
        LANE_MASK(LANES_LOAD(batch.hits, VXL_HIT_VOXEL * batch.stride + first) != VXL_NO_VOXEL);
    const lane_float t_hit =
        LANES_AS_FLOAT(LANES_LOAD(batch.hits, VXL_HIT_T * batch.stride + first));
    const lane_float t_last = LANES_SELECT(hit, t_hit, t_end);
    lane_float t_first = (lane_float)0.0f;
    lane_int walking = LANE_MASK(LANES_NUMBERS + (int)lane_0 < (int)count);
    if (VXL_TRANSMISSION) {
        if (!is_first) t_first = LANES_LOAD(batch.starts, first);
        walking &= LANE_MASK(LANES_LOAD(batch.inside, first) == 0u);
    }
    const DepthScale scale = depth_scale(&camera, shape.edge, o, d);
    Walk w = begin_walk(o.x, o.y, o.z, d.x, d.y, d.z);
    lane_float entered = t_first;
    StepSums sums;
    sums.stride = amount_stride;
    sums.plane = (size_t)amount_stride * steps.count;
    sums.absorption[0] = medium.environment.absorption.x;
    sums.absorption[1] = medium.environment.absorption.y;
    sums.absorption[2] = medium.environment.absorption.z;
    walking &= LANE_MASK(t_end >= 0.0f) & in_grid(&p, &w) & LANE_MASK(t_first < t_last);
    while (lanes_any(walking)) {
        const DensityCell cell = look_up_density(&medium.density, w.x, w.y, w.z, walking);
        leave_cells(&p, &medium.density, &w, cell.log2_size, walking);
        const lane_int counts = walking & LANE_MASK(w.t > t_first);
        const lane_int ends = LANE_MASK(w.t >= t_last);
        const lane_float left = LANES_SELECT(ends, t_last, w.t);
        float part[3 * VXL_LANES], color[3 * VXL_LANES];
        int adds[VXL_LANES];
        for (uint c = 0; VXL_MEDIUM_COLORS && c < 3; ++c)
            LANES_STORE(LANES_GATHER_FLOAT(medium.colors, cell.index * 3u + c), color,
                        c * VXL_LANES);
        LANES_STORE(cell.density * fmax(left - entered, 0.0f) * scale.metres, part, 0);
        LANES_STORE(fma(scale.along, entered, scale.origin), part, VXL_LANES);
        LANES_STORE(fma(scale.along, left, scale.origin), part, 2 * VXL_LANES);
        LANES_STORE(counts & LANE_MASK(cell.density > 0.0f), adds, 0);
        for (uint i = 0; i < VXL_LANES; ++i) {
            if (!adds[i]) continue;
            sums.amounts = amounts + lane_0 + i;
            for (uint c = 0; VXL_MEDIUM_COLORS && c < 3; ++c)
                sums.color[c] = color[c * VXL_LANES + i];
            add_to_steps(steps, part[VXL_LANES + i], part[2 * VXL_LANES + i], part[i], &sums);
        }
        entered = LANES_SELECT(counts, left, entered);
        walking &= ~ends & in_grid(&p, &w);
    }
}
