// Meshes between two shapes: vertices on their way from one place to another.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// Vertices the share `amount`, 0..1, of the straight way from `from` to `to`, and colours likewise
/// where both have them; all else is `from`'s. 0 and 1 give the ends' positions bit by bit.
///
/// Throws Error::input with both counts when the meshes have not as many vertices and the same
/// triangles; `where` opens the sentence.
Mesh morphed(const Mesh& from, const Mesh& to, double amount, const std::string& where);

/// Vertices the share `amount` of the way to a sphere, straight away from or towards its centre. A
/// vertex in the centre stays there.
Mesh morphed_to_sphere(const Mesh& from, glm::dvec3 center, double radius, double amount);

}  // namespace voxelume
