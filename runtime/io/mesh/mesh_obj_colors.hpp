// SPDX-License-Identifier: Apache-2.0
// Colours of the vertices of an OBJ file, from 0 to 1 or from 0 to 255.
#pragma once

#include <algorithm>
#include <cmath>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/mesh/mesh_color.hpp"
#include "runtime/io/mesh/mesh_source.hpp"

namespace voxelume {

/// Collects colours as the file has them; their meaning is known when all are collected.
class ObjColors {
  public:
    /// Appends the colour of the last position. `at` lies in its line.
    void append(const MeshSource& source, const char* at, const glm::vec3& color, Mesh& mesh) {
        for (int i = 0; i < 3; ++i) {
            if (!(color[i] >= 0 && color[i] <= kBytes))
                source.fail_at_line(
                    at, fmt::format(
                            "the vertex's colour has a part of {}; colours are from 0 to 1, or to "
                            "255",
                            color[i]));
            if (color[i] > 1 && !above_) above_ = at;
            max_ = std::max(max_, color[i]);
            is_whole_ = is_whole_ && color[i] == std::floor(color[i]);
        }
        mesh.vertex_colors.resize(mesh.positions.size() - 1, kNone);
        mesh.vertex_colors.push_back(color);
    }

    /// Makes all colours linear. Fractions little above 1 aren't bytes: they are refused, as
    /// dividing them by 255 would make the mesh almost black.
    void settle(const MeshSource& source, Mesh& mesh) const {
        if (mesh.vertex_colors.empty()) return;
        mesh.vertex_colors.resize(mesh.positions.size(), kNone);
        if (max_ > 1 && max_ < kMinBytes && !is_whole_)
            source.fail_at_line(above_,
                                fmt::format("the vertex's colour has a part above 1, and none of "
                                            "the file is above {}; colours are from 0 to 1, or to "
                                            "255",
                                            max_));
        const double scale = max_ > 1 ? kBytes : 1;
        for (glm::vec3& color : mesh.vertex_colors)
            color = color.x < 0 ? glm::vec3(1) : linear_from_srgb(glm::dvec3(color) / scale);
        if (scale != 1)
            mesh.assumptions.emplace_back(
                "assumed: colours of vertices from 0 to 255, for some are above 1");
    }

  private:
    static constexpr float kBytes = 255;
    static constexpr float kMinBytes = 16;  ///< values are bytes if their maximum is at least this
    static constexpr glm::vec3 kNone{-1};   ///< marks vertices without a colour, which are white

    float max_ = 0;
    bool is_whole_ = true;
    const char* above_ = nullptr;  ///< in the line of the first colour with a part above 1
};

}  // namespace voxelume
