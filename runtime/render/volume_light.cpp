// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/volume_light.hpp"

#include <algorithm>
#include <vector>

#include "kernels/shared/trace.h"
#include "runtime/analysis/volume_scene.hpp"

namespace voxelume {
namespace {

/// Writes the first three of each ray's `stride` values as the light of rays 0 .. count-1.
void write_light(const std::vector<float>& values, size_t stride, uint32_t count, NodeLight to) {
    std::vector<float> plane(count);
    for (size_t channel = 0; channel < 3; ++channel) {
        for (size_t ray = 0; ray < count; ++ray) plane[ray] = values[stride * ray + channel];
        to.radiance.write(plane, channel * to.stride);
    }
}

}  // namespace

/// Which of all rays those of a batch copy: from number `first` on, sixteen after sixteen, each
/// `copies` times.
struct VolumeLight::CopiedRays {
    uint32_t first, copies;
    size_t operator()(size_t n) const { return first + n / 16 / copies * 16 + n % 16; }
};

void VolumeWork::advance(double part) {
    done = part;
    go_on();
}

void VolumeWork::go_on() const {
    constexpr uint32_t kSteps = 1 << 20;
    if (!progress) return;
    device.finish();
    progress(uint32_t(done * kSteps), kSteps);
}

void count_rays(const Illumination& illumination, RenderReport& report) {
    report.shadow_rays = illumination.shadow_rays();
    report.light_beams = illumination.light_beams();
    report.secondary_rays = illumination.secondary_rays();
    report.ended_paths = illumination.ended_paths();
    report.medium_overflows = illumination.medium_overflows();
}

VolumeLight::VolumeLight(VolumeWork& work, uint32_t max_rays, uint32_t tiles_across)
    : work_(work),
      transmission_(work.features.transmission),
      keeps_layers_(work.features.own_light && work.frame.layout == VolumeLayout::rays),
      samples_(uint32_t(work.scene.render.samples)),
      sampling_{0, tiles_across, 1, uint32_t(work.scene.render.bounces), 0, 0, 0},
      illumination_(work.device, work.features, work.scene, work.world, max_rays) {
    if (work.features.global && samples_ > 1 && !is_sampled_by_noise(work.scene.render) &&
        !keeps_layers_)
        mean_.emplace(work.device, work.features, max_rays, samples_);
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

/// Tells that a part of the samples of a batch are lit. How many it needs isn't known before.
void VolumeLight::tell_progress(uint32_t done, uint32_t samples) {
    if (needed_ || !(end_ > begin_)) return work_.go_on();
    // Lighting the batch once more takes about as long as one sample.
    work_.advance(begin_ + (end_ - begin_) * done / (samples + 1.0));
}

/// Adds the light of one sample of each of `all` rays to the sums of the rays that `ray_of` names.
void VolumeLight::add_lit(RayBatch& batch, uint32_t all, const CopiedRays& ray_of,
                          LightSums& sums) {
    const auto add = [&](const NodeLight& lit, std::vector<float>* layer) {
        for (size_t channel = 0; channel < 3; ++channel) {
            const std::vector<float> values = lit.radiance.read(channel * lit.stride, all);
            for (size_t n = 0; n < all; ++n) {
                sums.of_rays[4 * ray_of(n) + channel] += values[n];
                if (layer) (*layer)[3 * ray_of(n) + channel] += values[n];
            }
        }
    };
    if (sums.of_layers == nullptr) {
        illumination_.light(batch, all);
        add({batch.radiance, {}, batch.stride}, nullptr);
    } else {
        size_t number = 0;
        illumination_.light_layers(
            batch, all, [&](const RayBatch&, uint32_t, bool, const NodeLight& lit) {
                if (number == sums.of_layers->size())
                    sums.of_layers->emplace_back(sums.of_rays.size() / 4 * 3, 0.0f);
                add(lit, &(*sums.of_layers)[number++]);
            });
    }
    const std::vector<uint32_t> met = batch.hits.read(VXL_HIT_VOXEL * size_t(batch.stride), all);
    for (size_t n = 0; n < all; ++n)
        if (met[n] != VXL_NO_VOXEL) sums.of_rays[4 * ray_of(n) + 3] += 1;
}

/// Adds the light of samples to the rays' sums. As many samples as the batch has room for are lit
/// at once. `aimed` holds all rays, of which these begin at number `first`.
void VolumeLight::add_samples(RayBatch& batch, const SampledRays& rays, uint32_t first,
                              std::span<const float> aimed, LightSums& sums) {
    const uint32_t room = batch.stride / rays.count;
    for (uint32_t i = 0; i < rays.samples; i += room) {
        const uint32_t now = std::min(room, rays.samples - i), all = now * rays.count;
        const CopiedRays ray_of{first, now};
        std::vector<float> values(all);
        for (size_t part = 0; part < VXL_RAY_COMPONENTS; ++part) {
            for (size_t n = 0; n < all; ++n) values[n] = aimed[part * batch.stride + ray_of(n)];
            batch.rays.write(values, part * batch.stride);
        }
        if (beams_) beams_->start(batch, all);
        more_rays_ += all;
        set_sampling({rays.first, all, rays.sample + i, true, now});
        add_lit(batch, all, ray_of, sums);
        tell_progress(i + now, rays.samples);
    }
}

/// Returns four means for each ray, of the light along it and of hits, over the samples that the
/// rays need or else over `samples_`. `of_layers`, unless it is null, gets the mean light of each
/// layer. Leaves the rays in the batch as they came.
std::vector<float> VolumeLight::means(RayBatch& batch, const SampledRays& rays,
                                      LayerSums* of_layers) {
    std::vector<float> aimed = batch.rays.read();
    const uint32_t padded = (rays.count + 15) / 16 * 16;
    // Rays that fill up the last group meet nothing.
    std::fill(aimed.begin() + ptrdiff_t(VXL_RAY_END * size_t(batch.stride) + rays.count),
              aimed.begin() + ptrdiff_t(VXL_RAY_END * size_t(batch.stride) + padded), -1.0f);
    std::vector<uint32_t> counts(padded / 16, 0);
    const auto light = [&](uint32_t first, uint32_t count, std::span<const uint32_t> wanted) {
        std::vector<float> sums_of_rays(4 * size_t(padded), 0.0f);
        LightSums sums{sums_of_rays, of_layers};
        for_wanted(wanted, padded, [&](uint32_t ray, uint32_t run) {
            add_samples(batch, {rays.first + ray, run, first, true, count}, ray, aimed, sums);
            for (uint32_t group = ray / 16; group < (ray + run) / 16; ++group)
                counts[group] += count;
        });
        for (float& sum : sums_of_rays) sum /= float(count);
        return sums_of_rays;
    };
    const std::vector<uint32_t> all(padded / 16, 1);
    std::vector<float> found =
        needed_ ? needed_->mean(padded, rays.count, light) : light(0, samples_, all);
    if (of_layers)
        for (std::vector<float>& layer : *of_layers)
            for (size_t i = 0; i < layer.size(); ++i) layer[i] /= float(counts[i / 3 / 16]);
    batch.rays.write(aimed);
    if (beams_) beams_->start(batch, rays.count);
    set_sampling({rays.first, rays.count, 0, false});
    return found;
}

/// Gives each ray the mean light of the first surface that it meets.
void VolumeLight::mean_by_noise(RayBatch& batch, const SampledRays& rays) {
    const std::vector<float> mean = means(batch, rays, nullptr);
    illumination_.light(batch, rays.count);
    write_light(mean, 4, rays.count, {batch.radiance, {}, batch.stride});
}

void VolumeLight::mean_of_layers(RayBatch& batch, const SampledRays& rays, const LayerSink& sink) {
    if (samples_ == 1) {
        set_sampling(rays);
        return illumination_.light_layers(batch, rays.count, sink);
    }
    LayerSums of_layers;
    means(batch, rays, &of_layers);
    size_t number = 0;
    illumination_.light_layers(
        batch, rays.count,
        [&](const RayBatch& entries, uint32_t count, bool is_first, const NodeLight& lit) {
            const std::vector<float>& layer = of_layers.at(number++);
            write_light(layer, 3, rays.count, lit);
            sink(entries, count, is_first, lit);
        });
}

void VolumeLight::mean_of_fixed(RayBatch& batch, const SampledRays& rays) {
    for (uint32_t path = 0; path < mean_->paths(); ++path) {
        set_sampling({rays.first, rays.count, path});
        if (path == 0)
            illumination_.light(batch, rays.count);
        else
            illumination_.light_hits(batch, rays.count);
        mean_->add(path, batch, rays.count);
        tell_progress(path + 1, mean_->paths());
    }
}

void VolumeLight::mean(RayBatch& batch, const SampledRays& rays, const LayerSink& sink) {
    if (keeps_layers_) return mean_of_layers(batch, rays, sink);
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
