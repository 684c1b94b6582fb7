// SPDX-License-Identifier: Apache-2.0
// Files without faces: scans, whose vertices are points, and drawings of points and lines.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/geometry/mesh_points.hpp"
#include "runtime/io/mesh/mesh_polygon.hpp"
#include "runtime/io/mesh/mesh_source.hpp"

namespace voxelume {

/// Makes each vertex of a file without faces a point, if it has no lines either. Throws
/// Error::input where it has no vertices either, Error::limit for too many.
inline void show_scan(const MeshSource& source, Mesh& mesh) {
    if (!mesh.triangles.empty()) return;
    if (mesh.positions.empty()) source.fail("the file has neither faces nor vertices");
    require_triangle_count(source, mesh.positions.size());
    show_vertices(mesh);
}

/// The points and lines of an OBJ file, which are shown where it has no faces.
class ObjStrokes {
  public:
    /// Appends vertices that are points each, or the ends of the parts of a line.
    void append(const MeshSource& source, std::span<const uint32_t> vertices, bool is_line) {
        require_triangle_count(source, strokes_.size() + vertices.size());
        for (size_t i = is_line ? 1 : 0; i < vertices.size(); ++i)
            strokes_.push_back(is_line ? line_triangle(vertices[i - 1], vertices[i])
                                       : point_triangle(vertices[i]));
    }

    /// Takes the word of a statement that isn't read.
    void skip(std::string_view word) {
        has_curves_ |= word == "curv" || word == "curv2" || word == "surf";
    }

    /// Shows the points and lines, or all vertices, of a file without faces. Throws Error::input
    /// where it has curved surfaces in their place.
    void settle(const MeshSource& source, Mesh& mesh) {
        if (!mesh.triangles.empty()) return;
        mesh.triangles = std::move(strokes_);
        if (!mesh.triangles.empty()) return;
        if (has_curves_)
            source.fail("the file has free-form curves and surfaces alone, which aren't read");
        show_scan(source, mesh);
    }

  private:
    bool has_curves_ = false;
    std::vector<glm::uvec3> strokes_;
};

}  // namespace voxelume
