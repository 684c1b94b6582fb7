// Where a ray of any origin and length has to come into a grid: what snapping is held against.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "runtime/verify/exact/exact_walk.hpp"

namespace voxelume {

/// A ray in voxels, its direction of any length.
struct FloatRay {
    glm::vec3 origin{0}, direction{0};
};

/// The direction scaled by a power of two into [1/2, 1), in 2^-22, each component rounded to the
/// nearest, ties to even.
std::array<int64_t, 3> exact_direction(const glm::vec3& direction);

/// How far, in voxels, rounding in floats may take a ray away from where it comes into a grid: a
/// unit of fixed point, and 16 units in the last place of what has to be gone there.
double snap_bound(const FixedGrid& grid, const FloatRay& ray);

/// Nothing when `snapped` (null: idle) is what `ray` may become; else what is wrong with it.
std::string snap_fault(const FixedGrid& grid, const FloatRay& ray, const FixedRay* snapped);

}  // namespace voxelume
