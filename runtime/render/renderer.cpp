// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/renderer.hpp"

#include "runtime/analysis/culling.hpp"
#include "runtime/base/error.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/render/light_passes.hpp"
#include "runtime/render/smaller_batches.hpp"
#include "runtime/scene/rendered_channels.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {

void add_counts(const RenderReport& report, RenderReport& sum) {
    sum.sight_rays += report.sight_rays;
    sum.contrasting_pixels += report.contrasting_pixels;
    sum.beams += report.beams;
    sum.clear_beams += report.clear_beams;
    sum.display_lines += report.display_lines;
    sum.clear_display_lines += report.clear_display_lines;
    sum.shadow_rays += report.shadow_rays;
    sum.light_beams += report.light_beams;
    sum.secondary_rays += report.secondary_rays;
    sum.ended_paths += report.ended_paths;
    sum.medium_overflows += report.medium_overflows;
    sum.not_finite += report.not_finite;
    sum.noise += report.noise;
    sum.volume_noise += report.volume_noise;
}

Renderer::WorldDilation& Renderer::dilated_occupancy_of(const BuiltWorld& world, DilationLevel of) {
    if (!dilated_occupancy_ || dilated_occupancy_->world != world.version ||
        dilated_occupancy_->dilated_occupancy.of != of) {
        dilated_occupancy_.reset();
        dilated_occupancy_ =
            WorldDilation{world.version, build_dilated_occupancy(device_, world.pyramid, of), {}};
    }
    return *dilated_occupancy_;
}

std::shared_ptr<const Image> Renderer::image(const Scene& scene, const BuiltWorld& world,
                                             RenderReport& report, const FrameProgress& progress) {
    if (image_ && !moments_ && world_ == world.version && scene_ == scene) {
        const WorldReport built = report.world;
        report = report_;
        report.world = built;
        report.is_kept = report.hits_are_kept = true;
        report.image_seconds = 0;
        return image_;
    }
    auto image = std::make_shared<const Image>(new_image(scene, world, report, progress));
    if (follows_ && !moments_) {
        scene_ = scene;
        world_ = world.version;
        image_ = image;
        report_ = report;
    }
    return image;
}

Image Renderer::new_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                          const FrameProgress& progress) {
    const RenderReport before = report;
    std::vector<TileRange> taken;
    return with_batches_that_fit(
        device_, [&] { return !taken.empty(); },
        [&] {
            report = before;
            TileShare all(tile_count(scene.render.size.x, scene.render.size.y), progress);
            return part_of_image(scene, world, report, {all, taken});
        });
}

Image Renderer::part_of_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                              const Tiles& tiles) {
    const glm::ivec2& size = scene.render.size;
    return with_limits_of(fmt::format("an image of {}x{} pixels", size.x, size.y), [&] {
        Scene shown = scene;
        // Passes need as many samples as the whole light, and variance refers to the colour.
        shown.render.channels = rendered_channels(scene.render);
        // With other moments, points don't tell which samples met something; depths do.
        const bool adds_depth = moments_ && shows_points_alone(shown.render.channels);
        shown.render.channels.depth |= adds_depth;
        image_settings_ = shown.render;
        const std::vector<LightPass> passes = light_passes(shown);
        leave_mattes_to_passes(shown.render);
        shown.render.noise.seconds *= time_share(scene.render) / double(1 + passes.size());
        Sampled sampled;
        const Tiles weighted{tiles.share, tiles.taken, 1.0 / double(1 + passes.size())};
        tiles.share.set_weight(first_weight(shown, weighted.weight));
        has_passes_ = !passes.empty() && !shown.render.noise.is_given();
        Image image = sampled_image(shown, world, report, weighted, sampled);
        if (moments_) dilated_occupancy_.reset();  // the occupancy of the last moment
        add_passes(passes, world, weighted, sampled, report, image);
        share_compiled_kernels(device_);
        if (!follows_) hits_.clear();
        if (!passes.empty()) finish_passes(shown, image);
        if (adds_depth) image.planes.erase("Z");
        if (adds_color(scene.render))
            for (const char* channel : {"R", "G", "B", "A"}) image.planes.erase(channel);
        return image;
    });
}

Image render(const Device& device, const Scene& scene, RenderReport& report,
             const FrameProgress& progress) {
    AssetStore meshes;
    const Scene shown = with_culling(scene, meshes);
    const BuiltWorld world =
        WorldBuilder(device, false, std::move(meshes)).build(shown, report.world);
    return Renderer(device, false).new_image(shown, world, report, progress);
}

}  // namespace voxelume
