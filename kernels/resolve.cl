// SPDX-License-Identifier: Apache-2.0
// samples -> pixels: the mean of a pixel's samples, and the geometry of its first sample that hit.
//
// The build constants VXL_SHOWS_COLOR, VXL_SHOWS_VARIANCE, VXL_SHOWS_DEPTH, VXL_SHOWS_DISTANCE,
// VXL_SHOWS_POSITION, VXL_SHOWS_NORMAL, VXL_SHOWS_OBJECT and VXL_SHOWS_MATERIAL, which this file
// has in addition to those of features, say which channels are asked for. With VXL_EARLIER the
// image already holds earlier samples: their sums or, in an image that was finished, the means of a
// power of two of them, from which sums follow without rounding. The result equals that of one run
// over all samples. If more samples follow, the image becomes the sums, and the variance the sum of
// squared deviations.
#include "lib/lanes/exact_float.h"
#include "lib/lanes/lanes.h"
#include "lib/lanes/work_item.h"
#include "lib/traverse/display_shape.h"
#include "lib/traverse/ray_batch.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

// The indices of the first planes of what an image shows.
#define VXL_PLANE_VARIANCE (4 * VXL_SHOWS_COLOR)
#define VXL_PLANE_DEPTH (VXL_PLANE_VARIANCE + 3 * VXL_SHOWS_VARIANCE)
#define VXL_PLANE_DISTANCE (VXL_PLANE_DEPTH + VXL_SHOWS_DEPTH)
#define VXL_PLANE_POSITION (VXL_PLANE_DISTANCE + VXL_SHOWS_DISTANCE)
#define VXL_PLANE_NORMAL (VXL_PLANE_POSITION + 3 * VXL_SHOWS_POSITION)

/// The pixels of a packet: some or all of a tile of 4 x 4.
typedef struct {
    size_t index[VXL_LANES];
    bool is_in_image[VXL_LANES];
    bool is_whole;   // all are in the image; each four lanes are a row of the tile
    lane_int known;  // mask: pixels that show something that earlier samples met
} Pixels;

static inline Pixels pixels_of(const Camera* camera, uint tile, uint first) {
    const uint tiles_x = ((uint)camera->width + 3u) / 4u;
    Pixels p;
    p.is_whole = VXL_LANES > 1;
    p.known = (lane_int)0;
    for (uint i = 0; i < VXL_LANES; ++i) {
        const uint column = tile % tiles_x * 4u + ((first + i) & 3u);
        const uint row = tile / tiles_x * 4u + ((first + i) >> 2);
        p.is_in_image[i] = column < (uint)camera->width && row < (uint)camera->height;
        p.index[i] = row * (size_t)camera->width + column;
        p.is_whole &= p.is_in_image[i];
    }
    return p;
}

static inline void store_pixels(lane_float value, const Pixels* p, global float* restrict plane) {
    float values[VXL_LANES];
    LANES_STORE(value, values, 0);
    if (p->is_whole) {
        for (uint i = 0; i + 4 <= VXL_LANES; i += 4)
            vstore4(vload4(0, values + i), 0, plane + p->index[i]);
        return;
    }
    for (uint i = 0; i < VXL_LANES; ++i)
        if (p->is_in_image[i]) plane[p->index[i]] = values[i];
}

/// The values of a plane; 0 outside the image.
static inline lane_float load_pixels(const Pixels* p, global const float* plane) {
    float values[VXL_LANES];
    for (uint i = 0; i < VXL_LANES; ++i) values[i] = p->is_in_image[i] ? plane[p->index[i]] : 0.0f;
    return LANES_LOAD(values, 0);
}

/// Stores values of pixels to which earlier samples gave none.
static inline void store_shown(lane_float value, const Pixels* p, global float* plane) {
    if (VXL_EARLIER) value = LANES_SELECT(p->known, load_pixels(p, plane), value);
    store_pixels(value, p, plane);
}

/// Mask: pixels whose value in a plane is neither 0 nor infinity, and thus shows something.
static inline lane_int shown_in(const Pixels* p, global const float* plane) {
    const lane_uint value = LANES_AS_UINT(load_pixels(p, plane)) & 0x7FFFFFFFu;
    return LANE_MASK(value != 0u) & LANE_MASK(value != 0x7F800000u);
}

