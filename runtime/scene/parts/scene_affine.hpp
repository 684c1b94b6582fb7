// SPDX-License-Identifier: Apache-2.0
// Affine maps from the factors that scene files give: positions, turns in degrees, scales.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "runtime/scene/parts/value_row.hpp"

namespace voxelume {

/// R = R_y(psi) * R_x(theta) * R_z(gamma) for turn = (psi, theta, gamma) in degrees, right-handed.
/// Turns by multiples of 90 degrees give exactly 0 and +-1.
glm::dmat3 rotation_from_turn(glm::dvec3 turn);

/// A turn in degrees that gives the rotation: theta from -90 to 90, the others from -180 to 180.
/// Where theta is +-90 and only one of the others is determined, both together are right.
glm::dvec3 turn_from_rotation(const glm::dmat3& rotation);

/// The factors of a placement.
struct Factors {
    glm::dvec3 position{0};  ///< metres
    glm::dvec3 turn{0};      ///< degrees
    glm::dvec3 scale{1};
};

/// Moves a point that is first scaled, then turned, then shifted.
glm::dmat4 affine_from_factors(glm::dvec3 position, glm::dvec3 turn, glm::dvec3 scale);
inline glm::dmat4 affine_from_factors(const Factors& factors) {
    return affine_from_factors(factors.position, factors.turn, factors.scale);
}

/// The product of a chain of placements, each relative to the one before.
glm::dmat4 product_of(std::span<const glm::dmat4> links);

/// Smallest and largest length of the images of unit vectors: the singular values of a map.
struct Stretch {
    double min;
    double max;
};
Stretch stretch_of(const glm::dmat3& linear);

inline constexpr double kMinStretch = 1e-9;
inline constexpr double kMaxCondition = 1e5;  ///< largest over smallest stretch

/// True for stretches that are allowed for objects and parts of solids.
inline bool is_safely_invertible(const Stretch& stretch) {
    return stretch.min >= kMinStretch && stretch.max <= stretch.min * kMaxCondition;
}

/// The rows of `position`, `turn` and `scale`.
std::span<const ValueRow<Factors>> factor_rows();

/// Refuses a map that isn't safely invertible, at the value with the key.
void check_map(const glm::dmat4& map, std::string_view key, const Refuse& refuse);

}  // namespace voxelume
