// hits -> surface points, with what shines there without lights.
#pragma once

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// A material as kernels take it, in a world's voxels.
MaterialRecord material_record(const Material& material, const GridFrame& world);

/// The world's background, ambient light and medium.
Environment environment_of(const World& world);

/// Kernels of shade.cl for one feature set and one scene's materials. The paper's block 3.
class ShadeStage {
  public:
    ShadeStage(const Device& device, const Features& features, const Scene& scene,
               const GridFrame& world);

    /// Finds the points, normals and words of hits 0 .. count-1 and starts their radiance.
    void surface(const Pyramid& pyramid, RayBatch& batch, uint32_t count);

    const Environment& environment() const { return environment_; }
    const Buffer<MaterialRecord>& materials() const { return materials_; }
    /// Each object's place in the order of priorities; empty in scenes without paths.
    const Buffer<uint32_t>& ranks() const { return ranks_; }

  private:
    Environment environment_;
    Buffer<MaterialRecord> materials_;
    Buffer<uint32_t> ranks_;
    Program program_;
    Kernel surface_;
};

}  // namespace voxelume
