// SPDX-License-Identifier: Apache-2.0
// rays of a display -> their light, for both layouts of volumetric images.
#pragma once

#include <optional>
#include <span>

#include "runtime/image/volume.hpp"
#include "runtime/render/illumination.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/render/volume_samples.hpp"
#include "runtime/stages/display/display_lattice.hpp"
#include "runtime/stages/display/display_mean.hpp"
#include "runtime/stages/trace/beam.hpp"

namespace voxelume {

/// The data that both layouts work with.
struct VolumeWork {
    const Device& device;
    const Scene& scene;
    const Pyramid& world;
    Features features;
    VolumeFrame frame;
    Camera camera;
    RenderReport& report;
    const FrameProgress& progress;
    bool has_begun = false;  ///< a part of it is done
    double done = 0;         ///< the part that was told last

    /// Tells that this part of the image is done, after all enqueued work.
    void advance(double part);
    /// Tells the same as before, so that who wants the image no longer can say so.
    void go_on() const;
};

/// The numbers of the rays that illumination has sent.
void count_rays(const Illumination& illumination, RenderReport& report);

/// Lights the rays of a volumetric image, in global light by paths.
class VolumeLight {
  public:
    /// Takes batches of at most `max_rays`. In global light rays are numbered as the pixels of an
    /// image of `tiles_across` tiles side by side.
    VolumeLight(VolumeWork& work, uint32_t max_rays, uint32_t tiles_across);

    /// The number of rays that `mean` has sent besides those that it got.
    uint64_t more_rays() const { return more_rays_; }

    Illumination& illumination() { return illumination_; }
    const Illumination& illumination() const { return illumination_; }

    /// From now on `mean` takes the samples that `needed` asks for.
    void sample_by(SamplesByNoise& needed) { needed_ = &needed; }
    /// Rays have beams, which are sent again for copies of them.
    void send_beams_again(BeamStage& beams) { beams_ = &beams; }
    /// The rays of the next call of a mean are this part of the image, of which a part was done.
    void set_part(double begin, double end) {
        begin_ = begin;
        end_ = end;
    }

    /// Lights samples of the light of rays.
    void sample(RayBatch& batch, const SampledRays& rays, const LayerSink& sink);

    /// Lights rays. In global light, a ray gets the mean over the scene's samples, or over those
    /// that it needs. In a display of rays, `sink` is called for each layer of surfaces that let
    /// light through, with the mean of its own light.
    void mean(RayBatch& batch, const SampledRays& rays, const LayerSink& sink);

  private:
    struct CopiedRays;
    /// For each layer three sums of light for each ray.
    using LayerSums = std::vector<std::vector<float>>;
    struct LightSums {
        std::span<float> of_rays;  ///< four: three of light, and of hits
        LayerSums* of_layers;      ///< null: only the light of the first surfaces is wanted
    };

    void set_sampling(const SampledRays& rays);
    void mean_of_fixed(RayBatch& batch, const SampledRays& rays);
    void mean_of_layers(RayBatch& batch, const SampledRays& rays, const LayerSink& sink);
    void mean_by_noise(RayBatch& batch, const SampledRays& rays);
    std::vector<float> means(RayBatch& batch, const SampledRays& rays, LayerSums* of_layers);
    void add_samples(RayBatch& batch, const SampledRays& rays, uint32_t first,
                     std::span<const float> aimed, LightSums& sums);
    void add_lit(RayBatch& batch, uint32_t all, const CopiedRays& ray_of, LightSums& sums);

    void tell_progress(uint32_t done, uint32_t samples);

    VolumeWork& work_;
    bool transmission_, keeps_layers_;
    uint32_t samples_;
    PathSampling sampling_;  ///< sampling of the first path of ray 0
    Illumination illumination_;
    std::optional<DisplayMeanStage> mean_;  ///< only for a fixed number of paths of a ray
    SamplesByNoise* needed_ = nullptr;
    BeamStage* beams_ = nullptr;
    uint64_t more_rays_ = 0;
    double begin_ = 0, end_ = 0;  ///< see `set_part`; equal: progress isn't known
};

}  // namespace voxelume
