// triangles of nasty classes -> mismatches between the voxels that they get and the exact ones.
#pragma once

#include "runtime/stress/stress.hpp"

namespace voxelume {

/// Tries the SUPERCOVER of triangles.
StressResult stress_triangles(const StressRun& run);

}  // namespace voxelume
