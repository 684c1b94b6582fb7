// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_targets.hpp"

#include <algorithm>
#include <glm/common.hpp>

namespace voxelume {
namespace {

/// Adds the weighted offsets of one list of all targets to vectors.
void add_offsets(std::span<const MorphTarget> targets, std::span<const double> weights,
                 std::vector<glm::vec3> MorphTarget::*list, double scale,
                 std::vector<glm::vec3>& vectors) {
    const size_t count = std::min(targets.size(), weights.size());
    for (size_t i = 0; i < vectors.size(); ++i) {
        glm::dvec3 sum(vectors[i]);
        for (size_t k = 0; k < count; ++k)
            if (i < (targets[k].*list).size())
                sum += glm::dvec3((targets[k].*list)[i]) * (weights[k] * scale);
        vectors[i] = glm::vec3(sum);
    }
}

}  // namespace

Mesh moved_by_targets(const Mesh& from, std::span<const MorphTarget> targets,
                      std::span<const double> weights, double scale) {
    Mesh mesh = from;
    add_offsets(targets, weights, &MorphTarget::positions, scale, mesh.positions);
    if (mesh.triangle_normals.empty())
        add_offsets(targets, weights, &MorphTarget::normals, 1, mesh.normals);
    return mesh;
}

Bounds box_of_targets(const Bounds& box, std::span<const MorphTarget> targets,
                      std::span<const double> weights) {
    Bounds reached = box;
    for (size_t k = 0; k < std::min(targets.size(), weights.size()); ++k) {
        glm::dvec3 min(0), max(0);
        for (const glm::vec3& offset : targets[k].positions) {
            min = glm::min(min, glm::dvec3(offset) * weights[k]);
            max = glm::max(max, glm::dvec3(offset) * weights[k]);
        }
        reached = {reached.min + min, reached.max + max};
    }
    return reached;
}

}  // namespace voxelume
