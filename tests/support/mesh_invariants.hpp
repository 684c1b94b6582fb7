// SPDX-License-Identifier: Apache-2.0
// Invariants of every Mesh that a reader returns, whatever the file was.
#pragma once

#include "runtime/geometry/mesh.hpp"

#include <cmath>
#include <string>

namespace voxelume {

/// The first invariant of struct Mesh that `mesh` breaks; empty if it keeps all.
inline std::string broken_invariant(const Mesh& mesh) {
    if (mesh.triangles.empty()) {
        return "no triangles";
    }
    for (const glm::vec3& position : mesh.positions) {
        if (!std::isfinite(position.x) || !std::isfinite(position.y) ||
            !std::isfinite(position.z)) {
            return "a position is not finite";
        }
    }
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            if (triangle[i] >= mesh.positions.size()) {
                return "an index is out of range";
            }
        }
    }
    if (!mesh.vertex_colors.empty() && mesh.vertex_colors.size() != mesh.positions.size()) {
        return "not one colour per vertex";
    }
    for (const glm::vec3& color : mesh.vertex_colors) {
        for (int i = 0; i < 3; ++i) {
            if (!(color[i] >= 0.0f && color[i] <= 1.0f)) {
                return "a colour is out of range";
            }
        }
    }
    if (!mesh.triangle_group.empty() && mesh.triangle_group.size() != mesh.triangles.size()) {
        return "not one group per triangle";
    }
    for (const uint32_t group : mesh.triangle_group) {
        if (group >= mesh.group_names.size()) {
            return "a group has no name";
        }
    }
    return {};
}

}  // namespace voxelume
