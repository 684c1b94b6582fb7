// SPDX-License-Identifier: Apache-2.0
// The hits of rays on a mesh, and the distance at which rays pass its silhouette, in long double.
#pragma once

#include <optional>

#include "tests/oracles/mesh/mesh_tree.hpp"

namespace voxelume::oracle {

/// The smallest t > 0 at which origin + direction * t meets a closed triangle, from either side.
///
/// The test is watertight: triangles with equal corners evaluate a common edge to opposite numbers,
/// and a ray on the edge meets both.
std::optional<double> first_hit(const MeshTree& mesh, const glm::dvec3& origin,
                                const glm::dvec3& direction);

using Edge = std::array<glm::dvec3, 2>;

/// The edges where the mesh, seen from `eye`, turns from front to back or ends. Triangles are
/// neighbours where their corners are equal; an edge of three or more triangles counts, too.
std::vector<Edge> silhouette_edges(const std::vector<Triangle>& triangles, const glm::dvec3& eye);

/// The distance from the half line origin + direction * t, t >= 0, to the nearest of the edges.
double distance_to_edges(const std::vector<Edge>& edges, const glm::dvec3& origin,
                         const glm::dvec3& direction);

}  // namespace voxelume::oracle
