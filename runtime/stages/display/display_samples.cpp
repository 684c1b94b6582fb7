// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_samples.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/grid/grid_arguments.hpp"

namespace voxelume {
namespace {

/// The logarithm of the number of positions in a row of the squares from which samples are chosen:
/// at least four positions for each sample of up to 64. Choosing among more would take longer than
/// lighting.
int log2_of_slots(uint32_t samples) {
    constexpr int kMin = 3, kMax = 4;
    int log2 = kMin;
    while (log2 < kMax && (1u << (2 * log2)) < 4 * samples) ++log2;
    return log2;
}

/// What samples add to a voxel's shift: the fractions of multiples of the golden ratio.
std::vector<float> turns_of(uint32_t samples) {
    constexpr double kGolden = 0.61803398874989485;
    std::vector<float> turns(samples);
    for (uint32_t i = 0; i < samples; ++i) turns[i] = float(kGolden * i - std::floor(kGolden * i));
    return turns;
}

/// The number of rays of samples of voxels, whose last group of sixteen may not be full.
uint32_t rays_of(uint32_t voxels, uint32_t samples) {
    return (voxels + 15) / 16 * 16 * samples;
}

}  // namespace

SampleSums allocate_sample_sums(const Device& device, size_t voxels, uint32_t rays, int samples,
                                bool by_need) {
    SampleSums sums;
    sums.turns = Buffer<float>(device, "display turns", size_t(samples));
    sums.normals = Buffer<float>(device, "display normals", 3 * voxels);
    sums.light = Buffer<float>(device, "display sums", 4 * voxels);
    sums.weights = Buffer<float>(device, "display weights", rays);
    if (by_need) sums.of_batch = Buffer<float>(device, "display batch sums", 4 * size_t(rays));
    return sums;
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

void DisplaySampleStage::aim(const SampleLighting& with, RayBatch& batch, const Part& part,
                             const SampleAim& at) {
    const uint32_t rays = rays_of(part.count, at.count);
    aim_.launch_packets(rays, ProbeViews{camera_, shape_of(world_), lattice_, with.views},
                        part.facing.points, part.facing.shown.voxels.indices, sums_.normals, at,
                        sums_.turns, part.first, part.count, batch.stride, sums_.weights,
                        batch.rays);
    rays_ += part.count * at.count;
}

/// Finds the normals at the points, with a ray for each.
void DisplaySampleStage::find_normals(const SampleLighting& with, RayBatch& batch,
                                      const Part& part) {
    aim(with, batch, part, {part.facing.points.axis, 0, 0, 1, 0, 0});
    light_nearest(with.rays, transmission_, batch, {part.first, part.count, 0, false},
                  [&](const RayBatch& entries, const NodeLight&) {
                      normals_.launch(WorkItem::light, part.count, entries.hits, entries.normals,
                                      entries.stride, part.first, part.count, sums_.normals);
                  });
}

void DisplaySampleStage::add(const SampleLighting& with, RayBatch& batch, const Part& part,
                             const SampledRays& rays) {
    light_nearest(with.rays, transmission_, batch, rays,
                  [&](const RayBatch& entries, const NodeLight& nodes) {
                      add_.launch_packets(part.count, shape_of(world_), lattice_, with.medium,
                                          entries, nodes, part.facing.shown.voxels.indices,
                                          sums_.weights, part.first, part.count, rays.samples,
                                          part.first_sum, part.sums);
                  });
}

/// Lights as many samples at once as a batch has room for.
void DisplaySampleStage::light_samples(const SampleLighting& with, RayBatch& batch,
                                       const Part& part, const Samples& samples) {
    const uint32_t room = batch.stride / rays_of(part.count, 1);
    for (uint32_t i = 0; i < samples.count; i += room) {
        const uint32_t now = std::min(room, samples.count - i), number = samples.first + i;
        aim(with, batch, part,
            {part.facing.points.axis, i, samples.count, now, number, log2_of_slots(samples.count)});
        add(with, batch, part, {part.first, rays_of(part.count, now), number, true, now});
        const double lit = with.needed ? 0 : part.count * double(i + now) / samples.count;
        if (with.progress) with.progress((done_ + lit) / all_);
    }
}

/// Adds the means of the samples that the surfaces in a batch's voxels need.
void DisplaySampleStage::light_needed(const SampleLighting& with, RayBatch& batch,
                                      const Part& part) {
    const auto light = [&](uint32_t first, uint32_t count, std::span<const uint32_t> wanted) {
        sums_.of_batch.fill(0);
        for_wanted(wanted, part.count, [&](uint32_t ray, uint32_t rays) {
            light_samples(with, batch, {part.facing, part.first + ray, rays, ray, sums_.of_batch},
                          {first, count});
        });
        std::vector<float> sums = sums_.of_batch.read(0, 4 * size_t(part.count));
        // Weights count slots, of which more samples have more.
        const float scale = std::ldexp(1.0f, -2 * log2_of_slots(count)) / float(count);
        for (float& sum : sums) sum *= scale;
        return sums;
    };
    const uint32_t aimed = points_seen(part.facing.points, part.first, part.count);
    const std::vector<float> means = with.needed(part.count, aimed, light);
    for (size_t i = 0; i < means.size(); ++i) means_[4 * size_t(part.first) + i] += means[i];
}

void DisplaySampleStage::light_facing(const SampleLighting& with, RayBatch& batch,
                                      const Facing& facing) {
    const uint32_t voxels = facing.points.count;
    sums_.normals.fill(0);
    for (uint32_t first = 0; first < voxels; first += batch.stride) {
        const uint32_t count = std::min(batch.stride, voxels - first);
        const Part part{facing, first, count, first, sums_.light};
        find_normals(with, batch, part);
        if (with.needed)
            light_needed(with, batch, part);
        else
            light_samples(with, batch, part, {0, samples_});
        done_ += count;
    }
}

void DisplaySampleStage::light(const SampleLighting& with, RayBatch& batch, ShownVoxels& shown,
                               bool clears_others) {
    const auto voxels = uint32_t(shown.voxels.count);
    sums_ =
        allocate_sample_sums(device_, voxels, batch.stride, int(samples_), with.needed != nullptr);
    sums_.turns.write(turns_of(samples_));
    sums_.light.fill(0);
    if (with.needed) means_.assign(4 * size_t(voxels), 0);
    done_ = 0;
    all_ = 3.0 * voxels;
    for (const ProbePoints& points : shown.of_axes) light_facing(with, batch, {shown, points});
    if (with.needed) sums_.light.write(means_);
    means_ = {};
    mix_.launch(WorkItem::light, voxels, voxels, sums_.light, uint32_t(clears_others),
                shown.voxels.colors, shown.voxels.objects);
}

}  // namespace voxelume
