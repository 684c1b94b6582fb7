// rays into closed surfaces -> those that reach a point inside, which none may.
#pragma once

#include <string_view>

#include "runtime/stages/voxelize/voxelize_options.hpp"
#include "runtime/verify/stress/stress.hpp"

namespace voxelume {

/// Tries rays towards points inside of rings: from the grid's sides, and through lattice points;
/// and groups of rays that a beam is sent along first, as frames send them.
StressResult stress_leaks(const VoxelizeOptions& options, const StressRun& run);

}  // namespace voxelume
