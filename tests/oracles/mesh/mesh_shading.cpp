// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/mesh/mesh_shading.hpp"

namespace voxelume::oracle {
namespace {

/// Two vectors that span the plane whose normal is n.
std::array<glm::dvec3, 2> spanning(const glm::dvec3& n) {
    const glm::dvec3 other =
        std::abs(n.x) < 0.6 * glm::length(n) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::cross(n, other);
    return {u, glm::cross(n, u)};
}

}  // namespace

std::optional<ShadedHit> shaded_hit(const std::vector<ShadedTriangle>& triangles,
                                    const glm::dvec3& origin, const glm::dvec3& direction) {
    std::optional<ShadedHit> nearest;
    for (size_t i = 0; i < triangles.size(); ++i) {
        const auto& [a, b, c] = triangles[i].corners;
        // origin + t direction = a + v (b - a) + w (c - a), by Cramer's rule.
        const double whole = glm::determinant(glm::dmat3(-direction, b - a, c - a));
        if (whole == 0) continue;
        const glm::dvec3 from = origin - a;
        const double t = glm::determinant(glm::dmat3(from, b - a, c - a)) / whole;
        const double v = glm::determinant(glm::dmat3(-direction, from, c - a)) / whole;
        const double w = glm::determinant(glm::dmat3(-direction, b - a, from)) / whole;
        if (!(t > 0) || v < 0 || w < 0 || v + w > 1 || (nearest && nearest->t <= t)) continue;
        const auto& normals = triangles[i].normals;
        nearest = ShadedHit{
            t, i,
            glm::normalize(glm::normalize(normals[0]) * (1 - v - w) +
                           glm::normalize(normals[1]) * v + glm::normalize(normals[2]) * w)};
    }
    return nearest;
}

ShadedTriangle mapped(const ShadedTriangle& triangle, const glm::dmat4& map) {
    ShadedTriangle result;
    const glm::dmat3 turn(map);
    for (size_t i = 0; i < 3; ++i) {
        result.corners[i] = glm::dvec3(map * glm::dvec4(triangle.corners[i], 1));
        const auto [u, v] = spanning(triangle.normals[i]);
        const glm::dvec3 n = glm::cross(turn * u, turn * v);
        result.normals[i] = glm::dot(n, turn * triangle.normals[i]) < 0 ? -n : n;
    }
    return result;
}

}  // namespace voxelume::oracle
