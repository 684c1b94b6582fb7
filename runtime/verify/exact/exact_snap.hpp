// SPDX-License-Identifier: Apache-2.0
// Where a ray of any origin and length has to enter a grid: the reference for snapping.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "runtime/verify/exact/exact_walk.hpp"

namespace voxelume {

/// A ray in voxels. Its direction has any length.
struct FloatRay {
    glm::vec3 origin{0}, direction{0};
};

/// The direction scaled by a power of two into [1/2, 1), in 2^-22. Each component is rounded to the
/// nearest, ties to even.
std::array<int64_t, 3> exact_direction(const glm::vec3& direction);

/// The distance, in voxels, by which rounding in floats may move a ray away from where it enters a
/// grid: a unit of fixed point, and 16 units in the last place of the distance to the grid.
double snap_bound(const FixedGrid& grid, const FloatRay& ray);

/// Empty if `snapped` (null: idle) is a valid result for `ray`; otherwise says what is wrong with
/// it.
std::string snap_fault(const FixedGrid& grid, const FloatRay& ray, const FixedRay* snapped);

}  // namespace voxelume
