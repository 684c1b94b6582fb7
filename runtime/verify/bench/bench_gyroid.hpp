// A gyroid inside of a ball: the field, where rays meet it, and a fine mesh of it.
#pragma once

#include "runtime/geometry/mesh.hpp"
#include "runtime/verify/bench/bench_subject.hpp"

namespace voxelume {

/// sin kx cos ky + sin ky cos kz + sin kz cos kx + 2 (|p| / R)^8, negative inside: a gyroid of
/// period 0.5 m that closes smoothly within R = 0.45 m.
double gyroid_value(const glm::dvec3& p);
glm::dvec3 gyroid_gradient(const glm::dvec3& p);

/// Marches by the field over a bound of its gradient, and bisects to the last bit where its sign
/// has changed. Passes over what the ray is in for less than a micrometre.
std::optional<AnalyticHit> gyroid_hit(const glm::dvec3& origin, const glm::dvec3& direction);

/// The field's zero in the tetrahedra of a lattice of cubes with `cells` on the ball's diameter.
/// Vertices lie on the surface; closed, and every edge is shared by two triangles.
Mesh gyroid_mesh(int cells);

/// The mesh is written to a temporary file, which goes with the last copy of the subject.
BenchSubject gyroid_subject();

}  // namespace voxelume
