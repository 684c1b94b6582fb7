// radiance at surfaces -> radiance at the rays' starts: what the medium of S takes and adds.
#pragma once

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// Kernels of medium.cl for one feature set. The paper's block 5, as far as the medium goes.
class MediumStage {
  public:
    /// Forms the density's lattice when the features have `medium_grid`. Throws as
    /// form_density_grid does.
    MediumStage(const Device& device, const Features& features, const World& world,
                const Environment& environment, const Buffer<MaterialRecord>& materials);

    /// Lets the medium take its part of the radiance of rays 0 .. count-1, and add its own. With
    /// `transmission`, rays inside an object go through its material instead; with `paths`,
    /// `passed` is written.
    void sight(const Pyramid& pyramid, RayBatch& batch, uint32_t count);

    /// Takes the medium's part from the light of the queue, at most `maximum` rays of it. Without
    /// shadows the light that is left arrives at the batch's radiance.
    void shadows(const Pyramid& pyramid, ShadowQueue& queue, uint32_t maximum, RayBatch& batch);

    /// Empty when the density is 1 everywhere.
    const DensityGrid& density() const { return density_; }

  private:
    Environment environment_;
    Buffer<MaterialRecord> materials_;
    DensityGrid density_;
    Program program_;
    Kernel camera_, shadows_;
};

}  // namespace voxelume
