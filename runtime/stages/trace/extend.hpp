// SPDX-License-Identifier: Apache-2.0
// surface points of light paths -> the light that they add, and the paths' next rays.
#pragma once

#include "kernels/shared/paths.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/emitter_table.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/sky_map.hpp"
#include "runtime/stages/trace/scatter.hpp"
#include "runtime/stages/trace/trace.hpp"

namespace voxelume {

/// Numbers of rays that continue paths.
struct NextRays {
    uint32_t paths = 0, to_emitters = 0;
};

/// What paths send rays to, and the queue for these: VXL_SOUGHT_LIGHT_PARAMETERS of kernels.
struct SoughtLight {
    const EmitterTable& emitters;
    const SkyMap& sky;
    const RayQueue& queue;
};
void bind(KernelArguments& to, const SoughtLight& sought);

/// The kernel of extend.cl for one feature set: global light.
class ExtendStage {
  public:
    ExtendStage(const Device& device, const Features& features, Surroundings surroundings);

    /// Sets the sky to which paths send rays. Needed for features with `sky_rays` only.
    void set_sky(SkyMap sky) { sky_ = std::move(sky); }

    /// Adds the light of entries 0 .. count-1 to the nodes of their sight rays, whose sums the
    /// first surfaces begin, and writes the next rays of their paths to `next`, which has room for
    /// as many. If paths send rays to emitters or the sky, these go to `to_emitters`, which has as
    /// much room.
    NextRays paths(const Pyramid& pyramid, const PathSampling& sampling,
                   const EmitterTable& emitters, RayBatch& entries, uint32_t count, bool is_first,
                   NodeLight& nodes, RayQueue& next, RayQueue& to_emitters);

  private:
    Surroundings surroundings_;
    SkyMap sky_;
    Buffer<uint32_t> counters_;
    Program program_;
    Kernel extend_;
};

}  // namespace voxelume
