// SPDX-License-Identifier: Apache-2.0
// Invariants of every Mesh that a reader returns, whatever the file was.
#pragma once

#include "runtime/geometry/mesh.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace voxelume {

/// What is wrong with a list of indices, one per corner; empty if nothing is wrong. `none` marks a
/// corner without an index.
inline std::string broken_indices(const std::vector<glm::uvec3>& indices, size_t triangles,
                                  size_t count, uint32_t none) {
    if (!indices.empty() && indices.size() != triangles) return "not one per triangle";
    for (const glm::uvec3& triangle : indices)
        for (int i = 0; i < 3; ++i)
            if (triangle[i] >= count && triangle[i] != none) return "an index is out of range";
    return {};
}

/// What is wrong with the colours of corners and their texture coordinates.
inline std::string broken_paint(const Mesh& mesh) {
    const size_t triangles = mesh.triangles.size();
    std::string broken = broken_indices(mesh.triangle_colors, triangles, mesh.vertex_colors.size(),
                                        uint32_t(mesh.vertex_colors.size()) - 1);
    if (!broken.empty()) return "colours of corners: " + broken;
    broken = broken_indices(mesh.triangle_uvs, triangles, mesh.uvs.size(), kNoUv);
    if (!broken.empty()) return "places on textures: " + broken;
    if (mesh.textures.empty() != mesh.uvs.empty())
        return "textures without places, or places alone";
    if (mesh.triangle_uvs.empty() && !mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size())
        return "not one place on a texture per vertex";
    for (const uint32_t texture : mesh.group_textures)
        if (texture >= mesh.textures.size() && texture != kNoTexture) return "no such texture";
    for (const glm::vec2& uv : mesh.uvs)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return "a place is not finite";
    return {};
}

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
    if (!mesh.vertex_colors.empty() && mesh.triangle_colors.empty() &&
        mesh.vertex_colors.size() != mesh.positions.size()) {
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
    return broken_paint(mesh);
}

}  // namespace voxelume
