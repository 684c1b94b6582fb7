// rays -> hits: the discrete walk of every ray to the first surface it meets.
#pragma once

#include <optional>

#include "kernels/shared/scene.h"
#include "runtime/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/features.hpp"
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
};

/// Kernels of trace.cl for one feature set. The paper's blocks 2, 3 and 4.2.
class TraceStage {
  public:
    TraceStage(const Device& device, const Features& features);

    /// Finds the first hit of rays 0 .. count-1 of the batch. `scattered` says that rays beside
    /// each other in it go different ways: reflected and refracted ones. Hits don't depend on it.
    void closest(const Pyramid& pyramid, RayBatch& batch, uint32_t count, bool scattered = false);

    /// Traces the queue, at most `most` rays of it, sent from the batch; lights that are seen add
    /// their share to its radiance.
    void shadows(const Pyramid& pyramid, const Surroundings& surroundings, const ShadowQueue& queue,
                 uint32_t most, RayBatch& batch);

  private:
    size_t packets_;  // that a work-item of `scattered_` carries
    Program program_;
    Kernel closest_, shadows_;
    std::optional<Kernel> scattered_;  ///< of scenes with paths
};

}  // namespace voxelume
