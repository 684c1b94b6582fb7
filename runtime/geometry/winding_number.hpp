// SPDX-License-Identifier: Apache-2.0
// mesh and point -> how far the mesh encloses the point.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The generalized winding number of a mesh around a point (Jacobson et al. 2013): 1 inside a
/// closed mesh, -1 if its faces turn inwards, 0 outside; for an open one the share of all
/// directions that it covers. Triangles with the point on them don't count. Solid angles after van
/// Oosterom & Strackee 1983.
double winding_number(const Mesh& mesh, const glm::dvec3& point);

}  // namespace voxelume
