// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_samples.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/grid/grid_arguments.hpp"

namespace voxelume {
namespace {

/// The logarithm of the places in a row of the squares from which samples are chosen: at least four
/// places for each, as long as that takes less time than the samples' light.
int log2_of_places(uint32_t samples) {
    constexpr int kMin = 3, kMax = 5;
    int log2 = kMin;
    while (log2 < kMax && (1u << (2 * log2)) < 4 * samples) ++log2;
    return log2;
}

/// What is added to a voxel's shift for sample `i`: multiples of the golden ratio.
float turn_of(uint32_t i) {
    constexpr double kGolden = 0.61803398874989485;
    return float(kGolden * i - std::floor(kGolden * i));
}

}  // namespace

SampleSums allocate_sample_sums(const Device& device, size_t voxels) {
    return {Buffer<float>(device, "display normals", 3 * voxels),
            Buffer<float>(device, "display sums", 4 * voxels)};
}

DisplaySampleStage::DisplaySampleStage(const Device& device, const Features& features,
                                       const Camera& camera, const VolumeFrame& frame,
                                       const Pyramid& world, uint32_t samples,
                                       const ShownVoxels& shown)
    : camera_(camera),
      lattice_(display_lattice(frame, world.frame)),
      transmission_(features.transmission),
      world_(world),
      samples_(samples),
      sums_(allocate_sample_sums(device, shown.voxels.count)),
      program_(device, "display_samples.cl", features.defines(device)),
      normals_(program_.kernel("keep_normals")),
      aim_(program_.kernel("aim_samples")),
      add_(program_.kernel("add_samples")),
      mix_(program_.kernel("mix_samples")) {
    sums_.normals.fill(0);
    sums_.sums.fill(0);
}

void DisplaySampleStage::keep_normals(const RayBatch& batch, const Buffer<uint32_t>& targets,
                                      uint32_t first, uint32_t count) {
    normals_.launch(WorkItem::light, count, batch.hits, batch.normals, batch.stride, targets,
                    uint32_t(!targets.empty()), first, count, sums_.normals);
}

void DisplaySampleStage::light_batch(const LightRays& light_rays, const Environment& environment,
                                     RayBatch& batch, const ShownVoxels& shown, uint32_t first,
                                     uint32_t count) {
    const auto add = [&](const RayBatch& entries, const NodeLight& nodes) {
        add_.launch_packets(count, shape_of(world_), lattice_, environment, entries, nodes,
                            shown.voxels.indices, first, count, sums_.sums);
    };
    if (!transmission_) {
        light_rays(batch, count, {});
        add(batch, {batch.radiance, {}, batch.stride});
        return;
    }
    light_rays(batch, count,
               [&](const RayBatch& entries, uint32_t, bool is_first, const NodeLight& nodes) {
                   if (is_first) add(entries, nodes);
               });
}

void DisplaySampleStage::light(const LightRays& light_rays, const Environment& environment,
                               const Buffer<float4>& views, RayBatch& batch, ShownVoxels& shown) {
    const auto voxels = uint32_t(shown.voxels.count);
    for (uint32_t i = 0; i < samples_; ++i) {
        for (uint32_t first = 0; first < voxels; first += batch.stride) {
            const uint32_t count = std::min(batch.stride, voxels - first);
            aim_.launch_packets(count, camera_, shape_of(world_), lattice_, views, shown.points,
                                shown.voxels.indices, sums_.normals, i, samples_, turn_of(i),
                                log2_of_places(samples_), first, count, batch.stride, batch.rays);
            rays_ += count;
            light_batch(light_rays, environment, batch, shown, first, count);
        }
    }
    mix_.launch(WorkItem::light, voxels, voxels, sums_.sums, shown.voxels.colors);
}

}  // namespace voxelume
