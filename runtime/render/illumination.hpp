// SPDX-License-Identifier: Apache-2.0
// rays -> radiance: the surfaces that each ray meets, and the light along it. Blocks 3 to 9.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "runtime/analysis/medium_set.hpp"
#include "runtime/analysis/scene_features.hpp"
#include "runtime/analysis/scene_lights.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/light/area_light.hpp"
#include "runtime/stages/light/light.hpp"
#include "runtime/stages/light/light_beams.hpp"
#include "runtime/stages/light/light_tree.hpp"
#include "runtime/stages/light/shade.hpp"
#include "runtime/stages/light/sky_light.hpp"
#include "runtime/stages/medium/medium.hpp"
#include "runtime/stages/trace/extend.hpp"
#include "runtime/stages/trace/medium_paths.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"
#include "runtime/stages/trace/scatter.hpp"
#include "runtime/stages/trace/trace.hpp"

namespace voxelume {

/// Builds the programs of the stages that sight rays pass through as one program, since PoCL reads
/// its own megabyte of headers for each program. `makes_image` says that the rays end in a flat
/// image of the scene's channels, `has_dilated_occupancy` that lights may send beams.
void build_programs(const Device& device, const Features& features, const Scene& scene,
                    const Pyramid& world, bool makes_image, bool has_dilated_occupancy);

/// Traces and lights batches of rays. Flat and volumetric images share it.
///
/// In global light each sight ray begins one path, whose rays follow each other in dense batches.
/// In local light reflected and refracted rays are followed depth by depth, as the tree of Whitted
/// 1980, each depth as one dense batch. Rays that continue straight through surfaces are further
/// layers of their depth.
class Illumination {
  public:
    /// Prepares for batches of at most `max_rays` rays, a multiple of 16. The world must outlive
    /// it. For `compact` see ScatterStage.
    Illumination(const Device& device, const Features& features, const Scene& scene,
                 const Pyramid& world, uint32_t max_rays, bool compact = true);

    /// Sends beams from the lights, at most `maximum` from one. Shadow rays end where their light's
    /// beams tell that only empty space lies ahead. `sent` holds the beams that were sent through
    /// this dilated occupancy before, and afterwards those of these lights. Call it only for
    /// features with `lights_send_beams`.
    void send_beams(const DilatedOccupancy& dilated_occupancy, uint32_t maximum,
                    std::vector<LightBeams>& sent);

    /// Sets the pixels and samples to which the next batches' rays belong. Needed for global light
    /// only.
    void set_sampling(const PathSampling& sampling) { sampling_ = sampling; }

    /// Fills the hits of rays 0 .. count-1, which come from an observer, and those of their
    /// positions, normals, packed attributes and radiance that the features ask for. `sink` is
    /// called for each layer in scenes with `transmission`; in global light once, for the first.
    void light(RayBatch& batch, uint32_t count, const LayerSink& sink = {}) {
        light_all(batch, count, sink, false);
    }

    /// For features with `own_light`: calls `sink` for each layer of surfaces that the rays go
    /// straight through, with the layer's own light and coverage alone. Nodes of rays that don't
    /// come to a layer hold no light.
    void light_layers(RayBatch& batch, uint32_t count, const LayerSink& sink);

    /// Fills the same data for rays whose hits are known already.
    void light_hits(RayBatch& batch, uint32_t count) { light_all(batch, count, {}, true); }

    /// Fills only the hits, without light.
    void find_hits(RayBatch& batch, uint32_t count);

    const Features& features() const { return features_; }
    /// The medium's density grid; null if its density is 1 everywhere.
    const DensityGrid* density() const {
        return features_.medium_grid ? &medium_->density() : nullptr;
    }
    uint64_t shadow_rays() const;  ///< number of rays traced so far; waits for the device
    uint64_t secondary_rays() const { return secondary_rays_; }  ///< includes straight rays
    uint64_t light_beams() const { return light_beams_; }        ///< sent, without those retained
    uint64_t ended_paths() const { return scatter_ ? scatter_->ended() : 0; }
    /// The number of times a ray entered more overlapping objects than it can remember. Waits for
    /// the device.
    uint64_t medium_overflows() const;

  private:
    std::span<const LightTree> light_trees() const {
        return light_trees_ ? std::span(light_trees_->trees()) : std::span<const LightTree>();
    }
    void light_all(RayBatch& batch, uint32_t count, const LayerSink& sink, bool hits_are_known);
    void begin_paths(RayBatch& batch, uint32_t count);
    void direct(RayBatch& entries, uint32_t count, bool from_observer);
    void bring_light(RayBatch& entries, uint32_t count);
    void bring_light_of(size_t i, RayBatch& points, uint32_t count,
                        const std::function<void(const PathLight&)>& add);
    void trace_to_emitters(PathDepth& depth, uint32_t count);
    uint32_t scatter_in_medium(RayBatch& entries, uint32_t count, PathDepth& depth);
    void send_to_points(const PathLight& light, uint32_t count, PathDepth& depth);
    void light_near_points(RayBatch& entries, uint32_t count, bool is_first, PathDepth& depth);
    NextRays light_medium(uint32_t count, uint32_t taken, PathDepth& depth);
    void meet_lights(RayBatch& entries, uint32_t count, PathDepth& depth);
    void trace_paths(RayBatch& batch, uint32_t count, bool hits_are_known);
    void follow(size_t depth, RayBatch& first, uint32_t count, bool hits_are_known = false,
                const LayerSink& sink = {});
    void scatter(size_t depth, RayBatch& entries, uint32_t count);
    void reserve_depth(size_t number, uint32_t slots);

    Device device_;
    Features features_;
    const Pyramid& world_;
    std::vector<PathLight> lights_;  ///< without those of trees
    EmitterTable emitters_;          ///< only for features with `emitters`
    PathSampling sampling_{};
    std::vector<LightBeams> beams_;  ///< beams of each light; empty if no beams are sent
    uint32_t max_rays_;
    size_t max_depth_;
    TraceStage trace_;
    ShadeStage shade_;
    Surroundings surroundings_;
    std::optional<LightStage> lighting_;           ///< not compiled in a scene without lights
    std::optional<LightTreeStage> light_trees_;    ///< only for many lights in global light
    std::optional<AreaLightStage> area_lighting_;  ///< only for areas in global light
    std::optional<SkyLightStage> sky_lighting_;    ///< only for a sky in local light
    std::optional<MediumStage> medium_;            ///< not compiled if nothing absorbs
    std::optional<ScatterStage> scatter_;          ///< not compiled without paths
    std::optional<ExtendStage> extend_;            ///< only in global light
    std::optional<MediumPathStage> medium_paths_;  ///< only for media that scatter paths
    uint32_t sky_samples_;  ///< directions in which a surface point samples the sky
    ShadowQueue queue_;
    HollowObjects hollow_;  ///< only for observers inside media
    Buffer<uint32_t> hollow_flags_;
    std::vector<std::unique_ptr<PathDepth>> depths_;  ///< made when rays first come to them
    std::optional<LayerRays> layers_;                 ///< only for `light_layers`
    uint64_t secondary_rays_ = 0, light_beams_ = 0;
};

}  // namespace voxelume
