// SPDX-License-Identifier: Apache-2.0
// surface points of light paths + an area light -> radiance, through a queue of shadow rays; and
// radiance of paths that run into the light.
#pragma once

#include <optional>

#include "kernels/shared/paths.h"
#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/light_tree_table.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/trace/scatter.hpp"

namespace voxelume {

/// The kernels of area_light.cl for one feature set: global light of disks and rectangles.
class AreaLightStage {
  public:
    AreaLightStage(const Device& device, const Features& features,
                   const Buffer<MaterialRecord>& materials);

    /// Adds the light to surface points 0 .. count-1, as LightStage does, but each surface point
    /// sees a point of its own on the light. `number` differs between lights.
    void add(const Pyramid& pyramid, const LightRecord& light, const LightAreaRecord& area,
             const PathSampling& sampling, uint32_t number, RayBatch& batch, uint32_t count,
             ShadowQueue& queue);

    /// Adds the light to the nodes of those of rays 0 .. count-1 that run into it before their
    /// hits. Only for features with `meets_lights`.
    void meet(const Pyramid& pyramid, const LightRecord& light, const LightAreaRecord& area,
              const Surroundings& surroundings, RayBatch& batch, uint32_t count, NodeLight& nodes);

    /// Adds the light of all lights of a tree in the same way. Only for features with
    /// `chosen_areas`, too.
    void meet_all(const Pyramid& pyramid, const LightTree& lights, const Surroundings& surroundings,
                  RayBatch& batch, uint32_t count, NodeLight& nodes);

  private:
    Buffer<MaterialRecord> materials_;
    Program program_;
    Kernel add_;
    std::optional<Kernel> meet_, meet_all_;
};

}  // namespace voxelume
