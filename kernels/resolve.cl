// SPDX-License-Identifier: Apache-2.0
// samples -> pixels: the mean of a pixel's samples, and the geometry of its first sample that hit.
//
// The build constants VXL_SHOWS_COLOR, VXL_SHOWS_DEPTH, VXL_SHOWS_DISTANCE, VXL_SHOWS_POSITION,
// VXL_SHOWS_NORMAL, VXL_SHOWS_OBJECT and VXL_SHOWS_MATERIAL, in addition to the features', are the
// channels asked for.
#include "lib/lanes/exact_float.h"
#include "lib/lanes/lanes.h"
#include "lib/lanes/work_item.h"
#include "lib/traverse/display_shape.h"
#include "lib/traverse/ray_batch.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

/// The pixels of a packet: some or all of a tile of 4 x 4.
typedef struct {
    size_t place[VXL_LANES];
    bool is_in_image[VXL_LANES];
    bool is_whole;  // all are in the image, and each row begins at every fourth of them
} Pixels;

static inline Pixels pixels_of(const Camera* camera, uint tile, uint first) {
    const uint tiles_x = ((uint)camera->width + 3u) / 4u;
    Pixels p;
    p.is_whole = VXL_LANES > 1;
    for (uint i = 0; i < VXL_LANES; ++i) {
        const uint column = tile % tiles_x * 4u + ((first + i) & 3u);
        const uint row = tile / tiles_x * 4u + ((first + i) >> 2);
        p.is_in_image[i] = column < (uint)camera->width && row < (uint)camera->height;
        p.place[i] = row * (size_t)camera->width + column;
        p.is_whole &= p.is_in_image[i];
    }
    return p;
}

static inline void store_pixels(lane_float value, const Pixels* p, global float* restrict plane) {
    float values[VXL_LANES];
    LANES_STORE(value, values, 0);
    if (p->is_whole) {
        for (uint i = 0; i + 4 <= VXL_LANES; i += 4)
            vstore4(vload4(0, values + i), 0, plane + p->place[i]);
        return;
    }
    for (uint i = 0; i < VXL_LANES; ++i)
        if (p->is_in_image[i]) plane[p->place[i]] = values[i];
}

/// The samples of a packet's pixels, summed.
typedef struct {
    lane_float color[3];
    lane_float covered;
    lane_uint shown;  // the first sample's ray that met something, VXL_NO_VOXEL for none
} Samples;

/// Adds up the `samples` samples of pixels whose first one's ray is `first_ray`.
static inline Samples sum_samples(const RayBatch* batch, uint first_ray, uint samples) {
    const lane_float zero = (lane_float)0.0f;
    Samples s = {{zero, zero, zero}, zero, (lane_uint)VXL_NO_VOXEL};
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

/// Stores the mean of a channel's samples. Values that are not finite are counted and stored as 0.
static inline void store_color(lane_float value, const Pixels* at, global float* restrict plane,
                               global uint* restrict not_finite) {
    const lane_int finite = LANE_MASK(fabs(value) < INFINITY);
    int is_finite[VXL_LANES];
    LANES_STORE(finite, is_finite, 0);
    for (uint i = 0; i < VXL_LANES; ++i)
        if (at->is_in_image[i] && !is_finite[i]) atomic_inc(not_finite);
    store_pixels(LANES_SELECT(finite, value, (lane_float)0.0f), at, plane);
}

/// The distances of points in metres along their sight rays. `depth` is that along Z_E, and
/// `square` the square of the distance from E.
static inline lane_float distance_of(const Camera* camera, lane_float depth, lane_float square) {
    return camera->shape == VXL_SHAPE_BOX ? depth : exact_sqrt(square);
}

/// Stores depth, distance, position and normal of the `hit` pixels' rays; the normal is that of
/// their light.
static inline void store_geometry(const Camera* camera, float4 voxel_edge, float4 world_origin,
                                  const RayBatch* batch, lane_uint ray, lane_int hit,
                                  const Pixels* at, size_t pixels, global float* restrict image) {
    const float edge[3] = {voxel_edge.x, voxel_edge.y, voxel_edge.z};
    const float origin[3] = {world_origin.x, world_origin.y, world_origin.z};
    const uint depth_plane = 4 * VXL_SHOWS_COLOR;
    const uint distance_plane = depth_plane + VXL_SHOWS_DEPTH;
    const uint position_plane = distance_plane + VXL_SHOWS_DISTANCE;
    const uint normal_plane = position_plane + 3 * VXL_SHOWS_POSITION;
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
            store_pixels(
                LANES_SELECT(hit, fma(p, (lane_float)edge[a], (lane_float)origin[a]), nothing), at,
                image + (position_plane + a) * pixels);
        if (VXL_SHOWS_NORMAL)
            store_pixels(
                LANES_SELECT(hit, LANES_GATHER_FLOAT(normals + a * batch->stride, ray), nothing),
                at, image + (normal_plane + a) * pixels);
    }
    const lane_float distance = distance_of(camera, depth, square);
    if (VXL_SHOWS_DEPTH)
        store_pixels(
            LANES_SELECT(hit, looks_ahead(camera) ? depth : distance, (lane_float)INFINITY), at,
            image + depth_plane * pixels);
    if (VXL_SHOWS_DISTANCE)
        store_pixels(LANES_SELECT(hit, distance, (lane_float)INFINITY), at,
                     image + distance_plane * pixels);
}

/// Stores the numbers of what the `hit` pixels show, from 1 on, and 0 for others.
static inline void store_number(lane_uint number, lane_int hit, const Pixels* at,
                                global uint* restrict plane) {
    store_pixels(LANES_AS_FLOAT(LANES_SELECT(hit, number + 1u, (lane_uint)0)), at,
                 (global float*)plane);
}

/// One work-item makes VXL_LANES pixels. `image` holds those of the planes R G B A Z distance
/// P.X P.Y P.Z N.X N.Y N.Z that are asked for, `pixels` apart; `ids` holds the numbers of the
/// object and the material plus 1, likewise, 0 for none.
kernel void resolve_pixels(Camera camera, PyramidShape shape, float4 world_origin,
                           VXL_BATCH_PARAMETERS, uint first_tile, uint tile_count,
                           global float* restrict image, global uint* restrict ids,
                           global uint* restrict not_finite) {
    const uint item = work_item() * VXL_LANES;
    if (item >= tile_count * 16u) return;
    const RayBatch batch = VXL_BATCH;
    const Pixels at = pixels_of(&camera, first_tile + item / 16u, item % 16u);
    const size_t pixels = (size_t)camera.width * (size_t)camera.height;
    const uint first_ray = item / 16u * (uint)camera.samples * 16u + item % 16u;
    const Samples s = sum_samples(&batch, first_ray, (uint)camera.samples);
    const float sample_weight = camera.sample_weight;
    for (uint channel = 0; VXL_SHOWS_COLOR && channel < 3; ++channel)
        store_color(s.color[channel] * sample_weight, &at, image + channel * pixels, not_finite);
    if (VXL_SHOWS_COLOR) store_pixels(s.covered * sample_weight, &at, image + 3 * pixels);
    const lane_int hit = LANE_MASK(s.shown != VXL_NO_VOXEL);
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
