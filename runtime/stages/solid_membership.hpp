// Whether a lattice point lies in a solid, decided exactly.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/stages/solid_program.hpp"

namespace voxelume {

/// -1 inside, 0 on the boundary, 1 outside, of the point at `half_voxels` / 2 of the grid.
///
/// Exact for the program's sources, whose maps and parameters are doubles: kernels hand the points
/// here that float can't decide. On the boundary of a combination means that no open ball of the
/// point is told apart by the operations on its shapes' signs: a point counts as in the solid when
/// this is not 1, and the boundary of what a difference takes away stays in the solid.
int exact_side(const SolidProgram& program, const glm::ivec3& half_voxels);

}  // namespace voxelume
