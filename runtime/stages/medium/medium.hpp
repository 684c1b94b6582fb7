// SPDX-License-Identifier: Apache-2.0
// radiance at surfaces -> radiance at the rays' starts: the absorption and emission of the medium
// of S.
#pragma once

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/medium_scattering.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// The kernels of medium.cl for one feature set: the part of the paper's block 5 that concerns the
/// medium.
class MediumStage {
  public:
    /// Makes the density's lattice if the features have `medium_grid`. Throws as form_density_grid
    /// does. `lights` are the scene's.
    MediumStage(const Device& device, const Features& features, const World& world,
                const Environment& environment, const Buffer<MaterialRecord>& materials,
                const std::vector<Light>& lights = {});

    /// Applies the medium to rays 0 .. count-1: absorbs a part of their radiance and adds its own.
    /// With `transmission`, rays inside an object pass through its material instead. With `paths`,
    /// the batch's transmittance is written.
    void sight(const Pyramid& pyramid, RayBatch& batch, uint32_t count);

    /// Applies the medium's absorption to the light of at most `maximum` rays of the queue. Without
    /// shadows the remaining light is added to the batch's radiance.
    void shadows(const Pyramid& pyramid, ShadowQueue& queue, uint32_t maximum, RayBatch& batch);

    const MediumScattering& scattering() const { return scattering_; }
    /// The extinction per metre of rays to lights, at density 1.
    const float4& extinction() const { return extinction_.absorption; }
    /// The density grid; empty if the density is 1 everywhere.
    const DensityGrid& density() const { return density_; }

  private:
    Environment environment_;
    MediumScattering scattering_;
    Environment extinction_;  ///< environment of rays to lights, which also lose scattered light
    Buffer<MaterialRecord> materials_;
    DensityGrid density_;
    Program program_;
    Kernel camera_, shadows_;
};

}  // namespace voxelume
