// SPDX-License-Identifier: Apache-2.0
// Decides exactly whether a lattice point lies in a solid.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/geometry/solid/solid_program.hpp"

namespace voxelume {

/// The side of the point at `half_voxels` / 2 of the grid: -1 is inside, 0 on the boundary, 1
/// outside.
///
/// The result is exact for the program's sources, whose maps and parameters are doubles. It decides
/// the points that kernels can't decide in float. Combinations take the minimum (union) or maximum
/// (intersection) of their shapes' sides. So a point counts as in the solid when the result isn't
/// 1, and the boundary of what a difference takes away stays in the solid.
int exact_side(const SolidProgram& program, const glm::ivec3& half_voxels);

}  // namespace voxelume
