// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/volume_renderer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "runtime/analysis/culling.hpp"
#include "runtime/analysis/medium_set.hpp"
#include "runtime/base/error.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/render/illumination.hpp"
#include "runtime/stages/display/display_cover.hpp"
#include "runtime/stages/display/display_lattice.hpp"
#include "runtime/stages/display/display_rays.hpp"
#include "runtime/stages/display/display_samples.hpp"
#include "runtime/stages/trace/beam.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

/// The scene with the default channels and in local light; what it asks for are a flat image's.
Scene with_all_channels(Scene scene) {
    scene.render.light = LightMode::local;
    scene.observer.aperture = 0;
    scene.render.filter = {};
    scene.render.channels = {};
    return scene;
}

/// The data that both layouts work with.
struct Work {
    const Device& device;
    const Scene& scene;
    const Pyramid& world;
    Features features;
    VolumeFrame frame;
    Camera camera;
    RenderReport& report;
    const FrameProgress& progress;
};

/// The features of the lattice's kernels. If the medium's density varies, the little of it that
/// lies between a light ray's start and its surface stays in the colours.
Features without_varying_medium(Features features) {
    features.medium = features.medium && !features.medium_grid;
    features.medium_grid = false;
    return features;
}

/// A scene with the same surfaces but without light: it only tells how much they cover.
Scene without_light(Scene scene) {
    scene.lights.clear();
    scene.world.medium = {};
    scene.world.sky.reset();
    scene.render.depth = 0;
    for (Material& material : scene.materials) material.emission = glm::vec3(0);
    return scene;
}

/// The features with which rays fill the coverage, too, even without opacities in the scene.
/// Refracting surfaces cover everything behind them.
Features with_transmission(Features features, const Scene& scene, const Pyramid& world) {
    features.paths = features.transmission = true;
    add_medium_set(scene, world, features);
    return begun_anywhere(features, scene);
}

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

void count_rays(const Illumination& illumination, RenderReport& report) {
    report.shadow_rays = illumination.shadow_rays();
    report.light_beams = illumination.light_beams();
    report.secondary_rays = illumination.secondary_rays();
    report.ended_paths = illumination.ended_paths();
    report.medium_overflows = illumination.medium_overflows();
}

void render_rays(Work& work, Volume& volume) {
    check_rays(work.frame);
    const uint32_t tiles = tile_count(work.camera.width, work.camera.height);
    const uint32_t in_batch = batch_tiles(work.device, work.features, 1, tiles);
    RayBatch batch = allocate_batch(work.device, work.features, in_batch * 16);
    const double pixel = voxels_a_pixel(work.scene, work.camera, work.world.frame);
    const auto dilated_occupancy_of =
        dilation_that_pays(work.features, work.world, 16ull * tiles, pixel);
    build_programs(work.device, work.features, work.scene, work.world, false,
                   dilated_occupancy_of.has_value());
    SightStage camera(work.device, work.features, work.camera);
    std::optional<BeamStage> beams;
    Illumination illumination(work.device, work.features, work.scene, work.world, batch.stride);
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
    for (uint32_t first = 0; first < tiles; first += in_batch) {
        const uint32_t now = std::min(in_batch, tiles - first);
        const uint32_t rays = camera.cast(shape_of(work.world), first, now, batch);
        const auto keep_layer = [&](const RayBatch& entries, uint32_t count, bool is_first,
                                    const NodeLight& nodes) {
            display.keep_layer(work.world, illumination.density(),
                               {entries, count, is_first, nodes, first * 16});
        };
        if (beams) beams->start(batch, rays);
        illumination.light(batch, rays, keep_layer);
        if (!display.has_layers())
            display.keep(shape_of(work.world), batch, first * 16, rays);
        else if (!work.features.transmission)
            keep_layer(batch, rays, true, {batch.radiance, {}, batch.stride});
        work.report.sight_rays += rays;
        share_compiled_kernels(work.device);
        if (work.progress) {
            work.device.finish();
            work.progress(first + now, tiles);
        }
    }
    count_rays(illumination, work.report);
    if (beams) {
        work.report.beams = beams->sent();
        work.report.clear_beams = beams->cleared();
    }
    display.read(volume);
}

/// Leaves out voxels of which no ray meets a surface.
void leave_out_unlit(Volume& volume) {
    size_t kept = 0;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        if (volume.objects[i] == 0) continue;
        volume.indices[kept] = volume.indices[i];
        volume.colors[kept] = volume.colors[i];
        volume.opacities[kept] = volume.opacities[i];
        volume.depths[kept] = volume.depths[i];
        volume.objects[kept] = volume.objects[i];
        volume.kinds[kept++] = volume.kinds[i];
    }
    volume.indices.resize(kept);
    volume.colors.resize(kept);
    volume.opacities.resize(kept);
    volume.depths.resize(kept);
    volume.objects.resize(kept);
    volume.kinds.resize(kept);
}

