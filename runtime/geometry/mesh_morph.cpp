// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_morph.hpp"

#include <glm/geometric.hpp>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

/// The point at the share `amount` of the way from a to b. It is computed in double, so that it is
/// rounded once.
glm::vec3 between(const glm::vec3& a, const glm::dvec3& b, double amount) {
    return glm::vec3(glm::dvec3(a) * (1 - amount) + b * amount);
}

}  // namespace

Mesh morphed(const Mesh& from, const Mesh& to, double amount, const SourcePlace& where) {
    if (from.positions.size() != to.positions.size() ||
        from.triangles.size() != to.triangles.size())
        throw Error(ErrorKind::input,
                    "{}: the two meshes don't match: {} vertices and {} triangles here, {} and {} "
                    "there; a morph moves the vertices of one mesh to those of the other",
                    where, from.positions.size(), from.triangles.size(), to.positions.size(),
                    to.triangles.size());
    for (size_t i = 0; i < from.triangles.size(); ++i) {
        if (from.triangles[i] == to.triangles[i]) continue;
        throw Error(ErrorKind::input,
                    "{}: the two meshes don't match: of {} triangles each, number {} joins other "
                    "vertices in one than in the other",
                    where, from.triangles.size(), i + 1);
    }
    Mesh mesh = from;
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.positions[i] = between(from.positions[i], to.positions[i], amount);
    if (to.vertex_colors.empty()) return mesh;
    for (size_t i = 0; i < mesh.vertex_colors.size(); ++i)
        mesh.vertex_colors[i] = between(from.vertex_colors[i], to.vertex_colors[i], amount);
    return mesh;
}

Mesh morphed_to_sphere(const Mesh& from, glm::dvec3 center, double radius, double amount) {
    Mesh mesh = from;
    for (glm::vec3& p : mesh.positions) {
        const glm::dvec3 ray = glm::dvec3(p) - center;
        const double distance = glm::length(ray);
        if (distance > 0) p = between(p, center + ray * (radius / distance), amount);
    }
    return mesh;
}

}  // namespace voxelume
