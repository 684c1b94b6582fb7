// SPDX-License-Identifier: Apache-2.0
// Colours of faces and UVs, which some formats give to some faces or corners only.
#pragma once

#include "runtime/geometry/mesh.hpp"

#include <algorithm>
#include <cmath>

namespace voxelume {

/// A UV whose v counts upwards in the file. NaN becomes the upper left corner.
inline glm::vec2 upright_uv(double u, double v) {
    const glm::vec2 uv(u, 1 - v);
    return std::isfinite(uv.x) && std::isfinite(uv.y) ? uv : glm::vec2(0);
}

/// Gives a colour to all triangles from number `first` on. Earlier triangles without a colour
/// become white.
inline void append_face_color(Mesh& mesh, const glm::vec3& color, size_t first) {
    if (mesh.vertex_colors.empty()) mesh.vertex_colors.emplace_back(1.0f);
    mesh.triangle_colors.resize(first, glm::uvec3(0));
    if (mesh.vertex_colors.back() != color) mesh.vertex_colors.push_back(color);
    mesh.triangle_colors.resize(mesh.triangles.size(),
                                glm::uvec3(uint32_t(mesh.vertex_colors.size() - 1)));
}

/// Extends the lists of colours and UVs to the last triangle, with white and without UVs.
inline void fill_corner_lists(Mesh& mesh) {
    if (!mesh.triangle_colors.empty())
        mesh.triangle_colors.resize(mesh.triangles.size(), glm::uvec3(0));
    if (!mesh.triangle_uvs.empty())
        mesh.triangle_uvs.resize(mesh.triangles.size(), glm::uvec3(kNoUv));
}

/// The triangle strip that is being read: every second triangle has the opposite orientation.
struct PlyStrip {
    uint32_t before = 0, last = 0;
    size_t count = 0;

    /// Appends the triangle of a vertex and the two before it, unless two of them are equal.
    void add(uint32_t vertex, std::vector<glm::uvec3>& triangles) {
        const bool is_flat = before == last || last == vertex || vertex == before;
        if (count >= 2 && !is_flat)
            triangles.push_back(count % 2 == 0 ? glm::uvec3(before, last, vertex)
                                               : glm::uvec3(last, before, vertex));
        before = last;
        last = vertex;
        ++count;
    }
};

}  // namespace voxelume
