// SPDX-License-Identifier: Apache-2.0
// The medium between the observer and surfaces, as kernels of displays take it.
#pragma once

#include "kernels/shared/scene.h"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/medium/density_grid.hpp"

namespace voxelume {

/// The medium between the observer and surfaces. `density` is empty where it is 1 everywhere.
struct SpaceMedium {
    Environment environment;
    DensityGrid density;
};

/// VXL_SPACE_MEDIUM_PARAMETERS of kernels.
inline void bind(KernelArguments& to, const SpaceMedium& medium) {
    to.add(medium.environment, medium.density, medium.density.colors);
}

}  // namespace voxelume
