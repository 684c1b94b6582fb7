// SPDX-License-Identifier: Apache-2.0
// A gyroid inside a ball: its field, the points where rays meet it, and a fine mesh of it.
#pragma once

#include "runtime/geometry/mesh.hpp"
#include "runtime/verify/bench/bench_subject.hpp"

namespace voxelume {

/// sin kx cos ky + sin ky cos kz + sin kz cos kx + 2 (|p| / R)^8, which is negative inside: a
/// gyroid of period 0.5 m that closes smoothly within R = 0.45 m.
double gyroid_value(const glm::dvec3& p);
glm::dvec3 gyroid_gradient(const glm::dvec3& p);

/// Marches by the field divided by a bound of its gradient, and bisects to the last bit after a
/// change of sign. A part that the ray is inside for less than a micrometre may be missed.
std::optional<AnalyticHit> gyroid_hit(const glm::dvec3& origin, const glm::dvec3& direction);

/// The field's zero in the tetrahedra of a lattice of cubes, with `cells` on the ball's diameter.
/// Vertices lie on the surface. The mesh is closed, and two triangles share every edge.
Mesh gyroid_mesh(int cells);

/// The gyroid as a subject. Its mesh is in a temporary file that is removed with the last copy of
/// the subject.
BenchSubject gyroid_subject();

}  // namespace voxelume
