// The cells that a ray passes, in order, in rational numbers: slow, and plain enough to be
// believed.
#pragma once

#include <gmpxx.h>

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace oracle {

using Rational3 = std::array<mpq_class, 3>;

/// A cell, and across which axis the ray came into it; 3: it began there.
struct RationalCell {
    glm::ivec3 cell{0};
    int axis = 3;
};

/// The numbers themselves, of which every float and double is a rational one.
Rational3 rationals(double x, double y, double z);

/// The cells of [0, size) that the ray o + d t, t >= 0, passes, at most `maximum`.
///
/// A ray that begins outside comes in where it meets the grid. A point on a plane belongs to the
/// cell being entered, along an axis on which the ray doesn't move to the upper one; crossings at
/// one t are taken lowest axis first.
std::vector<RationalCell> rational_walk(const Rational3& o, const Rational3& d,
                                        const glm::ivec3& size, size_t maximum = 1 << 20);

}  // namespace oracle
