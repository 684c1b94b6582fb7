// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/renderer.hpp"

#include <chrono>

#include "runtime/analysis/culling.hpp"
#include "runtime/base/error.hpp"
#include "runtime/grid/pyramid_bytes.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/render/illumination.hpp"
#include "runtime/render/light_passes.hpp"
#include "runtime/scene/rendered_channels.hpp"
#include "runtime/stages/resolve/matte.hpp"
#include "runtime/stages/resolve/resolve.hpp"
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
}

namespace {

/// The pixels and samples of the tiles from `first` on.
PathSampling path_sampling(const Scene& scene, const Camera& camera, uint32_t first) {
    return {first,
            uint32_t(camera.width + 3) / 4,
            uint32_t(camera.samples),
            uint32_t(scene.render.bounces),
            uint32_t(camera.first_column),
            uint32_t(camera.first_row),
            uint32_t(camera.first_sample)};
}

/// Notes what an image's rays came to in a world.
void note_counts(const Illumination& illumination, const std::optional<BeamStage>& beams,
                 const Pyramid& world, RenderReport& report) {
    if (beams) {
        report.beams = beams->sent();
        report.clear_beams = beams->cleared();
    }
    report.shadow_rays = illumination.shadow_rays();
    report.light_beams = illumination.light_beams();
    report.secondary_rays = illumination.secondary_rays();
    report.ended_paths = illumination.ended_paths();
    report.medium_overflows = illumination.medium_overflows();
    report.voxels = world.voxel_count;
    report.world_bytes = bytes_of(world);
}

/// The pixels of all tiles, with those of the mattes. Notes how many weren't finite.
Image finished_image(const Scene& scene, ResolveStage& resolve, MatteStage& mattes,
                     RenderReport& report) {
    Image image = resolve.image();
    mattes.add_to(image);
    image.first = scene.render.crop.first;
    image.frame = scene.render.crop.frame;
    report.not_finite = resolve.not_finite();
    return image;
}

/// The camera of the image that tiles make: where pixels are chosen, these stand in a row of tiles.
Camera shown_camera(Camera observer, const Renderer::Tiles& tiles) {
    if (tiles.pixels.empty()) return observer;
    observer.width = 4 * int(tiles.share.tiles());
    observer.height = 4;
    return observer;
}

/// Each sample shows what of a texture lies in its part of the pixel, which all samples share.
[[noreturn]] void refuse_textures() {
    throw Error(ErrorKind::usage,
                "samples can't be added by their number where surfaces wear textures: use --noise "
                "in both runs, or render the image again from the start");
}

}  // namespace

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
    if (image_ && world_ == world.version && scene_ == scene) {
        const WorldReport built = report.world;
        report = report_;
        report.world = built;
        report.is_kept = report.hits_are_kept = true;
        report.image_seconds = 0;
        return image_;
    }
    auto image = std::make_shared<const Image>(new_image(scene, world, report, progress));
    if (follows_) {
        scene_ = scene;
        world_ = world.version;
        image_ = image;
        report_ = report;
    }
    return image;
}

Image Renderer::new_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                          const FrameProgress& progress) {
    TileShare all(tile_count(scene.render.size.x, scene.render.size.y), progress);
    std::vector<TileRange> taken;
    return part_of_image(scene, world, report, {all, taken});
}

Image Renderer::part_of_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                              const Tiles& tiles) {
    const glm::ivec2& size = scene.render.size;
    return with_limits_of(fmt::format("an image of {}x{} pixels", size.x, size.y), [&] {
        Scene shown = scene;
        // Passes have as many samples as all light needs, and variance is that of colour.
        shown.render.channels = rendered_channels(scene.render);
        const std::vector<LightPass> passes = light_passes(shown);
        leave_mattes_to_passes(shown.render);
        shown.render.noise.seconds /= double(1 + passes.size());
        Sampled sampled;
        const Tiles weighted{tiles.share, tiles.taken, 1.0 / double(1 + passes.size())};
        tiles.share.set_weight(first_weight(shown, weighted.weight));
        has_passes_ = !passes.empty() && !shown.render.noise.is_given();
        Image image = sampled_image(shown, world, report, weighted, sampled);
        add_passes(passes, world, weighted, sampled, report, image);
        share_compiled_kernels(device_);
        if (!follows_) hits_.clear();
        if (!passes.empty()) finish_passes(shown, image);
        if (adds_color(scene.render))
            for (const char* channel : {"R", "G", "B", "A"}) image.planes.erase(channel);
        return image;
    });
}

