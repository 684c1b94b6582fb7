// SPDX-License-Identifier: Apache-2.0
// The area of the world that a sample's ray represents, by which textures are blurred.
#pragma once

#include <optional>

#include "kernels/shared/footprint.h"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The footprint of the rays of a scene's observer: one sample's part of a pixel.
Footprint footprint_of(const Scene& scene, const GridFrame& world);

/// VXL_FOOTPRINT_PARAMETER of kernels: nothing in scenes without textures.
struct FootprintArgument {
    std::optional<Footprint> footprint;
};
void bind(KernelArguments& to, const FootprintArgument& argument);

}  // namespace voxelume
