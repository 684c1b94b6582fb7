// SPDX-License-Identifier: Apache-2.0
// The distance to the closest point of a mesh, in double precision.
#pragma once

#include "tests/oracles/mesh/mesh_tree.hpp"

namespace voxelume::oracle {

/// The distance from `point` to the nearest of the tree's closed triangles.
double distance_to_mesh(const MeshTree& mesh, const glm::dvec3& point);

}  // namespace voxelume::oracle