/// Mask: pixels that show something already. A position alone cannot tell, because it may be the
/// origin.
static inline lane_int shown_already(const Pixels* p, size_t pixels, global const float* image,
                                     global const uint* ids) {
    lane_int shown = (lane_int)0;
    if (VXL_SHOWS_DEPTH) shown |= shown_in(p, image + VXL_PLANE_DEPTH * pixels);
    if (VXL_SHOWS_DISTANCE) shown |= shown_in(p, image + VXL_PLANE_DISTANCE * pixels);
    for (uint a = 0; VXL_SHOWS_NORMAL && a < 3; ++a)
        shown |= shown_in(p, image + (VXL_PLANE_NORMAL + a) * pixels);
    if (VXL_SHOWS_OBJECT || VXL_SHOWS_MATERIAL) shown |= shown_in(p, (global const float*)ids);
    return shown;
}

/// The sums over the samples of a packet's pixels.
typedef struct {
    lane_float color[3];
    lane_float covered;
    lane_uint shown;  // the first sample's ray that met something, or VXL_NO_VOXEL
} Samples;

/// The sums of the earlier samples, which the image holds.
static inline Samples earlier_samples(const Camera* camera, const Pixels* at, size_t pixels,
                                      global const float* image) {
    const lane_float zero = (lane_float)0.0f;
    Samples s = {{zero, zero, zero}, zero, (lane_uint)VXL_NO_VOXEL};
    if (!VXL_EARLIER) return s;
    if (!VXL_SHOWS_COLOR) return s;
    const float weight = camera->earlier_weight;
    for (uint channel = 0; channel < 3; ++channel)
        s.color[channel] = load_pixels(at, image + channel * pixels) * weight;
    s.covered = load_pixels(at, image + 3 * pixels) * weight;
    return s;
}

/// Adds samples to the sums `before`. `samples` is the number per pixel, `first_ray` the ray of the
/// first.
static inline Samples sum_samples(const RayBatch* batch, uint first_ray, uint samples,
                                  Samples before) {
    Samples s = before;
    for (uint sample = 0; sample < samples; ++sample) {
        const uint ray = first_ray + sample * 16u;
        if (VXL_SHOWS_COLOR) {
            for (uint channel = 0; channel < 3; ++channel)
                s.color[channel] += LANES_LOAD(batch->radiance, channel * batch->stride + ray);
            if (VXL_TRANSMISSION) s.covered += LANES_LOAD(batch->coverage, ray);
        }
        const lane_int hit =
            LANE_MASK(LANES_LOAD(batch->hits, VXL_HIT_VOXEL * batch->stride + ray) != VXL_NO_VOXEL);
        if (!VXL_TRANSMISSION) s.covered = LANES_SELECT(hit, s.covered + 1.0f, s.covered);
        s.shown = LANES_SELECT(hit & LANE_MASK(s.shown == VXL_NO_VOXEL),
                               LANES_AS_UINT(LANES_NUMBERS + (int)ray), s.shown);
    }
    return s;
}

/// Stores a channel of the image. Values that are not finite are counted and stored as 0.
static inline void store_color(lane_float value, const Pixels* at, global float* restrict plane,
                               global uint* restrict not_finite) {
    const lane_int finite = LANE_MASK(fabs(value) < INFINITY);
    int is_finite[VXL_LANES];
    LANES_STORE(finite, is_finite, 0);
    for (uint i = 0; i < VXL_LANES; ++i)
        if (at->is_in_image[i] && !is_finite[i]) atomic_inc(not_finite);
    store_pixels(LANES_SELECT(finite, value, (lane_float)0.0f), at, plane);
}

/// The sum of the squares of the deviations of the samples of a channel from their `mean`.
static inline lane_float squares_from(const RayBatch* batch, uint first_ray, uint samples,
                                      uint channel, lane_float mean) {
    lane_float squares = (lane_float)0.0f;
    for (uint sample = 0; sample < samples; ++sample) {
        const uint ray = first_ray + sample * 16u;
        const lane_float off = LANES_LOAD(batch->radiance, channel * batch->stride + ray) - mean;
        squares = fma(off, off, squares);
    }
    return squares;
}

