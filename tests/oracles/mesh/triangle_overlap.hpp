// SPDX-License-Identifier: Apache-2.0
// Exact answers about triangles and voxels, in 128-bit and rational arithmetic.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace voxelume::oracle {

/// Corners on the lattice of 1/4096 voxel.
using LatticeCorners = std::array<glm::ivec3, 3>;

/// True if the closed triangle meets the closed cube of voxel `v`, widened on all sides by `margin`
/// units of the lattice. Tests 13 separating axes.
bool cube_meets_triangle(const glm::ivec3& v, const LatticeCorners& triangle, int margin = 0);

/// True if the triangle meets the crosshair of voxel `v`: its three centre segments, each with its
/// start but without its end, whose lines are shifted by (e, e², e³) with e = 2^-80.
bool crosshair_meets_triangle(const glm::ivec3& v, const LatticeCorners& triangle);

/// The winding number of a closed mesh around a lattice point shifted by (e, e², e³): counts
/// crossings of the ray along +z in rational numbers.
int winding_number(const glm::ivec3& point, const std::vector<LatticeCorners>& mesh);

}  // namespace voxelume::oracle
