// SPDX-License-Identifier: Apache-2.0
// The point where a ray meets an analytic solid, in double. `voxelume bench` compares images with
// it.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

struct AnalyticHit {
    double t = 0;          ///< metres along the ray
    glm::dvec3 normal{0};  ///< unit vector out of the solid, in the world
};

/// True if `analytic_hit` supports the kind: sphere, box, torus.
bool has_analytic_hit(SolidKind kind);

/// The first point where a ray from outside meets a solid that is only turned and shifted.
///
/// `direction` is a unit vector. Sphere and box have closed forms. A torus's quartic is cut at the
/// roots of its derivatives, and its first change of sign is bisected to the last bit. Throws
/// Error::render for other kinds.
std::optional<AnalyticHit> analytic_hit(const Solid& solid, const glm::dmat4& world_from_solid,
                                        const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace voxelume
