// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_summary.hpp"

#include <cmath>
#include <glm/common.hpp>

namespace voxelume {
namespace {

const Bounds kNothing{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};

void add(Bounds& box, const glm::dvec3& p) {
    box.min = glm::min(box.min, p);
    box.max = glm::max(box.max, p);
}

}  // namespace

Bounds mesh_bounds(const Mesh& mesh) {
    Bounds box = kNothing;
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner)
            add(box, glm::dvec3(mesh.positions[triangle[corner]]));
    return box;
}

MeshSummary summary_of(const Mesh& mesh) {
    MeshSummary summary;
    summary.triangles = mesh.triangles.size();
    summary.corners = mesh.positions.size();
    summary.surface = mesh_bounds(mesh);
    summary.vertices = kNothing;
    for (const glm::vec3& p : mesh.positions) add(summary.vertices, glm::dvec3(p));
    summary.area = mesh_area(mesh);
    summary.min_area = min_mesh_area(mesh);
    summary.has_colors = !mesh.vertex_colors.empty();
    summary.group_names = mesh.group_names;
    summary.topology = mesh_topology(mesh);
    summary.material_library = mesh.material_library;
    summary.texture = mesh.texture;
    return summary;
}

}  // namespace voxelume
