// SPDX-License-Identifier: Apache-2.0
// Meshes between two shapes: vertices move from their position in one to that in the other.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "runtime/base/source_place.hpp"
#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// Moves vertices by the share `amount`, 0..1, of the straight way from `from` to `to`, and their
/// colours too where both meshes have them. Normals turn by the same share if both meshes have them
/// at the same corners; else the mesh has none. Everything else is `from`'s. 0 and 1 give the
/// positions of `from` and `to` bit by bit.
///
/// Throws Error::input with both counts unless the meshes have equal numbers of vertices and the
/// same triangles. `where` opens the sentence.
Mesh morphed(const Mesh& from, const Mesh& to, double amount, const SourcePlace& where);

/// Moves vertices by the share `amount` of the way to a sphere, straight away from its centre or
/// towards it. A vertex at the centre stays there. Normals turn towards the sphere's.
Mesh morphed_to_sphere(const Mesh& from, glm::dvec3 center, double radius, double amount);

}  // namespace voxelume
