// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/volume_lattice.hpp"

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "runtime/analysis/coverage.hpp"
#include "runtime/analysis/medium_set.hpp"
#include "runtime/analysis/volume_scene.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/render/volume_samples.hpp"
#include "runtime/stages/display/display_cover.hpp"
#include "runtime/stages/display/display_lattice.hpp"
#include "runtime/stages/display/display_medium.hpp"
#include "runtime/stages/display/display_samples.hpp"

namespace voxelume {
namespace {

/// Leaves out voxels whose rays meet no surface.
void leave_out_unlit(Volume& volume) {
    Volume lit;
    lit.frame = volume.frame;
    lit.attributes = std::move(volume.attributes);
    for (size_t i = 0; i < volume.indices.size(); ++i)
        if (volume.objects[i] != 0) lit.append(volume, i);
    volume = std::move(lit);
}

/// The middles of voxels, in voxel coordinates.
std::vector<glm::vec3> middles_of(const VolumeFrame& frame, std::span<const uint64_t> indices) {
    std::vector<glm::vec3> middles;
    middles.reserve(indices.size());
    for (const uint64_t index : indices) middles.push_back(glm::vec3(cell_of(frame, index)) + 0.5f);
    return middles;
}

/// About the number of rays that one sample of all voxels takes: of the surfaces along each axis.
uint64_t sampled_rays(const ShownVoxels& shown) {
    uint64_t sum = 0;
    for (const ProbePoints& points : shown.of_axes) sum += points_seen(points, 0, points.count);
    return sum;
}

/// Throws Error::limit if memory doesn't suffice for `count` voxels of a medium.
void check_medium_voxels(uint64_t count, const VolumeFrame& frame) {
    constexpr double kBytes = 2 * 33 + 20;  // for a voxel while two volumes are merged
    const double needed = double(count) * kBytes, there = double(main_memory());
    if (count < UINT32_MAX && needed < there) return;
    throw Error(ErrorKind::limit,
                "a lattice of {}x{}x{} display voxels, of which more than {} hold medium, needs "
                "more than {:.1f} GB of main memory, which has {:.1f} GB: use fewer display voxels",
                frame.size.x, frame.size.y, frame.size.z, count - 1, needed / 1e9, there / 1e9);
}

/// The width, in tiles, of the image by whose pixels a lattice's points are numbered.
constexpr uint32_t kTilesAcross = 4096;

/// The steps of one image. Their order is that of LatticeRender::run.
class LatticeRender {
  public:
    explicit LatticeRender(VolumeWork& work)
        : work_(work),
          batch_(
              allocate_batch(work.device, work.features, batch_rays(work.device, work.features))),
          geometry_(geometry_of(work)),
          scan_(work.device, geometry_, work.frame, work.world.frame,
                geometry_.transmission ? line_surfaces(work.device, work.scene) : LineSurfaces()),
          display_(work.device, work.features, work.camera, work.frame, work.world) {}

    void run(Volume& volume) {
        std::vector<ProbePoints> pieces = scan_.scan(work_.world, batch_);
        tell_progress(1);
        prepare_light();
        display_.find_views(look_, batch_, pieces);
        ShownVoxels shown = display_.choose(pieces, work_.scene.render.samples);
        tell_progress(2);
        pieces.clear();
        light(shown);
        const std::optional<DisplayCoverStage> covers = cover(shown);
        read_voxels(shown.voxels, volume);
        if (covers)
            covers->adjust({scan_.cover_lines(0), scan_.cover_lines(1), scan_.cover_lines(2)},
                           volume);
        leave_out_unlit(volume);
        if (shows_medium()) add_medium(volume);
        work_.advance(1);
        count();
    }

  private:
    /// The features for finding surfaces, which needs only geometry and opacity.
    static Features geometry_of(const VolumeWork& work) {
        Features geometry = features_of(work.world);
        geometry.transmission = work.features.transmission;
        return geometry;
    }

    /// Finding points and views of them takes about as long as lighting one sample of each, and so
    /// does the rest.
    void tell_progress(double steps) const {
        const int samples = work_.scene.render.samples;
        work_.has_begun = true;
        work_.advance(steps / (3 + (samples > 1 ? samples : 0)));
    }

    /// Prepares lighting of points, and `look_`, which finds what hides them.
    void prepare_light() {
        build_programs(work_.device, work_.features, work_.scene, work_.world, false, false);
        lit_.emplace(work_, batch_.stride, kTilesAcross);
        look_ = [this](RayBatch& rays, uint32_t count) {
            lit_->illumination().find_hits(rays, count);
        };
        if (!work_.features.transmission) return;
        const Scene unlit = unlit_scene(work_.scene);
        unlit_.emplace(work_.device, coverage_features(unlit, work_.world), unlit, work_.world,
                       batch_.stride);
        look_ = [this](RayBatch& rays, uint32_t count) { unlit_->light(rays, count); };
    }

