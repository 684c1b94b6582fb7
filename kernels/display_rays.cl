// lit sight rays -> P in the layout `rays`: the voxel of each surface, and those of the medium
// before it.
//
// Rays lie in the order of sight.cl, one sample a pixel. Space between a ray's way into the world
// and its end is cut into steps; the voxels of P are written by ascending place, u + width (v +
// height k).
#include "lib/lanes/exact_exp.h"
#include "lib/lanes/fixed_point.h"
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/traverse/density.h"
#include "shared/display.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

#define VXL_NO_STEP 0xFFFFFFFFu

// Less than this share of the light behind is not told from none.
#define VXL_MIN_TRANSMITTANCE 9.5367431640625e-7f

// Values of the array `spans`, `total` apart. Depths are metres beyond the near surface.
#define VXL_SPAN_FIRST 0  // where the ray is in the world
#define VXL_SPAN_END 1    // where it ends there, at a surface or not
#define VXL_SPAN_RATIO 2  // metres of the ray in a metre of depth
#define VXL_SPAN_COMPONENTS 3

/// How far a point, in voxels from E's `lead`, is away from there in metres: along Z_E, or along
/// the ray.
static inline lane_float depth_of(const Camera* camera, float4 edge, Vector from_eye) {
    const Vector metres = {from_eye.x * edge.x, from_eye.y * edge.y, from_eye.z * edge.z};
    if (camera->shape == VXL_SHAPE_SECTOR || camera->shape == VXL_SHAPE_BALL)
        return exact_sqrt(dot_product(metres, metres));
    // Z_E in voxels per metre, times the edge, is a unit vector.
    return fma(metres.x, camera->axis_z.x * edge.x,
               fma(metres.y, camera->axis_z.y * edge.y, metres.z * (camera->axis_z.z * edge.z)));
}

static inline Vector from_eye(const Camera* camera, Vector p) {
    const Vector result = {p.x - camera->origin.x - camera->origin_low.x,
                           p.y - camera->origin.y - camera->origin_low.y,
                           p.z - camera->origin.z - camera->origin_low.z};
    return result;
}

/// 1 - e^-x for x >= 0, with a small relative error near 0 as well.
static inline lane_float covered_part(lane_float x) {
    lane_float p = fma(x, 8.33333333e-3f, -4.16666667e-2f);
    p = fma(p, x, 1.66666667e-1f);
    p = fma(p, x, -0.5f);
    p = fma(p, x, 1.0f);
    return LANES_SELECT(LANE_MASK(x < 0.125f), x * p, 1.0f - exact_exp(-x));
}

/// The step that a depth beyond the near surface lies in.
static inline lane_uint step_of(const DisplaySteps* steps, lane_float depth) {
    const lane_int step = LANES_INT(fmax(depth, 0.0f) * steps->inverse_step);
    return LANES_AS_UINT(clamp(step, (lane_int)0, (lane_int)(steps->count - 1)));
}

/// Keeps of rays 0 .. count-1, which are the image's from `first_ray` on, what their voxels need:
/// the step of the surface met (VXL_NO_STEP: none), its depth in metres, and the span in the
/// medium.
kernel void measure_steps(Camera camera, PyramidShape shape, DisplaySteps steps,
                          global const float* restrict rays, global const uint* restrict hits,
                          global const float* restrict positions,
                          global const uint* restrict hit_attributes,
                          global const float* restrict radiance, uint count, uint stride,
                          uint first_ray, uint total, global uint* restrict hit_steps,
                          global float* restrict depths, global uint* restrict objects,
                          global float* restrict colors, global float* restrict spans) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const uint place = first_ray + first;
    const lane_int hit =
        LANE_MASK(LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first) != VXL_NO_VOXEL);
    const lane_float depth =
        depth_of(&camera, shape.edge, from_eye(&camera, load_vector(positions, stride, first)));
    const lane_uint step = step_of(&steps, depth - camera.near_plane);
    LANES_STORE(LANES_SELECT(hit, step, (lane_uint)VXL_NO_STEP), hit_steps, place);
    LANES_STORE(depth + camera.lead, depths, place);
    const lane_uint object = (LANES_LOAD(hit_attributes, first) & VXL_OBJECT_MASK) + 1u;
    LANES_STORE(object & LANES_AS_UINT(hit), objects, place);
    for (uint channel = 0; channel < 3; ++channel)
        LANES_STORE(LANES_LOAD(radiance, channel * stride + first), colors,
                    channel * total + place);
    if (!VXL_MEDIUM) return;

    const lane_float t_end = LANES_LOAD(rays, VXL_RAY_END * stride + first);
    lane_float t_first = (lane_float)0.0f, t_last = t_end;
    const Vector o = load_vector(rays, stride, first);
    const Vector d = load_vector(rays + VXL_RAY_DX * stride, stride, first);
    clip_to_world(o, d, shape.size_x, shape.size_y, shape.size_z, &t_first, &t_last);
    const lane_float t_hit = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    const lane_float t = fmax(LANES_SELECT(hit, t_hit, t_last), 0.0f);
    const lane_float metres = metres_per_t(shape.edge, d);
    lane_float along = metres;  // depth a unit of t
    if (camera.shape == VXL_SHAPE_PYRAMID || camera.shape == VXL_SHAPE_BOX)
        along = depth_of(&camera, shape.edge, d);
    const lane_float begin =
        depth_of(&camera, shape.edge, from_eye(&camera, o)) - camera.near_plane;
    const lane_float end = fma(along, t, begin);
    const lane_int seen = LANE_MASK(t_end >= 0.0f);
    LANES_STORE(begin, spans, VXL_SPAN_FIRST * total + place);
    LANES_STORE(LANES_SELECT(seen, end, begin), spans, VXL_SPAN_END * total + place);
    const lane_float ratio = exact_divide(metres, LANES_SELECT(seen, along, (lane_float)1.0f));
    LANES_STORE(ratio, spans, VXL_SPAN_RATIO * total + place);
}

