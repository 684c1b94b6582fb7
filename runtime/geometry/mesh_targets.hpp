// SPDX-License-Identifier: Apache-2.0
// Meshes that are moved by several targets, each with a weight.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/scene/parts/bounds.hpp"

namespace voxelume {

/// The offsets of a mesh's vertices and of its normals at a weight of 1; each list is empty where
/// nothing moves.
struct MorphTarget {
    std::vector<glm::vec3> positions, normals;
};

/// Moves the vertices of `from`, and normals that belong to vertices, by the sum of the targets'
/// offsets times their weights and `scale`. Sums are rounded once. Missing weights are 0.
Mesh moved_by_targets(const Mesh& from, std::span<const MorphTarget> targets,
                      std::span<const double> weights, double scale);

/// A box around all positions to which the weights may move a mesh in `box`.
Bounds box_of_targets(const Bounds& box, std::span<const MorphTarget> targets,
                      std::span<const double> weights);

}  // namespace voxelume
