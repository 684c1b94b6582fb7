// SPDX-License-Identifier: Apache-2.0
// The properties of objects and materials that the probe lines of a lattice need if light passes
// surfaces.
#pragma once

#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The properties; empty if all surfaces are opaque.
struct LineSurfaces {
    Buffer<uint32_t> ranks;   ///< rank of each object, see object_ranks
    Buffer<float> opacities;  ///< of each material: 1 opaque, 2 if it refracts light from behind
    Buffer<uint32_t> logs;    ///< logarithm for each material, see log_clear
};

LineSurfaces line_surfaces(const Device& device, const Scene& scene);

/// The logarithm of the transmittance of a surface of this opacity, in units of -1 / VXL_LOG_UNITS;
/// VXL_OPAQUE_LOG for an opaque one.
uint32_t log_clear(double opacity);

}  // namespace voxelume
