// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_morph.hpp"

#include <glm/geometric.hpp>

#include "runtime/base/error.hpp"
#include "runtime/geometry/mesh_normals.hpp"

namespace voxelume {
namespace {

/// The point at the share `amount` of the way from a to b. It is computed in double, so that it is
/// rounded once.
glm::vec3 between(const glm::vec3& a, const glm::dvec3& b, double amount) {
    return glm::vec3(glm::dvec3(a) * (1 - amount) + b * amount);
}

/// Gives `mesh` normals that have turned straight from those of `from` to those of `to`; none where
/// the two don't belong to the same corners.
void turn_normals(const Mesh& from, const Mesh& to, double amount, Mesh& mesh) {
    if (from.normals.size() != to.normals.size() || from.triangle_normals != to.triangle_normals) {
        mesh.normals.clear();
        mesh.triangle_normals.clear();
        return;
    }
    for (size_t i = 0; i < mesh.normals.size(); ++i)
        mesh.normals[i] =
            between(glm::vec3(unit_or_zero(from.normals[i])), unit_or_zero(to.normals[i]), amount);
}

/// Turns the normals of a mesh, whose vertices are still where they were, towards those of a sphere
/// around `center`. Each corner gets a normal of its own: files share normals between vertices.
void turn_normals_to_sphere(const glm::dvec3& center, double amount, Mesh& mesh) {
    if (mesh.normals.empty()) return;
    const std::vector<glm::uvec3>& indices =
        mesh.triangle_normals.empty() ? mesh.triangles : mesh.triangle_normals;
    std::vector<glm::vec3> normals;
    std::vector<glm::uvec3> numbers;
    for (size_t t = 0; t < indices.size(); ++t) {
        glm::uvec3 number(kNoNormal);
        for (int i = 0; i < 3; ++i) {
            if (indices[t][i] == kNoNormal) continue;
            number[i] = uint32_t(normals.size());
            const glm::dvec3 ray = glm::dvec3(mesh.positions[mesh.triangles[t][i]]) - center;
            const glm::vec3 before(unit_or_zero(mesh.normals[indices[t][i]]));
            normals.push_back(between(before, unit_or_zero(ray), amount));
        }
        numbers.push_back(number);
    }
    mesh.normals = std::move(normals);
    mesh.triangle_normals = std::move(numbers);
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
    turn_normals(from, to, amount, mesh);
    if (to.vertex_colors.size() != from.vertex_colors.size() ||
        to.triangle_colors != from.triangle_colors)
        return mesh;
    for (size_t i = 0; i < mesh.vertex_colors.size(); ++i)
        mesh.vertex_colors[i] = between(from.vertex_colors[i], to.vertex_colors[i], amount);
    return mesh;
}

Mesh morphed_to_sphere(const Mesh& from, glm::dvec3 center, double radius, double amount) {
    Mesh mesh = from;
    turn_normals_to_sphere(center, amount, mesh);
    for (glm::vec3& p : mesh.positions) {
        const glm::dvec3 ray = glm::dvec3(p) - center;
        const double distance = glm::length(ray);
        if (distance > 0) p = between(p, center + ray * (radius / distance), amount);
    }
    return mesh;
}

}  // namespace voxelume
