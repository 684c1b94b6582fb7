// SPDX-License-Identifier: Apache-2.0
// light of rays, path by path -> the mean of all paths that begin as one ray, in global light.
#pragma once

#include "runtime/opencl/program.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// Three sums for each of a batch's rays.
Buffer<float> allocate_light_sums(const Device& device, uint32_t rays);

/// The kernel of display_mean.cl.
class DisplayMeanStage {
  public:
    /// Takes batches of `rays`, each with `paths` paths, at least 2.
    DisplayMeanStage(const Device& device, const Features& features, uint32_t rays, uint32_t paths);

    uint32_t paths() const { return paths_; }

    /// Adds the light of path `path` of rays 0 .. count-1. With the last path, the rays get the
    /// mean.
    void add(uint32_t path, RayBatch& batch, uint32_t count);

  private:
    uint32_t paths_;
    Buffer<float> sums_;
    Kernel add_;
};

}  // namespace voxelume
