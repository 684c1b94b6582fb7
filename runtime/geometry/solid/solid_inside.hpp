// SPDX-License-Identifier: Apache-2.0
// solid -> whether a point lies inside, and how thin it is, by formulas in doubles.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// True if a point in the space of the solid's parent lies inside of it, not on its surface.
bool is_inside(const Solid& solid, const glm::dvec3& point);

/// The width of the thinnest shape of a solid under a linear map. What a difference takes away
/// doesn't count, so the solid itself may be thinner.
double thickness(const Solid& solid, const glm::dmat3& map);

}  // namespace voxelume
