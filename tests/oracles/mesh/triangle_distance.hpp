// SPDX-License-Identifier: Apache-2.0
// The distance from a point to a triangle, in double precision, feature by feature.
#pragma once

#include <glm/glm.hpp>

namespace voxelume::oracle {

/// The distance from `p` to the closed triangle abc, which may have no area.
double distance_to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c);

}  // namespace voxelume::oracle