void render_lattice(Work& work, Volume& volume) {
    work.features = begun_anywhere(work.features, work.scene);
    RayBatch batch =
        allocate_batch(work.device, work.features, batch_rays(work.device, work.features));
    // Finding surfaces needs only their geometry, and what hides them.
    Features geometry = features_of(work.world);
    geometry.transmission = work.features.transmission;
    DisplayScanStage scan(
        work.device, geometry, work.frame, work.world.frame,
        geometry.transmission ? line_surfaces(work.device, work.scene) : LineSurfaces());
    DisplayLatticeStage display(work.device, without_varying_medium(work.features), work.camera,
                                work.frame, work.world);
    const auto report_progress = [&work](uint32_t done) {
        if (!work.progress) return;
        work.device.finish();
        work.progress(done, 3);
    };
    std::vector<ProbePoints> pieces = scan.scan(work.world, batch);
    report_progress(1);
    build_programs(work.device, work.features, work.scene, work.world, false, false);
    Illumination illumination(work.device, work.features, work.scene, work.world, batch.stride);
    LookAhead look = [&](RayBatch& rays, uint32_t count) { illumination.find_hits(rays, count); };
    std::optional<Illumination> clear;
    if (work.features.transmission) {
        const Scene dark = without_light(work.scene);
        clear.emplace(work.device,
                      with_transmission(features_of(dark, work.world), dark, work.world), dark,
                      work.world, batch.stride);
        look = [&](RayBatch& rays, uint32_t count) { clear->light(rays, count); };
    }
    display.find_views(look, batch, pieces);
    ShownVoxels shown = display.choose(pieces, work.scene.render.samples);
    report_progress(2);
    pieces.clear();
    const LightRays light_rays = [&](RayBatch& rays, uint32_t count, const LayerSink& sink) {
        illumination.light(rays, count, sink);
    };
    const Environment environment = environment_of(work.scene.world);
    display.light(look, light_rays, environment, batch, shown);
    std::optional<DisplaySampleStage> samples;
    if (work.scene.render.samples > 1 && shown.voxels.count > 0) {
        samples.emplace(work.device, without_varying_medium(work.features), work.camera, work.frame,
                        work.world, work.scene.render.samples);
        samples->light(light_rays, environment, display.views(), batch, shown);
    }
    std::optional<DisplayCoverStage> cover;
    if (work.features.transmission && shown.voxels.count > 0) {
        cover.emplace(work.device, geometry, work.frame, work.world.frame, shown);
        scan.scan_covers(work.frame, work.world, batch, [&](int axis, const LinePoints& lines) {
            cover->add(axis, lines, scan.surfaces(), display.mask());
        });
    }
    report_progress(3);
    work.report.display_lines = scan.lines();
    work.report.clear_display_lines = scan.clear_lines();
    work.report.sight_rays += scan.lines() + display.rays() + (samples ? samples->rays() : 0);
    count_rays(illumination, work.report);
    read_voxels(shown.voxels, volume);
    if (cover)
        cover->adjust({scan.cover_lines(0), scan.cover_lines(1), scan.cover_lines(2)}, volume);
    leave_out_unlit(volume);
}

uint32_t count_not_finite(const Volume& volume) {
    return uint32_t(std::ranges::count_if(volume.colors, [](const glm::vec3& c) {
        return !std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z);
    }));
}

}  // namespace

Volume render_volume(const Device& device, const Scene& shown, const BuiltWorld& built,
                     RenderReport& report, const FrameProgress& progress) {
    const Scene scene = with_all_channels(shown);
    const Pyramid& world = built.pyramid;
    const auto start = std::chrono::steady_clock::now();
    const VolumeFrame frame = display_frame(scene);
    Work work = {device, scene,
                 world,  features_of(scene, world),
                 frame,  display_sight(scene, frame, world.frame),
                 report, progress};
    leave_out_solid_kinds(device, world, work.features);
    Volume volume;
    volume.frame = frame;
    if (frame.layout == VolumeLayout::rays)
        render_rays(work, volume);
    else
        render_lattice(work, volume);
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
    const Scene shown = with_culling(with_all_channels(scene), meshes);
    const BuiltWorld world =
        WorldBuilder(device, false, std::move(meshes)).build(shown, report.world);
    return render_volume(device, shown, world, report, progress);
}

}  // namespace voxelume
