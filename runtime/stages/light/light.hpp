// SPDX-License-Identifier: Apache-2.0
// surface points + a light -> radiance, through a queue of shadow rays.
#pragma once

#include <cstdint>
#include <optional>

#include "kernels/shared/paths.h"
#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// A light that a scene lists, and its area if it has one.
struct PathLight {
    LightRecord record;
    std::optional<LightAreaRecord> area;
    uint32_t number = 0;  ///< number of its random samples, which doesn't depend on other lights
};

/// The light's record for kernels, in the voxels of the world.
LightRecord light_record(const Light& light, const GridFrame& world);

/// The radius of the ball around a light with this area, in metres.
double radius_of(const LightAreaRecord& area, const GridFrame& world);

/// True if the light's direction lets it reach some point of the world. Only spot lights and area
/// light samples can fail.
bool may_light(const LightRecord& light, const GridFrame& world);

/// The kernel of light.cl for one feature set: the paper's blocks 4.1 and 5.
class LightStage {
  public:
    LightStage(const Device& device, const Features& features,
               const Buffer<MaterialRecord>& materials);

    /// Adds one light to surface points 0 .. count-1. If nothing can block the light, it is added
    /// at once; else its shadow rays are written to the queue, which is emptied first.
    void add(const Pyramid& pyramid, const LightRecord& light, RayBatch& batch, uint32_t count,
             ShadowQueue& queue);

  private:
    Buffer<MaterialRecord> materials_;
    Program program_;
    Kernel add_;
};

}  // namespace voxelume
