// SPDX-License-Identifier: Apache-2.0
// rays of any origin and length -> mismatches in how they are snapped, and in their walks after
// that
#pragma once

#include "runtime/verify/exact/exact_snap.hpp"
#include "runtime/verify/stress/stress.hpp"

namespace voxelume {

enum class SnapClass {
    far,       ///< from up to 10^7 voxels away
    denormal,  ///< tiny, huge, zero and negative zero components, lengths from 2^-100 to 2^100
};

FloatRay float_ray(SnapClass kind, const FixedGrid& grid, uint64_t seed, uint64_t number);

/// Tries the snapping of rays, and the walks of the snapped rays.
StressResult stress_snapping(SnapClass kind, const StressRun& run);

}  // namespace voxelume
