// SPDX-License-Identifier: Apache-2.0
// surface points + the sky -> radiance, through a queue of shadow rays: skylight in local light.
#pragma once

#include "kernels/shared/paths.h"
#include "kernels/shared/scene.h"
#include "kernels/shared/sky.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/parts/sky.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/sky_map.hpp"

namespace voxelume {

/// The value of VXL_SKY.
int sky_feature(const Sky& sky);

/// The sky's record for kernels.
SkyRecord sky_record(const Sky& sky);

/// The sun as a directional light. It shines from a disk around the end of its unit vector.
LightRecord sun_light_record(const Sky& sky, const GridFrame& world);
LightAreaRecord sun_area_record(const Sky& sky, const GridFrame& world);

/// The kernel of sky_light.cl for one feature set.
class SkyLightStage {
  public:
    SkyLightStage(const Device& device, const Features& features,
                  const Buffer<MaterialRecord>& materials, const SkyView& sky);

    /// Adds the light from direction `number` of `directions` to surface points 0 .. count-1, as
    /// LightStage adds a light.
    void add(const Pyramid& pyramid, uint32_t number, uint32_t directions, RayBatch& batch,
             uint32_t count, ShadowQueue& queue);

  private:
    Buffer<MaterialRecord> materials_;
    SkyView sky_;
    Program program_;
    Kernel add_;
};

}  // namespace voxelume
