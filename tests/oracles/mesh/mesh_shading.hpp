// SPDX-License-Identifier: Apache-2.0
// The shading normal of a mesh where a ray first meets it, in double precision.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <vector>

namespace voxelume::oracle {

/// A triangle and the normals of its corners, of any length above 0.
struct ShadedTriangle {
    std::array<glm::dvec3, 3> corners, normals;
};

struct ShadedHit {
    double t = 0;
    size_t triangle = 0;
    /// The mean of the corners' unit normals by the corners' weights at the point, of unit length.
    glm::dvec3 normal{0};
};

/// Where origin + direction * t, t > 0, first meets one of the triangles, from either side.
std::optional<ShadedHit> shaded_hit(const std::vector<ShadedTriangle>& triangles,
                                    const glm::dvec3& origin, const glm::dvec3& direction);

/// The triangle under an affine map. Its normals stay perpendicular to the planes that they
/// belonged to.
ShadedTriangle mapped(const ShadedTriangle& triangle, const glm::dmat4& map);

}  // namespace voxelume::oracle
