// samples -> pixels: the mean of a pixel's samples, and the geometry of its first sample that hit.
//
// Build constants beside the features': VXL_SHOWS_COLOR, VXL_SHOWS_DEPTH, VXL_SHOWS_POSITION,
// VXL_SHOWS_NORMAL, VXL_SHOWS_OBJECT: the channels asked for.
#include "lib/exact_exp.h"
#include "lib/fixed_point.h"
#include "lib/work_item.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

/// One work-item makes one pixel. `image` holds, `pixels` apart, what is asked for of R G B A Z P.X
/// P.Y P.Z N.X N.Y N.Z; `objects` the number of the object plus 1, 0 for none. Counts values that
/// are not finite, as 0.
kernel void resolve_pixels(Sight sight, PyramidShape shape, float4 world_origin,
                           global const uint* restrict hits, global const float* restrict positions,
                           global const float* restrict normals, global const uint* restrict words,
                           global const float* restrict radiance,
                           global const float* restrict coverage, uint first_tile, uint tile_count,
                           uint stride, global float* restrict image, global uint* restrict objects,
                           global uint* restrict not_finite) {
    const uint item = work_item();
    if (item >= tile_count * 16u) return;
    const uint tiles_x = ((uint)sight.width + 3u) / 4u;
    const uint tile = first_tile + item / 16u;
    const uint column = tile % tiles_x * 4u + (item & 3u);
    const uint row = tile / tiles_x * 4u + ((item >> 2) & 3u);
    if (column >= (uint)sight.width || row >= (uint)sight.height) return;
    const size_t pixels = (size_t)sight.width * (size_t)sight.height;
    const size_t pixel = row * (size_t)sight.width + column;
    const uint first_ray = item / 16u * (uint)sight.samples * 16u + item % 16u;

    float color[3] = {0.0f, 0.0f, 0.0f};
    float covered = 0.0f;
    uint shown = VXL_NO_VOXEL;
    for (uint sample = 0; sample < (uint)sight.samples; ++sample) {
        const uint ray = first_ray + sample * 16u;
        if (VXL_SHOWS_COLOR) {
            for (uint channel = 0; channel < 3; ++channel)
                color[channel] += radiance[channel * stride + ray];
            if (VXL_TRANSMISSION) covered += coverage[ray];
        }
        if (hits[VXL_HIT_VOXEL * stride + ray] == VXL_NO_VOXEL) continue;
        if (!VXL_TRANSMISSION) covered += 1.0f;
        if (shown == VXL_NO_VOXEL) shown = ray;
    }
    const float share = sight.sample_share;
    for (uint channel = 0; VXL_SHOWS_COLOR && channel < 3; ++channel) {
        const float value = color[channel] * share;
        const bool finite = isfinite(value);
        if (!finite) atomic_inc(not_finite);
        image[channel * pixels + pixel] = finite ? value : 0.0f;
    }
    if (VXL_SHOWS_COLOR) image[3 * pixels + pixel] = covered * share;
    const bool hit = shown != VXL_NO_VOXEL;
    const uint ray = hit ? shown : 0;
    const float edge[3] = {shape.edge.x, shape.edge.y, shape.edge.z};
    const float origin[3] = {world_origin.x, world_origin.y, world_origin.z};
    const uint depth_plane = 4 * VXL_SHOWS_COLOR;
    const uint position_plane = depth_plane + VXL_SHOWS_DEPTH;
    const uint normal_plane = position_plane + 3 * VXL_SHOWS_POSITION;
    const float eye[3] = {sight.origin.x, sight.origin.y, sight.origin.z};
    const float eye_low[3] = {sight.origin_low.x, sight.origin_low.y, sight.origin_low.z};
    // Z_E in voxels per metre; times the edge twice it measures voxels along Z_E in metres.
    const float ahead[3] = {sight.axis_z.x, sight.axis_z.y, sight.axis_z.z};
    float depth = sight.lead;
    for (uint a = 0; a < 3; ++a) {
        const bool is_placed = VXL_SHOWS_DEPTH || VXL_SHOWS_POSITION;
        const float p = is_placed ? positions[a * stride + ray] : 0.0f;
        const float from_eye = (p - eye[a] - eye_low[a]) * edge[a];
        depth = fma(from_eye, ahead[a] * edge[a], depth);
        if (VXL_SHOWS_POSITION)
            image[(position_plane + a) * pixels + pixel] = hit ? fma(p, edge[a], origin[a]) : 0.0f;
        if (VXL_SHOWS_NORMAL)
            image[(normal_plane + a) * pixels + pixel] = hit ? normals[a * stride + ray] : 0.0f;
    }
    if (VXL_SHOWS_DEPTH) image[depth_plane * pixels + pixel] = hit ? depth : INFINITY;
    if (VXL_SHOWS_OBJECT) objects[pixel] = hit ? (words[ray] & VXL_OBJECT_MASK) + 1u : 0u;
}
