// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/winding_number.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace voxelume {

double winding_number(const Mesh& mesh, const glm::dvec3& point) {
    double half_angles = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - point,
                         b = glm::dvec3(mesh.positions[t.y]) - point,
                         c = glm::dvec3(mesh.positions[t.z]) - point;
        const double volume = glm::dot(a, glm::cross(b, c));
        if (volume == 0) continue;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        half_angles += std::atan2(
            volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return half_angles / (2 * std::numbers::pi);
}

}  // namespace voxelume
