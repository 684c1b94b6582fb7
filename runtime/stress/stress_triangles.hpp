// triangles of nasty classes -> mismatches between the voxels that they get and the exact ones.
#pragma once

#include "runtime/stress/stress.hpp"
#include "runtime/surface.hpp"

namespace voxelume {

/// Tries the SUPERCOVER of triangles, or their THIN voxels.
StressResult stress_triangles(VoxelSet set, const StressRun& run);

}  // namespace voxelume