/// Writes a record of VXL_LAYER_WORDS words, `count` apart, of every entry of a layer of surfaces,
/// 0 .. count-1. `seen` holds the light and the coverage of the rays' nodes before the layer.
kernel void measure_layer(Camera camera, PyramidShape shape, DisplaySteps steps, uint is_first,
                          global const float* restrict rays, global const uint* restrict paths,
                          global const float* restrict starts, global const uint* restrict inside,
                          global const uint* restrict hits, global const float* restrict positions,
                          global const uint* restrict hit_attributes, uint count, uint stride,
                          global const float* restrict nodes, global const float* restrict coverage,
                          uint node_stride, uint first_ray, global float* restrict seen,
                          global uint* restrict records) {
    const uint n = work_item();
    if (n >= count) return;
    const bool goes_on = VXL_TRANSMISSION && !is_first;
    const uint ray = goes_on ? paths[VXL_PATH_TARGET * stride + n] : n;
    const bool hit = hits[VXL_HIT_VOXEL * stride + n] != VXL_NO_VOXEL;
    float light[3];
    for (uint c = 0; c < 3; ++c) {
        const float before = goes_on ? seen[c * node_stride + ray] : 0.0f;
        light[c] = nodes[c * node_stride + ray] - before;
        if (VXL_TRANSMISSION) seen[c * node_stride + ray] = nodes[c * node_stride + ray];
    }
    const float clear_before = goes_on ? 1.0f - seen[3 * node_stride + ray] : 1.0f;
    const float clear = VXL_TRANSMISSION ? 1.0f - coverage[ray] : hit ? 0.0f : 1.0f;
    if (VXL_TRANSMISSION) seen[3 * node_stride + ray] = coverage[ray];

    // One ray in every lane: depths are those of the other kernels, bit by bit.
    const Vector o = {(lane_float)rays[VXL_RAY_OX * stride + n],
                      (lane_float)rays[VXL_RAY_OY * stride + n],
                      (lane_float)rays[VXL_RAY_OZ * stride + n]};
    const Vector d = {(lane_float)rays[VXL_RAY_DX * stride + n],
                      (lane_float)rays[VXL_RAY_DY * stride + n],
                      (lane_float)rays[VXL_RAY_DZ * stride + n]};
    const Vector at = {(lane_float)positions[n], (lane_float)positions[stride + n],
                       (lane_float)positions[2 * stride + n]};
    const float t_end = rays[VXL_RAY_END * stride + n];
    lane_float t_first = (lane_float)0.0f, t_last = (lane_float)t_end;
    clip_to_world(o, d, shape.size_x, shape.size_y, shape.size_z, &t_first, &t_last);
    const lane_float from = fmax(t_first, goes_on ? starts[n] : 0.0f);
    const lane_float to = hit ? (lane_float)as_float(hits[VXL_HIT_T * stride + n]) : t_last;
    const lane_float metres = metres_per_t(shape.edge, d);
    lane_float along = metres;
    if (camera.shape == VXL_SHAPE_PYRAMID || camera.shape == VXL_SHAPE_BOX)
        along = depth_of(&camera, shape.edge, d);
    const lane_float origin =
        depth_of(&camera, shape.edge, from_eye(&camera, o)) - camera.near_plane;
    const lane_float depth = depth_of(&camera, shape.edge, from_eye(&camera, at));
    const bool idle = t_end < 0.0f;
    const lane_float begin = fma(along, from, origin);
    const lane_float values[5] = {
        depth + camera.lead, begin, idle ? begin : fmax(fma(along, to, origin), begin),
        idle ? (lane_float)1.0f : exact_divide(metres, along), depth - camera.near_plane};
    float one[5 * VXL_LANES];
    for (int i = 0; i < 5; ++i) LANES_STORE(values[i], one, i * VXL_LANES);
    uint step[VXL_LANES];
    LANES_STORE(step_of(&steps, values[4]), step, 0);

    records[VXL_LAYER_RAY * count + n] = first_ray + ray;
    records[VXL_LAYER_OBJECT * count + n] =
        hit && !idle ? (hit_attributes[n] & VXL_OBJECT_MASK) + 1u : 0u;
    records[VXL_LAYER_STEP * count + n] = step[0];
    records[VXL_LAYER_IN_MEDIUM * count + n] = !VXL_TRANSMISSION || inside[n] == 0u;
    const float opacity = clear < clear_before ? 1.0f - clear / clear_before : 0.0f;
    records[VXL_LAYER_OPACITY * count + n] = as_uint(clear > 0.0f ? opacity : 1.0f);
    for (uint i = 0; i < 4; ++i)
        records[(VXL_LAYER_DEPTH + i) * count + n] = as_uint(one[i * VXL_LANES]);
    for (uint c = 0; c < 3; ++c) {
        records[(VXL_LAYER_LIGHT + c) * count + n] = as_uint(light[c]);
        records[(VXL_LAYER_THROUGHPUT + c) * count + n] =
            VXL_TRANSMISSION ? paths[(VXL_PATH_THROUGHPUT + c) * stride + n] : as_uint(1.0f);
    }
}

