// SPDX-License-Identifier: Apache-2.0
// The tiles of an image with the scene's number of samples, at one moment or at several.
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/base/stopwatch.hpp"
#include "runtime/grid/pyramid_bytes.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/render/illumination.hpp"
#include "runtime/render/light_passes.hpp"
#include "runtime/render/moments.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/stages/resolve/matte.hpp"
#include "runtime/stages/resolve/resolve.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {

/// The sums of an image's samples, and the samples that a moment adds to them.
struct Renderer::Sums {
    ImageArrays image;
    std::vector<MatteArrays> mattes;
    int before = 0;           ///< number of samples in the sums
    float before_weight = 0;  ///< factor that turns the present values into sums
    int after = 0;            ///< number of samples after those of the moment
    double part = 1;          ///< the moment's part of the image's samples

    Camera camera(Camera camera) const {
        camera.earlier_samples = before;
        camera.earlier_weight = before_weight;
        camera.is_last = after == 0;
        camera.sample_weight = after == 0 ? 1.0f / float(before + camera.samples) : 1.0f;
        return camera;
    }
};

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

/// Stores the counters of an image's rays in a world.
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

/// The size of the image that tiles make: tiles of chosen pixels lie in a row.
glm::ivec2 size_of(const Scene& scene, const Renderer::Tiles& tiles) {
    if (tiles.pixels.empty()) return scene.render.size;
    return {4 * int(tiles.share.tiles()), 4};
}

/// The camera of the image that tiles make.
Camera shown_camera(const Scene& scene, Camera observer, const Renderer::Tiles& tiles) {
    const glm::ivec2 size = size_of(scene, tiles);
    observer.width = size.x;
    observer.height = size.y;
    return observer;
}

/// Refuses textures: the part of a texture that a sample shows depends on the number of samples of
/// its pixel.
[[noreturn]] void refuse_textures() {
    throw Error(ErrorKind::usage,
                "samples can't be added by their number where surfaces wear textures: use --noise "
                "in both runs, or render the image again from the start");
}

}  // namespace

/// Reports that a part of the work on the tiles is done, to those that share or watch them.
void Renderer::note_done(const TileRange& range, const Tiles& tiles, double part) const {
    tiles.taken.push_back(range);
    share_compiled_kernels(device_);
    if (!tiles.share.is_watched()) return;
    device_.finish();
    tiles.share.add_work(range.count * tiles.share.weight() * part);
}

void Renderer::send_light_beams(WorldDilation& through, uint32_t max, Illumination& illumination) {
    illumination.send_beams(through.dilated_occupancy, max, through.light_beams);
}

/// The features for which kernels are compiled to show a world.
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

/// The sums of the samples before the scene's own.
Renderer::Sums Renderer::begin_sums(const Scene& scene, const Tiles& tiles) const {
    const glm::ivec2 size = size_of(scene, tiles);
    const ImageChannels& channels = scene.render.channels;
    Sums sums{allocate_image(device_, size, channels),
              allocate_mattes(device_, size, channels, moments_ != nullptr)};
    if (scene.render.earlier) {
        begin_with(*scene.render.earlier, channels, sums.image);
        sums.before = scene.render.first_sample;
        sums.before_weight = float(sums.before);
    } else if (moments_) {
        sums.image.planes.fill(0);
        sums.image.ids.fill(0);
        for (MatteArrays& matte : sums.mattes) matte.shares.fill(0);
    }
    return sums;
}

