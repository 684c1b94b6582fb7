// surface points + a light -> radiance, by way of a queue of shadow rays.
#pragma once

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// A light as kernels take it: in the voxels of the world.
LightRecord light_record(const Light& light, const GridFrame& world);

/// Whether the light, a spot or patch, is turned so that it may reach any point of the world.
bool may_light(const LightRecord& light, const GridFrame& world);

/// Kernel of light.cl for one feature set. The paper's blocks 4.1 and 5.
class LightStage {
  public:
    LightStage(const Device& device, const Features& features,
               const Buffer<MaterialRecord>& materials);

    /// Adds one light to surface points 0 .. count-1: at once where nothing can keep it, else by
    /// filling the queue, which it empties first.
    void add(const Pyramid& pyramid, const LightRecord& light, RayBatch& batch, uint32_t count,
             ShadowQueue& queue);

  private:
    Buffer<MaterialRecord> materials_;
    Program program_;
    Kernel add_;
};

}  // namespace voxelume
