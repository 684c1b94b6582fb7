// SPDX-License-Identifier: Apache-2.0
// triangles of difficult classes -> mismatches between their voxels and the exact ones
#pragma once

#include "runtime/scene/parts/surface.hpp"
#include "runtime/verify/stress/stress.hpp"

namespace voxelume {

/// Tries the SUPERCOVER of triangles, or their THIN voxels.
StressResult stress_triangles(VoxelSet set, const StressRun& run);

}  // namespace voxelume
