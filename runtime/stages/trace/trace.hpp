// rays -> hits: the discrete walk of every ray to the first surface it meets.
#pragma once

#include <optional>

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// The pyramid's shape as kernels take it: its size, edges, and the fixed point of rays through it.
PyramidShape shape_of(const Pyramid& pyramid);

/// The numbers of a hit's feature set that the pyramid decides.
Features features_of(const Pyramid& pyramid);

/// What rays that go on through surfaces need to know of them.
struct Surroundings {
    Buffer<MaterialRecord> materials;
    Buffer<uint32_t> ranks;  ///< see ShadeStage
    Buffer<uint32_t>
        medium_overflows{};  ///< one number, of `medium_set_capped` scenes: how often a ray came
                             ///< into more objects at once than its set has room for
    float4 absorption{};     ///< of the medium, per metre
    DensityGrid density{};   ///< ... and how dense it is, where that isn't 1 everywhere
};

/// Kernels of trace.cl for one feature set. The paper's blocks 2, 3 and 4.2.
class TraceStage {
  public:
    TraceStage(const Device& device, const Features& features);

    /// Finds the first hit of rays 0 .. count-1 of the batch. `scattered` says that rays beside
    /// each other in it go different ways: reflected and refracted ones. Hits don't depend on it.
    void closest(const Pyramid& pyramid, RayBatch& batch, uint32_t count, bool scattered = false);

    /// Adds to the sets of objects that rays 0 .. count-1, which come from an observer, are inside
    /// of, the smooth body and exact meshes: those of whose surface a ray meets the back before
    /// the front. `hollow` says of each object whether that is asked, `max_hollow` in how many of
    /// them a ray could be, smooth ones counted as one. For `observer_in_medium` features.
    void begin_inside(const Pyramid& pyramid, const Surroundings& surroundings,
                      const Buffer<uint32_t>& hollow, uint32_t max_hollow, RayBatch& batch,
                      uint32_t count);

    /// Traces the queue, at most `maximum` rays of it, sent from the batch; lights that are seen
    /// add their share to its radiance.
    void shadows(const Pyramid& pyramid, const Surroundings& surroundings, const ShadowQueue& queue,
                 uint32_t maximum, RayBatch& batch);

  private:
    // Packets that a work-item of `scattered_`, of `closest_` and of `shadows_` carries.
    size_t packets_, interleaved_, shadow_packets_;
    Program program_;
    Kernel closest_, shadows_;
    std::optional<Kernel> scattered_;  ///< of scenes with paths and no instances
    std::optional<Kernel> inside_;     ///< of observers inside media
};

}  // namespace voxelume