/// The sum of the squared deviations of all samples from their mean. `sum` is the sum of all
/// samples. `before` is the sum of squared deviations of the earlier samples; `own` and
/// `own_squares` are the sum and the sum of squared deviations of the new ones.
///
/// Source: Chan, Golub, LeVeque: "Updating Formulae and a Pairwise Algorithm for Computing Sample
/// Variances", 1979.
static inline lane_float joined_squares(const Camera* camera, lane_float before, lane_float sum,
                                        lane_float own, lane_float own_squares) {
    const float m = (float)camera->earlier_samples, n = (float)camera->samples;
    if (m == 0.0f) return own_squares;
    const lane_float off =
        exact_divide(own, (lane_float)n) - exact_divide(sum - own, (lane_float)m);
    const lane_float weight = exact_divide((lane_float)(m * n), (lane_float)(m + n));
    return before + fma(off * off, weight, own_squares);
}

/// Stores the variance of the mean of a channel's samples, as if these were independent: the mean
/// square of their deviations, divided by the number of samples less one. One sample leaves it
/// unknown, which is stored as infinity; otherwise it is finite. `sum` is the sum of all samples.
static inline void store_variance(const Camera* camera, const RayBatch* batch, uint first_ray,
                                  uint channel, lane_float sum, const Pixels* at, size_t pixels,
                                  global float* restrict image) {
    global float* const plane = image + (VXL_PLANE_VARIANCE + channel) * pixels;
    const uint samples = (uint)camera->samples;
    uint all = samples;
    lane_float value;
    if (VXL_EARLIER) {
        lane_float own = (lane_float)0.0f;
        for (uint sample = 0; sample < samples; ++sample)
            own += LANES_LOAD(batch->radiance, channel * batch->stride + first_ray + sample * 16u);
        const lane_float mean = exact_divide(own, (lane_float)(float)samples);
        value = joined_squares(camera, load_pixels(at, plane), sum, own,
                               squares_from(batch, first_ray, samples, channel, mean));
        all += (uint)camera->earlier_samples;
    } else {
        value = squares_from(batch, first_ray, samples, channel, sum * camera->sample_weight);
    }
    if (camera->is_last) {
        const float pairs = (float)all * (float)(all - 1u);
        value = all > 1u ? fmin(exact_divide(value, (lane_float)pairs), (lane_float)FLT_MAX)
                         : (lane_float)INFINITY;
    }
    store_pixels(value, at, plane);
}

/// The distances of points along their sight rays, in metres. `depth` is the distance along Z_E,
/// and `square` the square of the distance from E.
static inline lane_float distance_of(const Camera* camera, lane_float depth, lane_float square) {
    return camera->shape == VXL_SHAPE_BOX ? depth : exact_sqrt(square);
}

/// Stores depth, distance, position and normal for the rays of the `hit` pixels. The normal is the
/// one used for their light.
static inline void store_geometry(const Camera* camera, float4 voxel_edge, float4 world_origin,
                                  const RayBatch* batch, lane_uint ray, lane_int hit,
                                  const Pixels* at, size_t pixels, global float* restrict image) {
    const float edge[3] = {voxel_edge.x, voxel_edge.y, voxel_edge.z};
    const float origin[3] = {world_origin.x, world_origin.y, world_origin.z};
    const float eye[3] = {camera->origin.x, camera->origin.y, camera->origin.z};
    const float eye_low[3] = {camera->origin_low.x, camera->origin_low.y, camera->origin_low.z};
    // Z_E in voxels per metre. Multiplied by the edge twice, it measures voxels along Z_E in
    // metres.
    const float ahead[3] = {camera->axis_z.x, camera->axis_z.y, camera->axis_z.z};
    global const float* normals = VXL_SHADING_NORMALS ? batch->shading : batch->normals;
    const lane_float nothing = (lane_float)0.0f;
    lane_float depth = (lane_float)camera->lead, square = nothing;
    for (uint a = 0; a < 3; ++a) {
        lane_float p = nothing;
        if (VXL_SHOWS_DEPTH || VXL_SHOWS_DISTANCE || VXL_SHOWS_POSITION)
            p = LANES_GATHER_FLOAT(batch->positions + a * batch->stride, ray);
        const lane_float from_eye = (p - eye[a] - eye_low[a]) * edge[a];
        const float along = ahead[a] * edge[a];
        depth = fma(from_eye, (lane_float)along, depth);
        const lane_float from_observer = fma((lane_float)along, (lane_float)camera->lead, from_eye);
        square = fma(from_observer, from_observer, square);
        if (VXL_SHOWS_POSITION)
            store_shown(
                LANES_SELECT(hit, fma(p, (lane_float)edge[a], (lane_float)origin[a]), nothing), at,
                image + (VXL_PLANE_POSITION + a) * pixels);
        if (VXL_SHOWS_NORMAL)
            store_shown(
                LANES_SELECT(hit, LANES_GATHER_FLOAT(normals + a * batch->stride, ray), nothing),
                at, image + (VXL_PLANE_NORMAL + a) * pixels);
    }
    const lane_float distance = distance_of(camera, depth, square);
    if (VXL_SHOWS_DEPTH)
        store_shown(LANES_SELECT(hit, looks_ahead(camera) ? depth : distance, (lane_float)INFINITY),
                    at, image + VXL_PLANE_DEPTH * pixels);
    if (VXL_SHOWS_DISTANCE)
        store_shown(LANES_SELECT(hit, distance, (lane_float)INFINITY), at,
                    image + VXL_PLANE_DISTANCE * pixels);
}

