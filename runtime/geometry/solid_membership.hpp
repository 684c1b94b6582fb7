// Whether a lattice point lies in a solid, decided exactly.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/geometry/solid_program.hpp"

namespace voxelume {

/// The side of the point at `half_voxels` / 2 of the grid: -1 inside, 0 on the boundary, 1 outside.
///
/// Exact for the program's sources, whose maps and parameters are doubles: the points that kernels
/// can't decide in float come here. Combinations take the least (union) or greatest (intersection)
/// of their shapes' sides, so a point counts as in the solid when this is not 1, and the boundary
/// of what a difference takes away stays in it.
int exact_side(const SolidProgram& program, const glm::ivec3& half_voxels);

}  // namespace voxelume
