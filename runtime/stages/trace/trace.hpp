// SPDX-License-Identifier: Apache-2.0
// rays -> hits: the discrete traversal of every ray to the first surface it meets.
#pragma once

#include <optional>

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/grid/grid_arguments.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// The features that the pyramid decides.
Features features_of(const Pyramid& pyramid);

/// Leaves the kinds of solids out that the pyramid hasn't, where the device's compiler takes long
/// for them: NVIDIA's. PoCL's doesn't, and scenes that differ in kinds share kernels there.
void leave_out_solid_kinds(const Device& device, const Pyramid& pyramid, Features& features);

/// The data on surfaces and the medium that rays need to continue through surfaces.
struct Surroundings {
    Buffer<MaterialRecord> materials;
    Buffer<uint32_t> ranks;  ///< see ShadeStage
    Buffer<uint32_t>
        medium_overflows{};  ///< one number, only in `medium_set_capped` scenes: how often a ray
                             ///< entered more objects at once than its set has room for
    float4 absorption{};     ///< absorption of the medium, per metre
    DensityGrid density{};   ///< ... and its density, if that isn't 1 everywhere
};

/// VXL_SURROUNDINGS_PARAMETERS of kernels.
void bind(KernelArguments& to, const Surroundings& surroundings);

/// The kernels of trace.cl for one feature set: the paper's blocks 2, 3 and 4.2.
class TraceStage {
  public:
    TraceStage(const Device& device, const Features& features);

    /// Finds the first hit of rays 0 .. count-1 of the batch. `scattered` says that neighbouring
    /// rays have different directions, as reflected and refracted ones have. Hits don't depend on
    /// it.
    void closest(const Pyramid& pyramid, RayBatch& batch, uint32_t count, bool scattered = false);

    /// Completes the medium sets of rays 0 .. count-1, which come from an observer, with the smooth
    /// body and the exact meshes that the observer is inside of: those whose back a ray meets
    /// before their front. `hollow` says for each object whether it is tested; `max_hollow` is the
    /// maximum number of them that a ray could be in, where all smooth ones count as one. Only for
    /// `observer_in_medium` features.
    void begin_inside(const Pyramid& pyramid, const Surroundings& surroundings,
                      const Buffer<uint32_t>& hollow, uint32_t max_hollow, RayBatch& batch,
                      uint32_t count);

    /// Traces at most `maximum` rays of the queue, which were sent from the batch. Lights that are
    /// visible add their share to the batch's radiance.
    void shadows(const Pyramid& pyramid, const Surroundings& surroundings, const ShadowQueue& queue,
                 uint32_t maximum, RayBatch& batch);

  private:
    // The number of packets per work-item of `scattered_`, of `closest_` and of `shadows_`.
    size_t packets_, interleaved_, shadow_packets_;
    Program program_;
    Kernel closest_, shadows_;
    std::optional<Kernel> scattered_;  ///< where VXL_REFILLS_LANES
    std::optional<Kernel> inside_;     ///< only for observers inside media
};

}  // namespace voxelume