/// Stores the numbers of what the `hit` pixels show, from 1 on, and 0 for other pixels.
static inline void store_number(lane_uint number, lane_int hit, const Pixels* at,
                                global uint* restrict plane) {
    store_shown(LANES_AS_FLOAT(LANES_SELECT(hit, number + 1u, (lane_uint)0)), at,
                (global float*)plane);
}

/// One work-item makes VXL_LANES pixels. `image` holds the planes that are asked for, `pixels`
/// values apart, in this order: R G B A variance.R variance.G variance.B Z distance P.X P.Y P.Z N.X
/// N.Y N.Z. `ids` holds, likewise, the number of the object plus 1 and the number of the material
/// plus 1, and 0 for none.
kernel void resolve_pixels(Camera camera, PyramidShape shape, float4 world_origin,
                           VXL_BATCH_PARAMETERS, uint first_tile, uint tile_count,
                           global float* restrict image, global uint* restrict ids,
                           global uint* restrict not_finite) {
    const uint item = work_item() * VXL_LANES;
    if (item >= tile_count * 16u) return;
    const RayBatch batch = VXL_BATCH;
    Pixels at = pixels_of(&camera, first_tile + item / 16u, item % 16u);
    const size_t pixels = (size_t)camera.width * (size_t)camera.height;
    if (VXL_EARLIER) at.known = shown_already(&at, pixels, image, ids);
    const uint first_ray = item / 16u * (uint)camera.samples * 16u + item % 16u;
    const Samples s = sum_samples(&batch, first_ray, (uint)camera.samples,
                                  earlier_samples(&camera, &at, pixels, image));
    const float sample_weight = camera.sample_weight;
    for (uint channel = 0; VXL_SHOWS_COLOR && channel < 3; ++channel) {
        store_color(s.color[channel] * sample_weight, &at, image + channel * pixels, not_finite);
        if (VXL_SHOWS_VARIANCE)
            store_variance(&camera, &batch, first_ray, channel, s.color[channel], &at, pixels,
                           image);
    }
    if (VXL_SHOWS_COLOR) store_pixels(s.covered * sample_weight, &at, image + 3 * pixels);
    const lane_int hit = LANE_MASK(s.shown != VXL_NO_VOXEL);
    // A pixel keeps what it already shows. A pixel that still shows nothing keeps that, too.
    if (VXL_EARLIER && camera.earlier_samples > 0 && !lanes_any(hit & ~at.known)) return;
    const lane_uint ray = s.shown & LANES_AS_UINT(hit);
    store_geometry(&camera, shape.edge, world_origin, &batch, ray, hit, &at, pixels, image);
    if (VXL_SHOWS_OBJECT || VXL_SHOWS_MATERIAL) {
        const lane_uint packed = LANES_GATHER_UINT(hit_attributes, ray);
        if (VXL_SHOWS_OBJECT) store_number(packed & VXL_OBJECT_MASK, hit, &at, ids);
        if (VXL_SHOWS_MATERIAL)
            store_number((packed >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK, hit, &at,
                         ids + VXL_SHOWS_OBJECT * pixels);
    }
}