/// Adds what lies between two depths beyond the near surface to the steps there.
static inline void add_to_steps(DisplaySteps steps, float from, float to, float amount,
                                global float* amounts, uint stride) {
    const float maximum = (float)(steps.count - 1);
    const uint first = (uint)clamp(from * steps.inverse_step, 0.0f, maximum);
    const uint last = (uint)clamp(to * steps.inverse_step, 0.0f, maximum);
    if (first >= last) {
        amounts[(size_t)first * stride] += amount;
        return;
    }
    const float share = amount / (to - from);
    for (uint k = first; k <= last; ++k) {
        const float begin = k == first ? from : (float)k * steps.step;
        const float end = k == last ? to : (float)(k + 1u) * steps.step;
        amounts[(size_t)k * stride] += fmax(end - begin, 0.0f) * share;
    }
}

/// Sums density times metres in every step k of entries first_entry .. first_entry+count-1 of a
/// layer: amounts[k * amount_stride + n], which are zero before.
kernel void measure_density(Camera camera, PyramidShape shape, DisplaySteps steps,
                            DensityShape density_shape, global const uint* restrict density_bricks,
                            global const float* restrict density_values, uint is_first,
                            global const float* restrict rays, global const float* restrict starts,
                            global const uint* restrict inside, global const uint* restrict hits,
                            uint first_entry, uint count, uint stride, uint amount_stride,
                            global float* restrict amounts) {
    const uint lane_0 = work_item() * VXL_LANES, first = first_entry + lane_0;
    if (lane_0 >= count) return;
    const DensityView density = {density_shape, density_bricks, density_values};
    const PyramidView p = grid_view(shape);
    const Vector o = load_vector(rays, stride, first);
    const Vector d = load_vector(rays + VXL_RAY_DX * stride, stride, first);
    const lane_float t_end = LANES_LOAD(rays, VXL_RAY_END * stride + first);
    const lane_int hit =
        LANE_MASK(LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first) != VXL_NO_VOXEL);
    const lane_float t_hit = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    const lane_float t_last = LANES_SELECT(hit, t_hit, t_end);
    lane_float t_first = (lane_float)0.0f;
    lane_int walking = LANE_MASK(LANES_NUMBERS + (int)lane_0 < (int)count);
    if (VXL_TRANSMISSION) {
        if (!is_first) t_first = LANES_LOAD(starts, first);
        walking &= LANE_MASK(LANES_LOAD(inside, first) == 0u);
    }
    const lane_float metres = metres_per_t(shape.edge, d);
    lane_float along = metres;
    if (camera.shape == VXL_SHAPE_PYRAMID || camera.shape == VXL_SHAPE_BOX)
        along = depth_of(&camera, shape.edge, d);
    const lane_float origin =
        depth_of(&camera, shape.edge, from_eye(&camera, o)) - camera.near_plane;
    Walk w = begin_walk(o.x, o.y, o.z, d.x, d.y, d.z);
    lane_float entered = t_first;
    walking &= LANE_MASK(t_end >= 0.0f) & in_grid(&p, &w) & LANE_MASK(t_first < t_last);
    while (lanes_any(walking)) {
        const DensityCell cell = look_up_density(&density, w.x, w.y, w.z, walking);
        leave_cells(&p, &density, &w, cell.log2_size, walking);
        const lane_int counts = walking & LANE_MASK(w.t > t_first);
        const lane_int ends = LANE_MASK(w.t >= t_last);
        const lane_float left = LANES_SELECT(ends, t_last, w.t);
        float part[3 * VXL_LANES];
        int adds[VXL_LANES];
        LANES_STORE(cell.density * fmax(left - entered, 0.0f) * metres, part, 0);
        LANES_STORE(fma(along, entered, origin), part, VXL_LANES);
        LANES_STORE(fma(along, left, origin), part, 2 * VXL_LANES);
        LANES_STORE(counts & LANE_MASK(cell.density > 0.0f), adds, 0);
        for (uint i = 0; i < VXL_LANES; ++i)
            if (adds[i])
                add_to_steps(steps, part[VXL_LANES + i], part[2 * VXL_LANES + i], part[i],
                             amounts + lane_0 + i, amount_stride);
        entered = LANES_SELECT(counts, left, entered);
        walking &= ~ends & in_grid(&p, &w);
    }
}

