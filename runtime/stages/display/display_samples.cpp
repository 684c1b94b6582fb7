// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_samples.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/grid/grid_arguments.hpp"

namespace voxelume {
namespace {

/// The logarithm of the number of positions in a row of the squares from which samples are chosen:
/// at least four positions for each sample, as long as choosing takes less time than lighting.
int log2_of_slots(uint32_t samples) {
    constexpr int kMin = 3, kMax = 5;
    int log2 = kMin;
    while (log2 < kMax && (1u << (2 * log2)) < 4 * samples) ++log2;
    return log2;
}

/// The offset that sample `i` adds to a voxel's shift: the fraction of a multiple of the golden
/// ratio.
float turn_of(uint32_t i) {
    constexpr double kGolden = 0.61803398874989485;
    return float(kGolden * i - std::floor(kGolden * i));
}

}  // namespace

SampleSums allocate_sample_sums(const Device& device, size_t voxels, uint32_t rays) {
    return {Buffer<float>(device, "display normals", 3 * voxels),
            Buffer<float>(device, "display sums", 4 * voxels),
            Buffer<float>(device, "display weights", rays)};
}

DisplaySampleStage::DisplaySampleStage(const Device& device, const Features& features,
                                       const Camera& camera, const VolumeFrame& frame,
                                       const Pyramid& world, int samples)
    : device_(device),
      camera_(camera),
      lattice_(display_lattice(frame, world.frame)),
      transmission_(features.transmission),
      world_(world),
      samples_(uint32_t(samples)),
      program_(device, "display/display_samples.cl", features.defines(device)),
      normals_(program_.kernel("keep_normals")),
      aim_(program_.kernel("aim_samples")),
      add_(program_.kernel("add_samples")),
      mix_(program_.kernel("mix_samples")) {}

void DisplaySampleStage::add(const LightRays& light_rays, const SpaceMedium& medium,
                             RayBatch& batch, const Facing& facing, const SampledRays& which) {
    const uint32_t first = which.first, count = which.count;
    const auto add = [&](const RayBatch& entries, const NodeLight& nodes) {
        add_.launch_packets(count, shape_of(world_), lattice_, medium, entries, nodes,
                            facing.shown.voxels.indices, sums_.weights, first, count, sums_.light);
    };
    if (!transmission_) {
        light_rays(batch, which, {});
        add(batch, {batch.radiance, {}, batch.stride});
        return;
    }
    light_rays(batch, which,
               [&](const RayBatch& entries, uint32_t, bool is_first, const NodeLight& nodes) {
                   if (is_first) add(entries, nodes);
               });
}

/// Finds the normals at the points, with a first ray, and then lights the samples.
void DisplaySampleStage::light_facing(const LightRays& light_rays, const SpaceMedium& medium,
                                      const Buffer<float4>& views, RayBatch& batch,
                                      const Facing& facing) {
    const uint32_t voxels = facing.points.count;
    sums_.normals.fill(0);
    for (uint32_t first = 0; first < voxels; first += batch.stride) {
        const uint32_t count = std::min(batch.stride, voxels - first);
        const auto aim = [&](uint32_t sample, uint32_t samples) {
            const SampleAim at{facing.points.axis, sample, samples, turn_of(sample),
                               log2_of_slots(samples_)};
            aim_.launch_packets(count, ProbeViews{camera_, shape_of(world_), lattice_, views},
                                facing.points, facing.shown.voxels.indices, sums_.normals, at,
                                first, count, batch.stride, sums_.weights, batch.rays);
            rays_ += count;
        };
        const auto keep = [&](const RayBatch& entries) {
            normals_.launch(WorkItem::light, count, entries.hits, entries.normals, entries.stride,
                            first, count, sums_.normals);
        };
        aim(0, 0);
        if (transmission_)
            light_rays(batch, {first, count, 0, false},
                       [&](const RayBatch& entries, uint32_t, bool is_first, const NodeLight&) {
                           if (is_first) keep(entries);
                       });
        else
            light_rays(batch, {first, count, 0, false}, {}), keep(batch);
        for (uint32_t i = 0; i < samples_; ++i) {
            aim(i, samples_);
            add(light_rays, medium, batch, facing, {first, count, i});
        }
    }
}

void DisplaySampleStage::light(const LightRays& light_rays, const SpaceMedium& medium,
                               const Buffer<float4>& views, RayBatch& batch, ShownVoxels& shown,
                               bool clears_others) {
    const auto voxels = uint32_t(shown.voxels.count);
    sums_ = allocate_sample_sums(device_, voxels, batch.stride);
    sums_.light.fill(0);
    for (const ProbePoints& points : shown.of_axes)
        light_facing(light_rays, medium, views, batch, {shown, points});
    mix_.launch(WorkItem::light, voxels, voxels, sums_.light, uint32_t(clears_others),
                shown.voxels.colors, shown.voxels.objects);
}

}  // namespace voxelume
