// SPDX-License-Identifier: Apache-2.0
// paths in a scattering medium -> the points where it scatters them, the light there, and the
// paths' next rays.
#pragma once

#include <optional>

#include "kernels/shared/paths.h"
#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/emitter_table.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/light_tree_table.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/medium_scattering.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/sky_map.hpp"
#include "runtime/stages/trace/extend.hpp"
#include "runtime/stages/trace/scatter.hpp"

namespace voxelume {

/// The kernels of light_tree_medium.cl.
struct ChosenLightKernels {
    Program program;
    Kernel find, add;
};

/// The kernels of near_light.cl.
struct NearLightKernels {
    Program program;
    Kernel find, add;
};

/// The kernels of medium_paths.cl, near_light.cl and light_tree_medium.cl for one feature set with
/// `scattering`.
class MediumPathStage {
  public:
    /// `absorption` is the medium's, per metre at density 1.
    MediumPathStage(const Device& device, const Features& features, const float4& absorption,
                    const MediumScattering& scattering, DensityGrid density);

    /// Sets the sky to which paths send rays. Needed for features with `sky_rays` only.
    void set_sky(SkyMap sky) { sky_ = std::move(sky); }

    /// Finds those of entries 0 .. count-1, whose hits are known, that are scattered before their
    /// hits. Marks the entries, and writes the scattering points to `points`, which has room for
    /// all. Returns their number.
    uint32_t scatter(const Pyramid& pyramid, const PathSampling& sampling, RayBatch& entries,
                     uint32_t count, RayBatch& points);

    /// Chooses points near a light along entries 0 .. count-1, whose hits are known, and writes
    /// them to `points`. Returns their number. Call it for rays that begin their paths (`is_first`)
    /// at any time, for others before `scatter`, and only for features with `near_light`.
    uint32_t near(const Pyramid& pyramid, const LightRecord& light, const PathSampling& sampling,
                  bool is_first, RayBatch& entries, uint32_t count, RayBatch& points);
    /// Does the same for a light of the tree, which each of the entries chooses. Call it only for
    /// features with `chosen_lights`, too.
    uint32_t near_chosen(const Pyramid& pyramid, const LightTree& tree,
                         const PathSampling& sampling, bool is_first, RayBatch& entries,
                         uint32_t count, RayBatch& points);
    /// Adds the light of these points to the nodes of their sight rays.
    void add_near(RayBatch& points, uint32_t count, NodeLight& nodes);

    /// Queues rays from points 0 .. count-1 to a light without an area, or to an area light.
    void add_light(const Pyramid& pyramid, const LightRecord& light, RayBatch& points,
                   uint32_t count, ShadowQueue& queue);
    void add_area_light(const Pyramid& pyramid, const LightRecord& light,
                        const LightAreaRecord& area, const PathSampling& sampling, uint32_t number,
                        RayBatch& points, uint32_t count, ShadowQueue& queue);

    /// Queues a ray from each of the points to a light of the tree: to the one near which
    /// near_chosen() has found the point if `are_near`, else to one that the point chooses. Call it
    /// only for features with `chosen_lights`.
    void add_chosen_light(const Pyramid& pyramid, const LightTree& tree,
                          const PathSampling& sampling, bool are_near, RayBatch& points,
                          uint32_t count, ShadowQueue& queue);

    /// Adds the light of points 0 .. count-1 to the nodes of their sight rays, and writes the next
    /// rays of their paths to `next`, behind `taken` rays, and those to emitters or to the sky to
    /// `to_emitters`. Both have room for them.
    NextRays paths(const Pyramid& pyramid, const PathSampling& sampling,
                   const EmitterTable& emitters, RayBatch& points, uint32_t count, NodeLight& nodes,
                   RayQueue& next, uint32_t taken, RayQueue& to_emitters);

  private:
    /// Runs a kernel that finds points near `lights`, one light or a tree. Returns their number.
    template <class Lights>
    uint32_t find_near(Kernel& kernel, const Pyramid& pyramid, const Lights& lights,
                       const PathSampling& sampling, bool is_first, RayBatch& entries,
                       uint32_t count, RayBatch& points);

    float4 absorption_;
    MediumScattering scattering_;
    DensityGrid density_;
    SkyMap sky_;
    Buffer<uint32_t> counters_;
    Program program_;
    Kernel scatter_, add_light_;
    std::optional<Kernel> add_area_light_;  ///< only for features with `area_samples`
    Kernel extend_;
    std::optional<NearLightKernels> near_;      ///< only for features with `near_light`
    std::optional<ChosenLightKernels> chosen_;  ///< only for features with `chosen_lights`
};

}  // namespace voxelume