/// Tells whoever shares or watches the tiles that these are done.
void Renderer::note_done(const TileRange& range, const Tiles& tiles) const {
    tiles.taken.push_back(range);
    share_compiled_kernels(device_);
    if (!tiles.share.is_watched()) return;
    device_.finish();
    tiles.share.done(range);
}

void Renderer::send_light_beams(WorldDilation& through, uint32_t max, Illumination& illumination) {
    illumination.send_beams(through.dilated_occupancy, max, through.light_beams);
}

/// What kernels are compiled for when they show a world.
Features Renderer::features_shown(const Scene& scene, const Pyramid& world) const {
    Features features = features_of(scene, world);
    leave_out_solid_kinds(device_, world, features);
    if (scene.render.earlier && features.textures()) refuse_textures();
    if (is_white_) {
        features.colors = false;
        features.leave_out_textures();
    }
    return features;
}

Image Renderer::image_of_tiles(const Scene& scene, const BuiltWorld& built, RenderReport& report,
                               const Tiles& tiles) {
    const auto start = std::chrono::steady_clock::now();
    image_.reset();
    const Pyramid& world = built.pyramid;
    const Features features = features_shown(scene, world);
    const Camera observer = camera_of(scene, world.frame);
    ViewHits hits = begin_view(scene, built, features, observer.samples, tiles.share);
    report.hits_are_kept = hits.are_known;
    const uint32_t rays_per_tile = 16 * uint32_t(observer.samples);
    RayBatch batch = allocate_batch(device_, features, hits.in_batch * rays_per_tile);
    if (hits.are_known) batch.rays = {}, batch.hits = {};  // those that are known follow

    const uint64_t rays = uint64_t(tiles.share.tiles()) * rays_per_tile;
    const double pixel = voxels_a_pixel(scene, observer, world.frame);
    const std::optional<DilationLevel> dilated_occupancy =
        dilation_that_pays(features, world, rays, pixel);
    build_programs(device_, features, scene, world, true, dilated_occupancy.has_value());
    SightStage sight(device_, features, observer, scene.render.filter);
    if (!tiles.pixels.empty()) sight.choose(device_, tiles.pixels);
    const Camera shown = shown_camera(observer, tiles);
    std::optional<BeamStage> beams;
    if (!hits.are_known && dilated_occupancy)
        beams.emplace(device_, features, world,
                      dilated_occupancy_of(built, *dilated_occupancy).dilated_occupancy);
    Illumination illumination(device_, features, scene, world, batch.stride);
    if (dilated_occupancy && lights_send_beams(features)) {
        const uint32_t max = light_beams_that_pay(world.frame, rays, observer.samples, pixel);
        send_light_beams(dilated_occupancy_of(built, *dilated_occupancy), max, illumination);
    }
    ResolveStage resolve(device_, features, shown, scene.render.channels,
                         scene.render.earlier.get());
    MatteStage mattes(device_, features, shown, scene);
    while (const std::optional<TileRange> range = tiles.share.take(hits.in_batch)) {
        const uint32_t first = range->first, count = range->count * rays_per_tile;
        illumination.set_sampling(path_sampling(scene, observer, first));
        if (hits.are_known) {
            take_known(hits, first, batch);
            illumination.light_hits(batch, count);
        } else {
            if (!hits_.empty()) renew_sight(device_, batch);
            sight.cast(shape_of(world), first, range->count, batch);
            if (beams) beams->start(batch, count);
            illumination.light(batch, count);
            if (hits.are_kept) hits_.push_back({first, batch.rays, batch.hits});
        }
        resolve.pixels(world, batch, first, range->count);
        mattes.pixels(batch, first, range->count);
        if (!hits.are_lent) report.sight_rays += count;
        note_done(*range, tiles);
    }
    view_ = std::move(hits.view);
    Image image = finished_image(scene, resolve, mattes, report);
    note_counts(illumination, beams, world, report);
    report.image_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return image;
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
