// rays into closed surfaces -> those that reach a point inside, which none may.
#pragma once

#include <string_view>

#include "runtime/stages/voxelize_options.hpp"
#include "runtime/stress/stress.hpp"

namespace voxelume {

/// Tries rays towards points inside of a ring: from the grid's sides, and through lattice points.
StressResult stress_leaks(const VoxelizeOptions& options, const StressRun& run);

}  // namespace voxelume