/// The place of pixel (u, v)'s ray in the order of sight.cl.
static inline uint ray_of_pixel(uint u, uint v, uint width) {
    const uint tile = v / 4u * ((width + 3u) / 4u) + u / 4u;
    return tile * 16u + (v & 3u) * 4u + (u & 3u);
}

/// Steps first .. end-1 of a ray hold space that shows, the step `hit` a surface.
typedef struct {
    uint first, end, hit;
} RaySteps;

static inline RaySteps steps_of_ray(DisplaySteps steps, global const uint* hit_steps,
                                    global const float* spans, uint total, uint ray) {
    RaySteps s = {0, 0, hit_steps[ray]};
    if (!VXL_MEDIUM) return s;
    const float begin = spans[VXL_SPAN_FIRST * total + ray];
    const float end = spans[VXL_SPAN_END * total + ray];
    if (!(begin < end) || steps.absorption == 0.0f) return s;
    const float maximum = (float)(steps.count - 1);
    s.first = (uint)clamp(begin * steps.inverse_step, 0.0f, maximum);
    s.end =
        s.hit != VXL_NO_STEP ? s.hit : (uint)clamp(end * steps.inverse_step, 0.0f, maximum) + 1u;
    return s;
}

/// Counts the voxels of row v in every layer k: counts[v + height k]. One work-item a row.
kernel void count_voxels(uint width, uint height, DisplaySteps steps,
                         global const uint* restrict hit_steps, global const float* restrict spans,
                         uint total, global uint* restrict counts) {
    const uint v = work_item();
    if (v >= height) return;
    for (uint u = 0; u < width; ++u) {
        const RaySteps s = steps_of_ray(steps, hit_steps, spans, total, ray_of_pixel(u, v, width));
        for (uint k = s.first; k < s.end; ++k) ++counts[v + (size_t)height * k];
        if (s.hit != VXL_NO_STEP) ++counts[v + (size_t)height * s.hit];
    }
}

