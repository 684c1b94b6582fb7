// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_summary.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/geometry/mesh_points.hpp"

namespace voxelume {
namespace {

void add(Bounds& box, const glm::dvec3& p) {
    box.min = glm::min(box.min, p);
    box.max = glm::max(box.max, p);
}

/// The length of the longest side of a triangle.
double longest_edge(const Mesh& mesh) {
    double squared = 0;
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 side =
                glm::dvec3(mesh.positions[t[i]]) - glm::dvec3(mesh.positions[t[(i + 1) % 3]]);
            squared = std::max(squared, glm::dot(side, side));
        }
    return std::sqrt(squared);
}

}  // namespace

Bounds mesh_bounds(const Mesh& mesh) {
    if (mesh.triangles.empty()) return kEmptyBounds;
    // Floats lose nothing here: positions are floats.
    glm::vec3 min(INFINITY), max(-INFINITY);
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3& p = mesh.positions[triangle[corner]];
            min = glm::min(min, p);
            max = glm::max(max, p);
        }
    return {glm::dvec3(min), glm::dvec3(max)};
}

MeshPaint paint_of(const Mesh& mesh) {
    MeshPaint paint;
    paint.colors = mesh.vertex_colors.size();
    paint.has_corner_colors = !mesh.triangle_colors.empty();
    if (mesh.textures.empty()) return paint;
    for (const Texture& texture : mesh.textures) {
        paint.texels += texel_count(*texture.image);
        paint.has_alpha |= texture.alpha != kAlphaOpaque;
        paint.mapped += texture.has_maps() ? 1 : 0;
    }
    paint.textures = mesh.textures.size();
    paint.uvs = mesh.uvs.size();
    paint.has_corner_uvs = !mesh.triangle_uvs.empty();
    return paint;
}

bool has_area(const MeshSummary& mesh) {
    return mesh.strokes < mesh.triangles;
}

bool is_open(const MeshSummary& mesh) {
    return mesh.topology.hole_area > kOpenShare * mesh.area.total;
}

MeshSummary summary_of(const Mesh& mesh) {
    // Each function walks over all triangles: 4.5 million take some tenths of a second. Where no
    // more threads are allowed, `async | deferred` runs without one.
    constexpr size_t kManyTriangles = 1 << 16;
    const auto how = mesh.triangles.size() < kManyTriangles
                         ? std::launch::deferred
                         : std::launch::async | std::launch::deferred;
    auto topology = std::async(how, [&] { return mesh_topology(mesh); });
    auto areas = std::async(how, [&] { return mesh_areas(mesh); });
    MeshSummary summary;
    summary.triangles = mesh.triangles.size();
    const PointCounts counts = count_points(mesh);
    summary.strokes = counts.points + counts.lines;
    summary.corners = mesh.positions.size();
    summary.surface = mesh_bounds(mesh);
    summary.vertices = kEmptyBounds;
    for (const glm::vec3& p : mesh.positions) add(summary.vertices, glm::dvec3(p));
    summary.paint = paint_of(mesh);
    summary.has_normals = !mesh.normals.empty();
    summary.longest_edge = longest_edge(mesh);
    summary.group_names = mesh.group_names;
    summary.material_libraries = mesh.material_libraries;
    summary.missing_materials = mesh.missing_materials;
    summary.library_faults = mesh.library_faults;
    summary.texture = mesh.texture;
    summary.notes = mesh.notes;
    summary.topology = topology.get();
    const MeshAreas both = areas.get();
    summary.area = both.all;
    summary.min_area = both.min;
    return summary;
}

}  // namespace voxelume
