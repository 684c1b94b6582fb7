// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <tuple>

#include "kernels/shared/normal.h"

namespace voxelume {
namespace {

/// Above this number of faces around a vertex, each corner keeps its face's normal: at the tip of
/// such a fan no normal is smooth, and comparing all faces with each other takes a time that grows
/// with the square of their number.
constexpr size_t kMaxFacesAround = 1024;

/// The normals that the file gives.
std::vector<glm::vec3> given_normals(const Mesh& mesh) {
    std::vector<glm::vec3> corners;
    corners.reserve(3 * mesh.triangles.size());
    const std::vector<glm::uvec3>& indices =
        mesh.triangle_normals.empty() ? mesh.triangles : mesh.triangle_normals;
    for (const glm::uvec3& t : indices)
        for (int i = 0; i < 3; ++i)
            corners.push_back(t[i] == kNoNormal ? glm::vec3(0)
                                                : glm::vec3(unit_or_zero(mesh.normals[t[i]])));
    return corners;
}

/// A position, as what vertices are compared by.
struct CornerPosition {
    std::array<float, 3> position;
    uint32_t corner;  ///< 3 * triangle + its index in the triangle
};

/// The corners of a mesh in the order of their positions, so that those at one position stand
/// together.
std::vector<CornerPosition> corners_by_position(const Mesh& mesh) {
    std::vector<CornerPosition> corners;
    corners.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 p = mesh.positions[t[i]] + 0.0f;  // -0 becomes 0
            corners.push_back({{p.x, p.y, p.z}, uint32_t(corners.size())});
        }
    std::ranges::sort(corners, {},
                      [](const CornerPosition& c) { return std::tie(c.position, c.corner); });
    return corners;
}

/// A face's normal and its angle at one of its corners.
struct Wedge {
    glm::dvec3 normal;  ///< unit vector, or 0
    double angle = 0;   ///< radians
    uint32_t corner = 0;
};

Wedge wedge_of(const Mesh& mesh, uint32_t corner) {
    const glm::uvec3& t = mesh.triangles[corner / 3];
    const int i = int(corner % 3);
    const glm::dvec3 p(mesh.positions[t[i]]);
    const glm::dvec3 u = glm::dvec3(mesh.positions[t[(i + 1) % 3]]) - p;
    const glm::dvec3 v = glm::dvec3(mesh.positions[t[(i + 2) % 3]]) - p;
    const glm::dvec3 area = glm::cross(u, v);
    return {unit_or_zero(area), std::atan2(glm::length(area), glm::dot(u, v)), corner};
}

/// Sets the normals of the corners around one vertex.
void average_around(const std::vector<Wedge>& wedges, double min_cosine,
                    std::vector<glm::vec3>& normals) {
    for (const Wedge& own : wedges) {
        glm::dvec3 sum(0);
        if (wedges.size() <= kMaxFacesAround)
            for (const Wedge& other : wedges)
                if (glm::dot(own.normal, other.normal) >= min_cosine)
                    sum += other.normal * other.angle;
        const glm::dvec3 mean = unit_or_zero(sum);
        normals[own.corner] = glm::vec3(mean == glm::dvec3(0) ? own.normal : mean);
    }
}

/// The normals of a mesh that has none.
std::vector<glm::vec3> averaged_normals(const Mesh& mesh, double crease_angle) {
    constexpr double kRounding = 1e-9;  // faces of one plane are within an angle of 0
    const double min_cosine = std::cos(glm::radians(crease_angle)) - kRounding;
    std::vector<glm::vec3> normals(3 * mesh.triangles.size());
    const std::vector<CornerPosition> corners = corners_by_position(mesh);
    std::vector<Wedge> wedges;
    for (size_t i = 0; i < corners.size(); ++i) {
        wedges.push_back(wedge_of(mesh, corners[i].corner));
        if (i + 1 < corners.size() && corners[i + 1].position == corners[i].position) continue;
        average_around(wedges, min_cosine, normals);
        wedges.clear();
    }
    return normals;
}

/// `to` with the sign of each component of `from`; that of 0 is positive.
glm::dvec2 with_signs(const glm::dvec2& to, const glm::dvec2& from) {
    return {from.x < 0 ? -to.x : to.x, from.y < 0 ? -to.y : to.y};
}

glm::dvec3 face_normal(const Mesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a(mesh.positions[t.x]);
    return glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
}

}  // namespace

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : glm::dvec3(0);
}

std::vector<glm::vec3> corner_normals(const Mesh& mesh, const Shading& shading) {
    if (!has_shading_normals(shading, !mesh.normals.empty())) return {};
    return mesh.normals.empty() ? averaged_normals(mesh, shading.crease_angle)
                                : given_normals(mesh);
}

uint32_t packed_normal(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const glm::dvec3 n = normal / (size.x + size.y + size.z);
    glm::dvec2 uv(n.x, n.y);
    if (n.z < 0) uv = with_signs(1.0 - glm::abs(glm::dvec2(n.y, n.x)), uv);
    const glm::dvec2 units = glm::round(uv * double(VXL_NORMAL_UNITS));
    return uint32_t(uint16_t(int16_t(units.x))) | uint32_t(uint16_t(int16_t(units.y))) << 16;
}

glm::dvec3 unpacked_normal(uint32_t code) {
    const glm::dvec2 uv =
        glm::dvec2(int16_t(code & 0xFFFFu), int16_t(code >> 16)) / double(VXL_NORMAL_UNITS);
    const double z = 1 - std::abs(uv.x) - std::abs(uv.y);
    const glm::dvec2 xy = z < 0 ? with_signs(1.0 - glm::abs(glm::dvec2(uv.y, uv.x)), uv) : uv;
    return glm::normalize(glm::dvec3(xy, z));
}

std::vector<uint32_t> packed_normals(const Mesh& mesh, const std::vector<glm::vec3>& normals,
                                     const glm::dmat3& map) {
    const double outwards = glm::determinant(map) < 0 ? -1 : 1;
    std::vector<uint32_t> codes(normals.size(), VXL_NO_NORMAL);
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::vec3* n = &normals[3 * t];
        if (std::any_of(n, n + 3, [](const glm::vec3& v) { return v == glm::vec3(0); })) continue;
        const glm::dvec3 mean = glm::dvec3(n[0]) + glm::dvec3(n[1]) + glm::dvec3(n[2]);
        const double facing = glm::dot(mean, face_normal(mesh, mesh.triangles[t])) * outwards;
        const double side = facing < 0 ? -1 : 1;
        for (size_t i = 0; i < 3; ++i)
            codes[3 * t + i] = packed_normal(map * glm::dvec3(n[i]) * side);
    }
    return codes;
}

}  // namespace voxelume