    void light(ShownVoxels& shown) {
        const LightRays light_rays = [this](RayBatch& rays, const SampledRays& which,
                                            const LayerSink& sink) {
            lit_->sample(rays, which, sink);
        };
        const DensityGrid* const density = lit_->illumination().density();
        const SpaceMedium medium{environment_of(work_.scene.world),
                                 density ? *density : DensityGrid()};
        const int samples = work_.scene.render.samples;
        display_.light(look_, light_rays, medium, batch_, shown,
                       samples == 1 || !work_.features.global);
        if (samples > 1 && shown.voxels.count > 0) light_samples(light_rays, medium, shown);
    }

    void light_samples(const LightRays& light_rays, const SpaceMedium& medium, ShownVoxels& shown) {
        DisplaySampleStage stage(work_.device, work_.features, work_.camera, work_.frame,
                                 work_.world, work_.scene.render.samples);
        const bool is_global = work_.features.global;
        SampleLighting with{light_rays, medium, display_.views(), {}, {}};
        with.progress = [this](double part) {
            tell_progress(2 + part * work_.scene.render.samples);
        };
        if (is_sampled_by_noise(work_.scene.render)) {
            SamplesByNoise& by_noise = by_noise_.emplace(work_.scene.render, sampled_rays(shown));
            lit_->sample_by(by_noise);
            with.needed = [&](uint32_t count, uint32_t aimed, const LightSamples& of) {
                return by_noise.mean(count, aimed, of);
            };
        }
        stage.light(with, batch_, shown, is_global);
        sample_rays_ = stage.rays();
        if (is_global) {
            const LightRays mean_rays = [this](RayBatch& rays, const SampledRays& which,
                                               const LayerSink& sink) {
                lit_->mean(rays, which, sink);
            };
            display_.light_rest(look_, mean_rays, medium, batch_, shown);
        }
        if (by_noise_) work_.report.volume_noise = by_noise_->reached();
    }

    /// Measures how much of each voxel transparent surfaces cover, in scenes that have some.
    std::optional<DisplayCoverStage> cover(const ShownVoxels& shown) {
        std::optional<DisplayCoverStage> stage;
        if (!work_.features.transmission || shown.voxels.count == 0) return stage;
        stage.emplace(work_.device, geometry_, work_.frame, work_.world.frame, shown);
        scan_.scan_covers(work_.frame, work_.world, batch_, [&](int axis, const LinePoints& lines) {
            stage->add(axis, lines, scan_.surfaces(), display_.mask());
        });
        return stage;
    }

    bool shows_medium() const {
        return work_.features.medium &&
               display_steps(work_.frame, work_.scene.world.medium).absorption > 0;
    }

    /// Adds the voxels of space in which the medium can be seen.
    void add_medium(Volume& volume) {
        if (unlit_) {
            display_.leave_out_objects(batch_);
            look_ = [this](RayBatch& rays, uint32_t count) {
                unlit_->light(
                    rays, count,
                    [this](const RayBatch& entries, uint32_t number, bool is_first,
                           const NodeLight&) { display_.note_objects(entries, number, is_first); });
            };
        }
        const DensityGrid* const density = lit_->illumination().density();
        DisplayMediumStage stage(work_.device, work_.features, work_.frame, work_.world);
        const bool is_hidden =
            work_.world.voxel_count > 0 && work_.frame.display.visibility != Visibility::all;
        MediumVoxels seen;
        stage.measure(density ? *density : DensityGrid(), [&](const MediumVoxels& voxels) {
            std::vector<bool> visible(voxels.indices.size(), true);
            if (is_hidden)
                visible =
                    display_.are_visible(look_, batch_, middles_of(work_.frame, voxels.indices));
            for (size_t i = 0; i < visible.size(); ++i)
                if (visible[i]) append(voxels, i, seen);
            check_medium_voxels(seen.indices.size(), work_.frame);
        });
        add_medium_voxels(seen, work_.scene.world.medium, volume);
    }

    void count() const {
        work_.report.display_lines = scan_.lines();
        work_.report.clear_display_lines = scan_.clear_lines();
        work_.report.sight_rays +=
            scan_.lines() + display_.rays() + sample_rays_ + lit_->more_rays();
        count_rays(lit_->illumination(), work_.report);
    }

    VolumeWork& work_;
    RayBatch batch_;
    Features geometry_;
    DisplayScanStage scan_;
    DisplayLatticeStage display_;
    std::optional<SamplesByNoise> by_noise_;
    std::optional<VolumeLight> lit_;
    std::optional<Illumination> unlit_;  ///< where surfaces let light through
    LookAhead look_;
    uint64_t sample_rays_ = 0;
};

}  // namespace

void render_lattice(VolumeWork& work, Volume& volume) {
    work.features = begun_anywhere(work.features, work.scene);
    LatticeRender(work).run(volume);
}

}  // namespace voxelume
