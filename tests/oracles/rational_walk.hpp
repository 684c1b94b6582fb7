// SPDX-License-Identifier: Apache-2.0
// The cells that a ray passes, in order, in rational numbers: slow, but simple enough to be
// trusted.
#pragma once

#include <gmpxx.h>

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace voxelume::oracle {

using Rational3 = std::array<mpq_class, 3>;

/// A cell, and the axis across which the ray entered it; 3 if the ray began there.
struct RationalCell {
    glm::ivec3 cell{0};
    int axis = 3;
};

/// The exact coordinates; every float and double is a rational number.
Rational3 rationals(double x, double y, double z);

/// The cells of [0, size) that the ray o + d t, t >= 0, passes; at most `maximum` of them.
/// A ray that begins outside enters where it meets the grid. A point on a plane belongs to the cell
/// being entered; along an axis on which the ray doesn't move, to the upper cell. Crossings at one
/// t are taken lowest axis first.
std::vector<RationalCell> rational_walk(const Rational3& o, const Rational3& d,
                                        const glm::ivec3& size, size_t maximum = 1 << 20);

}  // namespace voxelume::oracle
