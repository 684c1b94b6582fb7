// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/volume_light.hpp"

#include <algorithm>
#include <vector>

#include "kernels/shared/trace.h"
#include "runtime/analysis/volume_scene.hpp"

namespace voxelume {

void count_rays(const Illumination& illumination, RenderReport& report) {
    report.shadow_rays = illumination.shadow_rays();
    report.light_beams = illumination.light_beams();
    report.secondary_rays = illumination.secondary_rays();
    report.ended_paths = illumination.ended_paths();
    report.medium_overflows = illumination.medium_overflows();
}

VolumeLight::VolumeLight(const VolumeWork& work, uint32_t max_rays, uint32_t tiles_across)
    : transmission_(work.features.transmission),
      sampling_{0, tiles_across, 1, uint32_t(work.scene.render.bounces), 0, 0, 0},
      illumination_(work.device, work.features, work.scene, work.world, max_rays) {
    const auto paths = uint32_t(work.scene.render.samples);
    if (work.features.global && paths > 1 && !is_sampled_by_noise(work.scene.render))
        mean_.emplace(work.device, work.features, max_rays, paths);
}

void VolumeLight::set_sampling(const SampledRays& rays) {
    PathSampling of = sampling_;
    of.first_tile = rays.first / 16;
    of.first_sample = rays.sample;
    of.samples = rays.samples;
    if (!rays.is_shown) of.bounces = 0;
    illumination_.set_sampling(of);
}

void VolumeLight::sample(RayBatch& batch, const SampledRays& rays, const LayerSink& sink) {
    set_sampling(rays);
    illumination_.light(batch, rays.count, sink);
}

/// Adds the light of samples to four sums for each ray: three of colours, and of hits. As many
/// samples as the batch has room for are lit at once. `aimed` holds the rays.
void VolumeLight::add_samples(RayBatch& batch, const SampledRays& rays,
                              std::span<const float> aimed, std::span<float> sums) {
    const uint32_t room = batch.stride / rays.count;
    for (uint32_t i = 0; i < rays.samples; i += room) {
        const uint32_t now = std::min(room, rays.samples - i), all = now * rays.count;
        const auto ray_of = [now](size_t n) { return n / 16 / now * 16 + n % 16; };
        std::vector<float> values(all);
        for (size_t part = 0; part < VXL_RAY_COMPONENTS; ++part) {
            for (size_t n = 0; n < all; ++n) values[n] = aimed[part * batch.stride + ray_of(n)];
            batch.rays.write(values, part * batch.stride);
        }
        if (beams_) beams_->start(batch, all);
        more_rays_ += all;
        sample(batch, {rays.first, all, rays.sample + i, true, now}, {});
        for (size_t channel = 0; channel < 3; ++channel) {
            values = batch.radiance.read(channel * batch.stride, all);
            for (size_t n = 0; n < all; ++n) sums[4 * ray_of(n) + channel] += values[n];
        }
        const std::vector<uint32_t> met =
            batch.hits.read(VXL_HIT_VOXEL * size_t(batch.stride), all);
        for (size_t n = 0; n < all; ++n)
            if (met[n] != VXL_NO_VOXEL) sums[4 * ray_of(n) + 3] += 1;
    }
}

/// Gives each ray the mean light of the first surface that it meets.
void VolumeLight::mean_by_noise(RayBatch& batch, const SampledRays& rays) {
    std::vector<float> aimed = batch.rays.read();
    const uint32_t padded = (rays.count + 15) / 16 * 16;
    // Rays that fill up the last group meet nothing.
    std::fill(aimed.begin() + ptrdiff_t(VXL_RAY_END * size_t(batch.stride) + rays.count),
              aimed.begin() + ptrdiff_t(VXL_RAY_END * size_t(batch.stride) + padded), -1.0f);
    const auto light = [&](uint32_t first, uint32_t count, std::span<const uint32_t> wanted) {
        std::vector<float> means(4 * size_t(padded), 0.0f);
        for_wanted(wanted, padded, [&](uint32_t ray, uint32_t run) {
            add_samples(batch, {rays.first + ray, run, first, true, count},
                        std::span(aimed).subspan(ray),
                        std::span(means).subspan(4 * size_t(ray), 4 * size_t(run)));
        });
        for (float& mean : means) mean /= float(count);
        return means;
    };
    const std::vector<float> means = needed_->mean(padded, rays.count, light);
    batch.rays.write(aimed);
    if (beams_) beams_->start(batch, rays.count);
    sample(batch, {rays.first, rays.count, 0, false}, {});
    std::vector<float> plane(rays.count);
    for (size_t channel = 0; channel < 3; ++channel) {
        for (size_t ray = 0; ray < plane.size(); ++ray) plane[ray] = means[4 * ray + channel];
        batch.radiance.write(plane, channel * batch.stride);
    }
}

void VolumeLight::mean_of_fixed(RayBatch& batch, const SampledRays& rays) {
    for (uint32_t path = 0; path < mean_->paths(); ++path) {
        set_sampling({rays.first, rays.count, path});
        if (path == 0)
            illumination_.light(batch, rays.count);
        else
            illumination_.light_hits(batch, rays.count);
        mean_->add(path, batch, rays.count);
    }
}

void VolumeLight::mean(RayBatch& batch, const SampledRays& rays, const LayerSink& sink) {
    if (needed_ && rays.is_shown)
        mean_by_noise(batch, rays);
    else if (mean_)
        mean_of_fixed(batch, rays);
    else
        return sample(batch, rays, sink);
    if (sink && transmission_)
        sink(batch, rays.count, true, {batch.radiance, batch.coverage, batch.stride});
}

}  // namespace voxelume
