// hits -> light: what every surface point sends towards the ray that met it.
#pragma once

#include "kernels/shared/scene.h"
#include "runtime/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// A light as kernels take it: in the voxels of the world.
LightRecord light_record(const Light& light, const GridFrame& world);

/// A material as kernels take it.
MaterialRecord material_record(const Material& material);

/// The world's background, ambient light and medium.
Space space_of(const World& world);

/// Kernels of shade.cl for one feature set and one scene's materials. The paper's blocks 4.1 and 5.
class ShadeStage {
  public:
    ShadeStage(const Device& device, const Features& features, const Scene& scene);

    /// Finds the points, normals and words of hits 0 .. count-1 and starts their radiance.
    void surface(const Pyramid& pyramid, RayBatch& batch, uint32_t count);

    /// Adds one light: at once without shadows, else by filling the queue, which it empties first.
    void light(const Pyramid& pyramid, const LightRecord& light, RayBatch& batch, uint32_t count,
               ShadowQueue& queue);

  private:
    Space space_;
    Buffer<MaterialRecord> materials_;
    Program program_;
    Kernel surface_, light_;
};

}  // namespace voxelume