/// Writes the places of row v's voxels from starts[v + height k] on, which move, and to `sources`
/// the ray of each.
kernel void place_voxels(uint width, uint height, DisplaySteps steps,
                         global const uint* restrict hit_steps, global const float* restrict spans,
                         uint total, global uint* restrict starts, global ulong* restrict indices,
                         global uint* restrict sources) {
    const uint v = work_item();
    if (v >= height) return;
    for (uint u = 0; u < width; ++u) {
        const uint ray = ray_of_pixel(u, v, width);
        const RaySteps s = steps_of_ray(steps, hit_steps, spans, total, ray);
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

/// Gives voxels 0 .. count-1 their colours (three each, one after another), opacities, depths and
/// objects; `objects` holds the ray of each before.
///
/// A voxel of space adds color (1 - exp(-absorption x)) over its x metres of medium. Its opacity
/// passes on what the least absorbed channel keeps; the rest that other channels lose is taken from
/// the colours behind. A surface's radiance came through all of the medium: what the voxels before
/// it add is subtracted again, and what they cover given back.
kernel void fill_voxels(uint width, uint height, DisplaySteps steps, float near_depth,
                        Environment environment, global const ulong* restrict indices,
                        global const uint* restrict hit_steps,
                        global const float* restrict ray_depths,
                        global const uint* restrict ray_objects,
                        global const float* restrict ray_colors, global const float* restrict spans,
                        uint total, uint count, global float* restrict colors,
                        global float* restrict opacities, global float* restrict depths,
                        global uint* restrict objects) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_int there = LANE_MASK(LANES_NUMBERS + (int)first < (int)count);
    uint layer[VXL_LANES];
    for (uint i = 0; i < VXL_LANES; ++i)
        layer[i] = first + i < count ? (uint)(indices[first + i] / ((ulong)width * height)) : 0;
    const lane_uint k = LANES_LOAD(layer, 0);
    const lane_uint ray = LANES_LOAD(objects, first) & LANES_AS_UINT(there);
    const lane_int is_object = LANE_MASK(LANES_GATHER_UINT(hit_steps, ray) == k);
    lane_float depth = LANES_GATHER_FLOAT(ray_depths, ray);
    lane_float opacity = (lane_float)1.0f, before = (lane_float)0.0f, inside = (lane_float)0.0f;
    lane_float throughput = (lane_float)1.0f;  // by the opacities of the voxels before
    if (VXL_MEDIUM) {
        const lane_float begin = LANES_GATHER_FLOAT(spans, ray + VXL_SPAN_FIRST * total);
        const lane_float end = LANES_GATHER_FLOAT(spans, ray + VXL_SPAN_END * total);
        const lane_float ratio = LANES_GATHER_FLOAT(spans, ray + VXL_SPAN_RATIO * total);
        const lane_float from = fmax(LANES_FLOAT(k) * steps.step, begin);
        const lane_float to = fmin((LANES_FLOAT(k) + 1.0f) * steps.step, end);
        before = fmax(from - begin, 0.0f) * ratio;
        inside = fmax(to - from, 0.0f) * ratio;
        throughput = fmax(exact_exp(-steps.absorption * before), VXL_MIN_TRANSMITTANCE);
        opacity = LANES_SELECT(is_object, opacity, covered_part(steps.absorption * inside));
        const lane_float middle = fma(LANES_FLOAT(k) + 0.5f, steps.step, near_depth);
        depth = LANES_SELECT(is_object, depth, middle);
    }
    const float absorption[3] = {environment.absorption.x, environment.absorption.y,
                                 environment.absorption.z};
    const float color[3] = {environment.color.x, environment.color.y, environment.color.z};
    float shown[3 * VXL_LANES];
    for (uint channel = 0; channel < 3; ++channel) {
        lane_float value = LANES_GATHER_FLOAT(ray_colors, ray + channel * total);
        if (VXL_MEDIUM) {
            const lane_float kept = exact_exp(-absorption[channel] * before);
            const lane_float added =
                color[channel] * covered_part(absorption[channel] * inside) * kept;
            const lane_float of_surface =
                fma(-color[channel], covered_part(absorption[channel] * before), value);
            const lane_float part = LANES_SELECT(is_object, of_surface, added);
            const lane_float share = fmax(throughput * opacity, 1.17549435e-38f);
            value = fmax(exact_divide(part, share), 0.0f);
        }
        LANES_STORE(value, shown, channel * VXL_LANES);
    }
    float result[VXL_LANES];
    LANES_STORE(opacity, result, 0);
    for (uint i = 0; i < VXL_LANES && first + i < count; ++i) opacities[first + i] = result[i];
    LANES_STORE(depth, result, 0);
    for (uint i = 0; i < VXL_LANES && first + i < count; ++i) depths[first + i] = result[i];
    const lane_uint object = LANES_GATHER_UINT(ray_objects, ray) & LANES_AS_UINT(is_object);
    uint number[VXL_LANES];
    LANES_STORE(object, number, 0);
    for (uint i = 0; i < VXL_LANES && first + i < count; ++i) {
        objects[first + i] = number[i];
        for (uint channel = 0; channel < 3; ++channel)
            colors[3 * (size_t)(first + i) + channel] = shown[channel * VXL_LANES + i];
    }
}
