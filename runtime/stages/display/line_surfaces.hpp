// SPDX-License-Identifier: Apache-2.0
// What the probe lines of a lattice must know of objects and materials that let light through.
#pragma once

#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Empty where all surfaces are opaque.
struct LineSurfaces {
    Buffer<uint32_t> ranks;   ///< of each object, see object_ranks
    Buffer<float> opacities;  ///< of each material: 1 opaque, 2 where it refracts what is behind
    Buffer<uint32_t> logs;    ///< of each material, see log_clear
};

LineSurfaces line_surfaces(const Device& device, const Scene& scene);

/// The logarithm of what a surface of this opacity lets through, in units of -1 / VXL_LOG_UNITS;
/// VXL_OPAQUE_LOG for one that lets nothing through.
uint32_t log_clear(double opacity);

}  // namespace voxelume
