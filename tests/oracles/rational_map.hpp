// SPDX-License-Identifier: Apache-2.0
// Affine maps in rational numbers.
#pragma once

#include <gmpxx.h>

#include <array>
#include <glm/mat4x4.hpp>

namespace voxelume::oracle {

using RationalPoint = std::array<mpq_class, 3>;

/// The point's exact coordinates; every double is a rational number.
RationalPoint rational_point(const glm::dvec3& p);

/// The map p -> linear * p + offset, with `linear` stored by rows.
struct RationalMap {
    std::array<RationalPoint, 3> linear{RationalPoint{1, 0, 0}, RationalPoint{0, 1, 0},
                                        RationalPoint{0, 0, 1}};
    RationalPoint offset{0, 0, 0};

    RationalPoint operator*(const RationalPoint& p) const;
    RationalMap operator*(const RationalMap& inner) const;
};

/// The map whose entries are a matrix's doubles.
RationalMap rational_map(const glm::dmat4& m);

/// The unrounded turn by the quaternion (a,b,c,d): whole numbers over a²+b²+c²+d².
RationalMap rational_turn(int a, int b, int c, int d);

/// The inverse of a map. Throws std::invalid_argument if it has none.
RationalMap inverse(const RationalMap& map);

}  // namespace voxelume::oracle
