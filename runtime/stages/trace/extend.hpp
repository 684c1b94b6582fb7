// SPDX-License-Identifier: Apache-2.0
// surface points of light paths -> the light that they add, and the paths' next rays.
#pragma once

#include "kernels/shared/paths.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/trace/scatter.hpp"
#include "runtime/stages/trace/trace.hpp"

namespace voxelume {

/// The kernel of extend.cl for one feature set: global light.
class ExtendStage {
  public:
    ExtendStage(const Device& device, const Features& features, Surroundings surroundings);

    /// Adds the light of entries 0 .. count-1 to the nodes of their sight rays, whose sums the
    /// first surfaces begin, and writes the next rays of their paths to `next`, which has room for
    /// as many. Returns the number of these rays.
    uint32_t paths(const Pyramid& pyramid, const PathSampling& sampling, RayBatch& entries,
                   uint32_t count, bool is_first, NodeLight& nodes, RayQueue& next);

  private:
    Surroundings surroundings_;
    Buffer<uint32_t> counters_;
    Program program_;
    Kernel extend_;
};

}  // namespace voxelume
