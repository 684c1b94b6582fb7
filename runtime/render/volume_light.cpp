// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/volume_light.hpp"

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
    if (work.features.global && paths > 1)
        mean_.emplace(work.device, work.features, max_rays, paths);
}

void VolumeLight::set_sampling(const SampledRays& rays) {
    PathSampling of = sampling_;
    of.first_tile = rays.first / 16;
    of.first_sample = rays.sample;
    if (!rays.is_shown) of.bounces = 0;
    illumination_.set_sampling(of);
}

void VolumeLight::sample(RayBatch& batch, const SampledRays& rays, const LayerSink& sink) {
    set_sampling(rays);
    illumination_.light(batch, rays.count, sink);
}

void VolumeLight::mean(RayBatch& batch, const SampledRays& rays, const LayerSink& sink) {
    if (!mean_) return sample(batch, rays, sink);
    for (uint32_t path = 0; path < mean_->paths(); ++path) {
        set_sampling({rays.first, rays.count, path});
        if (path == 0)
            illumination_.light(batch, rays.count);
        else
            illumination_.light_hits(batch, rays.count);
        mean_->add(path, batch, rays.count);
    }
    if (sink && transmission_)
        sink(batch, rays.count, true, {batch.radiance, batch.coverage, batch.stride});
}

}  // namespace voxelume
