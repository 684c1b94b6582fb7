// radiance at surfaces -> radiance at the rays' starts: what the medium of S takes and adds.
#pragma once

#include "kernels/shared/scene.h"
#include "runtime/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// Kernels of medium.cl for one feature set.
class MediumStage {
  public:
    MediumStage(const Device& device, const Features& features, const Space& space);

    /// Lets the medium take its part of the radiance of rays 0 .. count-1, and add its own.
    void sight(const Pyramid& pyramid, RayBatch& batch, uint32_t count);

  private:
    Space space_;
    Program program_;
    Kernel sight_;
};

}  // namespace voxelume
