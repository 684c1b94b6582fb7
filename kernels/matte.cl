// SPDX-License-Identifier: Apache-2.0
// samples -> mattes: which objects, or materials, cover most of each pixel, and by how much.
//
// With VXL_EARLIER, the buffers already hold the ranks of earlier samples and the sums of what they
// cover, including the ranks kept behind those that the image names. If a pixel shows more objects
// than there are ranks, a new object takes over the last rank and its weight. No object that covers
// more than a 24th of the pixel is lost.
//
// Source: Friedman, Jones: "Fully Automatic ID Mattes with Support for Motion Blur and
// Transparency", 2015; the ranks are those of Cryptomatte. Metwally, Agrawal, El Abbadi: "Efficient
// Computation of Frequent and Top-k Elements in Data Streams", 2005.
#include "lib/lanes/work_item.h"
#include "lib/traverse/ray_batch.h"
#include "shared/matte.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

/// The field of packed attributes that a matte shows: the object or the material.
typedef struct {
    uint shift, mask;
} MatteField;

/// The samples of a pixel: every 16th ray, beginning with `first`.
typedef struct {
    const RayBatch* batch;
    uint first;
    MatteField field;
} PixelSamples;

/// The number, from 1 on, of what a sample's ray met first; 0 for nothing.
static inline uint sample_number(const PixelSamples* s, uint sample) {
    const uint ray = s->first + sample * 16u;
    if (s->batch->hits[VXL_HIT_VOXEL * s->batch->stride + ray] == VXL_NO_VOXEL) return 0u;
    return ((s->batch->hit_attributes[ray] >> s->field.shift) & s->field.mask) + 1u;
}

/// A sample's contribution to the pixel's A, which belongs to the surface that the sample met
/// first.
static inline float sample_coverage(const PixelSamples* s, uint sample) {
    return VXL_TRANSMISSION ? s->batch->coverage[s->first + sample * 16u] : 1.0f;
}

static inline bool was_met_before(const PixelSamples* s, uint sample, uint number) {
    for (uint earlier = 0; earlier < sample; ++earlier)
        if (sample_number(s, earlier) == number) return true;
    return false;
}

#define VXL_RANKS (VXL_EARLIER ? VXL_MATTE_HELD : VXL_MATTE_RANKS)

/// The numbers that cover most of a pixel, and their weights; ties go to the lower number.
typedef struct {
    uint number[VXL_RANKS];
    float weight[VXL_RANKS];
} Ranks;

static inline void insert_rank(Ranks* ranks, uint number, float weight) {
    for (uint i = 0; i < VXL_RANKS; ++i) {
        const bool is_before =
            weight > ranks->weight[i] ||
            (weight == ranks->weight[i] && (ranks->number[i] == 0u || number < ranks->number[i]));
        if (!is_before) continue;
        const uint other = ranks->number[i];
        const float its_weight = ranks->weight[i];
        ranks->number[i] = number, ranks->weight[i] = weight;
        if (other == 0u) return;
        number = other, weight = its_weight;
    }
}

/// Removes a number from the ranks, or the last rank if the number isn't there. Returns the weight
/// that the removed rank had.
static inline float take_rank(Ranks* ranks, uint number) {
    float weight = 0.0f;
    for (uint i = 0; i < VXL_RANKS; ++i) {
        const bool is_match = ranks->number[i] == number || i + 1u == VXL_RANKS;
        if (weight == 0.0f && is_match) weight = ranks->weight[i];
        if (weight == 0.0f) continue;
        const bool is_end = i + 1u == VXL_RANKS;
        ranks->number[i] = is_end ? 0u : ranks->number[i + 1u];
        ranks->weight[i] = is_end ? 0.0f : ranks->weight[i + 1u];
    }
    return weight;
}

/// One work-item ranks what one pixel shows. Rank r of a pixel is stored `pixels` * r behind its
/// first, as a number in `numbers`, 0 for none, and as the covered part of the pixel in `weights`.
kernel void rank_matte(Camera camera, VXL_BATCH_PARAMETERS, uint first_tile, uint tile_count,
                       uint shift, uint mask, global uint* restrict numbers,
                       global float* restrict weights) {
    const uint item = work_item();
    if (item >= tile_count * 16u) return;
    const uint tile = first_tile + item / 16u, tiles_x = ((uint)camera.width + 3u) / 4u;
    const uint column = tile % tiles_x * 4u + (item & 3u);
    const uint row = tile / tiles_x * 4u + (item % 16u >> 2);
    if (column >= (uint)camera.width || row >= (uint)camera.height) return;
    const RayBatch batch = VXL_BATCH;
    const uint samples = (uint)camera.samples;
    const PixelSamples s = {&batch, item / 16u * samples * 16u + item % 16u, {shift, mask}};
    const size_t pixels = (size_t)camera.width * (size_t)camera.height;
    const size_t index = row * (size_t)camera.width + column;
    Ranks ranks;
    for (uint i = 0; i < VXL_RANKS; ++i) {
        ranks.number[i] = VXL_EARLIER ? numbers[i * pixels + index] : 0u;
        ranks.weight[i] = VXL_EARLIER ? weights[i * pixels + index] : 0.0f;
    }
    const float weight = VXL_EARLIER ? 1.0f : camera.sample_weight;
    for (uint sample = 0; sample < samples; ++sample) {
        const uint number = sample_number(&s, sample);
        if (number == 0u || was_met_before(&s, sample, number)) continue;
        float covered = 0.0f;
        for (uint other = sample; other < samples; ++other)
            if (sample_number(&s, other) == number) covered += sample_coverage(&s, other);
        if (covered == 0.0f) continue;
        if (VXL_EARLIER) covered += take_rank(&ranks, number);
        insert_rank(&ranks, number, covered * weight);
    }
    for (uint i = 0; i < VXL_RANKS; ++i) {
        numbers[i * pixels + index] = ranks.number[i];
        weights[i * pixels + index] =
            VXL_EARLIER ? ranks.weight[i] * camera.sample_weight : ranks.weight[i];
    }
}
