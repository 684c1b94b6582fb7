// rays -> radiance: what each ray meets and the light that comes along it. Blocks 3 to 9.
#pragma once

#include <optional>
#include <vector>

#include "runtime/grid.hpp"
#include "runtime/scene.hpp"
#include "runtime/stages/light.hpp"
#include "runtime/stages/medium.hpp"
#include "runtime/stages/shade.hpp"
#include "runtime/stages/trace.hpp"

namespace voxelume {

/// What the scene and its world really contain.
Features features_of(const Scene& scene, const Pyramid& world);

/// An empty batch for up to `stride` rays, with the arrays that the features need.
RayBatch allocate_batch(const Device& device, const Features& features, uint32_t stride);

/// Traces and lights batches of rays. Flat and volumetric images share it.
class Illumination {
  public:
    /// For batches of at most `most_rays` rays, a multiple of 16. The world must outlive it.
    Illumination(const Device& device, const Features& features, const Scene& scene,
                 const Pyramid& world, uint32_t most_rays);

    /// Fills hits, positions, normals, words and radiance of rays 0 .. count-1.
    void light(RayBatch& batch, uint32_t count);

    const Features& features() const { return features_; }
    uint64_t shadow_rays() const;  ///< traced so far; waits for the device

  private:
    Features features_;
    const Pyramid& world_;
    std::vector<LightRecord> lights_;
    TraceStage trace_;
    ShadeStage shade_;
    std::optional<LightStage> lighting_;  ///< not even compiled in a scene without lights
    std::optional<MediumStage> medium_;   ///< nor this in a clear space
    ShadowQueue queue_;
};

}  // namespace voxelume