/// Adds the samples of one moment.
void Renderer::add_moment(const Scene& scene, const BuiltWorld& built, const Tiles& tiles,
                          const Sums& sums, RenderReport& report) {
    const Pyramid& world = built.pyramid;
    const Features features = features_shown(scene, world);
    const Camera observer = sums.camera(camera_of(scene, world.frame));
    ViewHits hits = begin_view(scene, built, features, observer.samples, tiles.share);
    report.hits_are_kept = hits.are_known;
    const uint32_t rays_per_tile = 16 * uint32_t(observer.samples);
    RayBatch batch = allocate_batch(device_, features, hits.in_batch * rays_per_tile);
    if (hits.are_known) batch.rays = {}, batch.hits = {};  // frees replaced buffers

    const uint64_t rays = uint64_t(tiles.share.tiles()) * rays_per_tile;
    const double pixel = voxels_a_pixel(scene, observer, world.frame);
    const std::optional<DilationLevel> dilated_occupancy =
        dilation_that_pays(features, world, rays, pixel);
    build_programs(device_, features, scene, world, true, dilated_occupancy.has_value());
    SightStage sight(device_, features, observer, scene.render.filter);
    if (!tiles.pixels.empty()) sight.choose(device_, tiles.pixels);
    const Camera shown = shown_camera(scene, observer, tiles);
    std::optional<BeamStage> beams;
    if (!hits.are_known && dilated_occupancy)
        beams.emplace(device_, features, world,
                      dilated_occupancy_of(built, *dilated_occupancy).dilated_occupancy);
    Illumination illumination(device_, features, scene, world, batch.stride);
    if (dilated_occupancy && lights_send_beams(features)) {
        const uint32_t max = light_beams_that_pay(world.frame, rays, observer.samples, pixel);
        send_light_beams(dilated_occupancy_of(built, *dilated_occupancy), max, illumination);
    }
    const bool adds = adds_samples(scene.render);
    ResolveStage resolve(device_, features, shown, scene.render.channels, sums.image, adds);
    MatteStage mattes(device_, features, shown, scene, sums.mattes, adds);
    while (const std::optional<TileRange> range = tiles.share.take(hits.in_batch)) {
        TakenTiles in_work(tiles.share, *range);
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
        in_work.set_done();
        note_done(*range, tiles, sums.part);
    }
    view_ = std::move(hits.view);
    note_counts(illumination, beams, world, report);
}

/// The scene at a moment with the changes that `asked` made, which may be a pass of the light. The
/// parts that a pass leaves out depend on the moment.
Scene Renderer::scene_of_moment(Scene now, const Scene& asked) const {
    const RenderSettings& render = asked.render;
    now.render = image_settings_;
    now.render.earlier = {};
    if (pass_) {
        const std::vector<LightPass> passes = light_passes(now);
        if (*pass_ < passes.size()) now = passes[*pass_].scene;
    }
    now.render.size = render.size;
    now.render.crop = render.crop;
    now.render.noise = render.noise;
    now.render.scatters_samples = render.scatters_samples;
    now.render.channels = render.channels;
    now.render.earlier = render.earlier;
    return now;
}

/// Adds the samples of all moments. Successive moments that show the same are rendered as one.
/// Returns the seconds of building their worlds.
double Renderer::add_moments(const Scene& scene, const Tiles& tiles, Sums& sums,
                             RenderReport& report) {
    double seconds = 0;
    const int first = scene.render.first_sample, end = first + scene.render.samples;
    Scene next = moments_->scene(first);
    for (int sample = first, after = first; sample < end; sample = after) {
        if (sample > first && tiles.taken.empty()) break;  // other devices have all tiles
        const Scene now = std::exchange(next, Scene());
        for (after = sample + 1; after < end; ++after) {
            next = moments_->scene(after);
            if (next != now) break;
        }
        Scene part = scene_of_moment(now, scene);
        part.render.first_sample = sample;
        part.render.samples = after - sample;
        part.render.all_samples = scene.render.samples;
        sums.after = end - after;
        sums.part = double(after - sample) / (end - first);
        Stopwatch building(seconds);
        const BuiltWorld& world = moments_->world(now);
        building.stop();
        TileShare again(tiles.share, tiles.taken, tiles.share.weight());
        std::vector<TileRange> taken;
        RenderReport of_moment;
        if (sample == first)
            add_moment(part, world, tiles, sums, of_moment);
        else
            add_moment(part, world, {again, taken, tiles.weight, tiles.pixels}, sums, of_moment);
        add_counts(of_moment, report);
        report.voxels = of_moment.voxels;
        report.world_bytes = of_moment.world_bytes;
        ++report.moments;
        sums.before += after - sample;
        sums.before_weight = 1;
    }
    return seconds;
}

Image Renderer::image_of_tiles(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                               const Tiles& tiles) {
    double seconds = 0;
    Stopwatch imaging(seconds);
    image_.reset();
    Sums sums = begin_sums(scene, tiles);
    if (moments_)
        seconds -= add_moments(scene, tiles, sums, report);
    else
        add_moment(scene, world, tiles, sums, report);
    Image image = image_in(sums.image, size_of(scene, tiles), scene.render.channels);
    add_mattes(sums.mattes, scene, image);
    image.first = scene.render.crop.first;
    image.frame = scene.render.crop.frame;
    report.not_finite = sums.image.not_finite.read_one(0);
    imaging.stop();
    report.image_seconds = seconds;
    return image;
}

}  // namespace voxelume
