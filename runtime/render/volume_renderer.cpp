// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/volume_renderer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "runtime/analysis/culling.hpp"
#include "runtime/analysis/volume_scene.hpp"
#include "runtime/base/error.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/render/illumination.hpp"
#include "runtime/render/smaller_batches.hpp"
#include "runtime/render/volume_lattice.hpp"
#include "runtime/stages/display/display_rays.hpp"
#include "runtime/stages/trace/beam.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

/// The observer's camera with one sight ray for each (u, v) of the display.
Camera display_sight(Scene scene, const VolumeFrame& frame, const GridFrame& world) {
    scene.render.size = {frame.size.x, frame.size.y};
    scene.render.crop = {};
    scene.render.samples = 1;
    return camera_of(scene, world);
}

void check_rays(const VolumeFrame& frame) {
    const uint64_t rays = uint64_t(frame.size.x) * uint64_t(frame.size.y);
    if (rays > UINT32_MAX / 2)
        throw Error(ErrorKind::limit,
                    "a display of {}x{} sight rays is too large: at most 2^31 can be numbered",
                    frame.size.x, frame.size.y);
}

void render_rays(VolumeWork& work, Volume& volume) {
    check_rays(work.frame);
    const uint32_t tiles = tile_count(work.camera.width, work.camera.height);
    const uint32_t in_batch = display_batch_tiles(work.device, work.features, tiles);
    RayBatch batch = allocate_batch(work.device, work.features, in_batch * 16);
    const double pixel = voxels_a_pixel(work.scene, work.camera, work.world.frame);
    const auto dilated_occupancy_of =
        dilation_that_pays(work.features, work.world, 16ull * tiles, pixel);
    build_programs(work.device, work.features, work.scene, work.world, false,
                   dilated_occupancy_of.has_value());
    SightStage camera(work.device, work.features, work.camera);
    std::optional<BeamStage> beams;
    VolumeLight light(work, batch.stride, uint32_t(work.camera.width + 3) / 4);
    Illumination& illumination = light.illumination();
    if (dilated_occupancy_of) {
        const DilatedOccupancy dilated_occupancy =
            build_dilated_occupancy(work.device, work.world, *dilated_occupancy_of);
        beams.emplace(work.device, work.features, work.world, dilated_occupancy);
        std::vector<LightBeams> sent;
        if (lights_send_beams(work.features))
            illumination.send_beams(dilated_occupancy,
                                    light_beams_that_pay(work.world.frame, 16ull * tiles, 1, pixel),
                                    sent);
    }
    DisplayRaysStage display(work.device, work.features, work.camera, work.frame,
                             work.scene.world.medium, environment_of(work.scene.world));
    SamplesByNoise by_noise(work.scene.render, 16ull * tiles);
    // Local light of one ray has no noise.
    if (work.features.global && is_sampled_by_noise(work.scene.render)) light.sample_by(by_noise);
    if (beams) light.send_beams_again(*beams);
    for (uint32_t first = 0; first < tiles; first += in_batch) {
        const uint32_t now = std::min(in_batch, tiles - first);
        const uint32_t rays = camera.cast(shape_of(work.world), first, now, batch);
        const auto keep_layer = [&](const RayBatch& entries, uint32_t count, bool is_first,
                                    const NodeLight& nodes) {
            display.keep_layer(work.world, illumination.density(),
                               {entries, count, is_first, nodes, first * 16});
        };
        if (beams) beams->start(batch, rays);
        light.set_part(double(first) / tiles, double(first + now) / tiles);
        light.mean(batch, {first * 16, rays}, keep_layer);
        if (!display.has_layers())
            display.keep(shape_of(work.world), batch, first * 16, rays);
        else if (!work.features.transmission)
            keep_layer(batch, rays, true, {batch.radiance, {}, batch.stride});
        work.report.sight_rays += rays;
        work.has_begun = true;
        share_compiled_kernels(work.device);
        work.advance(double(first + now) / tiles);
    }
    work.report.volume_noise = by_noise.reached();
    work.report.sight_rays += light.more_rays();
    count_rays(illumination, work.report);
    if (beams) {
        work.report.beams = beams->sent();
        work.report.clear_beams = beams->cleared();
    }
    display.read(volume);
}

/// The volumetric image without its attributes.
Volume volume_of(VolumeWork& work) {
    const RenderReport before = work.report;
    return with_batches_that_fit(
        work.device, [&] { return work.has_begun; },
        [&] {
            work.report = before;
            Volume volume;
            volume.frame = work.frame;
            if (work.frame.layout == VolumeLayout::rays)
                render_rays(work, volume);
            else
                render_lattice(work, volume);
            return volume;
        });
}

uint32_t count_not_finite(const Volume& volume) {
    return uint32_t(std::ranges::count_if(volume.colors, [](const glm::vec3& c) {
        return !std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z);
    }));
}

}  // namespace

Volume render_volume(const Device& device, const Scene& shown, const BuiltWorld& built,
                     RenderReport& report, const FrameProgress& progress) {
    const Pyramid& world = built.pyramid;
    const Scene scene = volume_scene(shown);
    const auto start = std::chrono::steady_clock::now();
    const VolumeFrame frame = display_frame(scene);
    VolumeWork work = {device, scene,
                       world,  volume_features(scene, world),
                       frame,  display_sight(scene, frame, world.frame),
                       report, progress};
    leave_out_solid_kinds(device, world, work.features);
    Volume volume = volume_of(work);
    device.finish();  // so that kernels' times are known
    share_compiled_kernels(device);
    report.not_finite = count_not_finite(volume);
    report.voxels = world.voxel_count;
    report.image_seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return volume;
}

std::shared_ptr<Volume> VolumeRenderer::volume(const Scene& scene, const BuiltWorld& world,
                                               RenderReport& report,
                                               const FrameProgress& progress) {
    const bool is_kept = volume_ && world_ == world.version && scene_ == scene;
    std::shared_ptr<Volume> volume = std::exchange(volume_, nullptr);
    if (!is_kept) {
        volume.reset();  // frees it before the next volume needs the memory
        report_ = {};
        volume = std::make_shared<Volume>(render_volume(device_, scene, world, report_, progress));
        report.image_seconds += report_.image_seconds;
    }
    add_counts(report_, report);
    for (const Warning& warning : report_.world.warnings) add_once(warning, report.world.warnings);
    report.voxels = report_.voxels;
    report.is_kept = report.hits_are_kept = is_kept;
    if (follows_) {
        scene_ = scene;
        world_ = world.version;
        volume_ = volume;
    }
    return volume;
}

Volume render_volume(const Device& device, const Scene& scene, RenderReport& report,
                     const FrameProgress& progress) {
    AssetStore meshes;
    const Scene shown = with_culling(volume_scene(scene), meshes);
    const BuiltWorld world =
        WorldBuilder(device, false, std::move(meshes)).build(shown, report.world);
    return render_volume(device, shown, world, report, progress);
}

}  // namespace voxelume
