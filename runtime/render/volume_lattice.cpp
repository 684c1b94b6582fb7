// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/volume_lattice.hpp"

#include <optional>
#include <span>
#include <vector>

#include "runtime/analysis/medium_set.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/stages/display/display_cover.hpp"
#include "runtime/stages/display/display_lattice.hpp"
#include "runtime/stages/display/display_medium.hpp"
#include "runtime/stages/display/display_samples.hpp"

namespace voxelume {
namespace {

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

/// The middles of voxels, in voxels.
std::vector<glm::vec3> middles_of(const VolumeFrame& frame, std::span<const uint64_t> indices) {
    std::vector<glm::vec3> middles;
    middles.reserve(indices.size());
    for (const uint64_t index : indices) middles.push_back(glm::vec3(cell_of(frame, index)) + 0.5f);
    return middles;
}

/// Throws Error::limit where so many voxels of a medium have no room.
void check_medium_voxels(uint64_t count, const VolumeFrame& frame) {
    constexpr double kBytes = 2 * 33 + 20;  // of a voxel, while two volumes are made one
    const double needed = double(count) * kBytes, there = double(main_memory());
    if (count < UINT32_MAX && needed < there) return;
    throw Error(ErrorKind::limit,
                "a lattice of {}x{}x{} display voxels, of which more than {} hold medium, needs "
                "more than {:.1f} GB of main memory, which has {:.1f} GB: use fewer display voxels",
                frame.size.x, frame.size.y, frame.size.z, count - 1, needed / 1e9, there / 1e9);
}

/// Adds the voxels of space in which the medium can be seen. `look` finds what hides their
/// middles.
void add_medium(const VolumeWork& work, const DensityGrid& density, DisplayLatticeStage& display,
                const LookAhead& look, RayBatch& batch, Volume& volume) {
    DisplayMediumStage stage(work.device, work.features, work.frame, work.world);
    const bool is_hidden =
        work.world.voxel_count > 0 && work.frame.display.visibility != Visibility::all;
    MediumVoxels seen;
    stage.measure(density, [&](const MediumVoxels& voxels) {
        std::vector<bool> visible(voxels.indices.size(), true);
        if (is_hidden)
            visible = display.are_visible(look, batch, middles_of(work.frame, voxels.indices));
        for (size_t i = 0; i < visible.size(); ++i)
            if (visible[i]) append(voxels, i, seen);
        check_medium_voxels(seen.indices.size(), work.frame);
    });
    add_medium_voxels(seen, work.scene.world.medium, volume);
}

}  // namespace

void count_rays(const Illumination& illumination, RenderReport& report) {
    report.shadow_rays = illumination.shadow_rays();
    report.light_beams = illumination.light_beams();
    report.secondary_rays = illumination.secondary_rays();
    report.ended_paths = illumination.ended_paths();
    report.medium_overflows = illumination.medium_overflows();
}

void render_lattice(VolumeWork& work, Volume& volume) {
    work.features = begun_anywhere(work.features, work.scene);
    RayBatch batch =
        allocate_batch(work.device, work.features, batch_rays(work.device, work.features));
    // Finding surfaces needs only their geometry, and what hides them.
    Features geometry = features_of(work.world);
    geometry.transmission = work.features.transmission;
    DisplayScanStage scan(
        work.device, geometry, work.frame, work.world.frame,
        geometry.transmission ? line_surfaces(work.device, work.scene) : LineSurfaces());
    DisplayLatticeStage display(work.device, work.features, work.camera, work.frame, work.world);
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
    const DensityGrid* const density = illumination.density();
    const SpaceMedium medium{environment_of(work.scene.world), density ? *density : DensityGrid()};
    display.light(look, light_rays, medium, batch, shown);
    std::optional<DisplaySampleStage> samples;
    if (work.scene.render.samples > 1 && shown.voxels.count > 0) {
        samples.emplace(work.device, work.features, work.camera, work.frame, work.world,
                        work.scene.render.samples);
        samples->light(light_rays, medium, display.views(), batch, shown);
    }
    std::optional<DisplayCoverStage> cover;
    if (work.features.transmission && shown.voxels.count > 0) {
        cover.emplace(work.device, geometry, work.frame, work.world.frame, shown);
        scan.scan_covers(work.frame, work.world, batch, [&](int axis, const LinePoints& lines) {
            cover->add(axis, lines, scan.surfaces(), display.mask());
        });
    }
    read_voxels(shown.voxels, volume);
    if (cover)
        cover->adjust({scan.cover_lines(0), scan.cover_lines(1), scan.cover_lines(2)}, volume);
    leave_out_unlit(volume);
    if (work.features.medium && display_steps(work.frame, work.scene.world.medium).absorption > 0) {
        if (clear) {
            display.leave_out_objects(batch);
            look = [&](RayBatch& rays, uint32_t count) {
                clear->light(
                    rays, count,
                    [&](const RayBatch& entries, uint32_t number, bool is_first, const NodeLight&) {
                        display.note_objects(entries, number, is_first);
                    });
            };
        }
        add_medium(work, medium.density, display, look, batch, volume);
    }
    report_progress(3);
    work.report.display_lines = scan.lines();
    work.report.clear_display_lines = scan.clear_lines();
    work.report.sight_rays += scan.lines() + display.rays() + (samples ? samples->rays() : 0);
    count_rays(illumination, work.report);
}

}  // namespace voxelume
