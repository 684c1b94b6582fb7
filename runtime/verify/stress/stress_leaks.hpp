// SPDX-License-Identifier: Apache-2.0
// rays into closed surfaces -> the number that reach a point inside, which must be 0
#pragma once

#include <string_view>

#include "runtime/stages/voxelize/voxelize_options.hpp"
#include "runtime/verify/stress/stress.hpp"

namespace voxelume {

/// Tries rays towards points inside rings: from the grid's sides, through lattice points, and in
/// groups behind a beam, as frames send them.
StressResult stress_leaks(const VoxelizeOptions& options, const StressRun& run);

}  // namespace voxelume
