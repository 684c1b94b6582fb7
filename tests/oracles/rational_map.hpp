// Affine maps in rational numbers.
#pragma once

#include <gmpxx.h>

#include <array>
#include <glm/mat4x4.hpp>

namespace voxelume::oracle {

using RationalPoint = std::array<mpq_class, 3>;

/// The numbers themselves, of which every double is a rational one.
RationalPoint rational_point(const glm::dvec3& p);

/// p -> linear * p + offset; `linear` by rows.
struct RationalMap {
    std::array<RationalPoint, 3> linear{RationalPoint{1, 0, 0}, RationalPoint{0, 1, 0},
                                        RationalPoint{0, 0, 1}};
    RationalPoint offset{0, 0, 0};

    RationalPoint operator*(const RationalPoint& p) const;
    RationalMap operator*(const RationalMap& inner) const;
};

/// The map that has a matrix's doubles as entries.
RationalMap rational_map(const glm::dmat4& m);

/// The turn of the quaternion (a,b,c,d), unrounded: whole numbers over a²+b²+c²+d².
RationalMap rational_turn(int a, int b, int c, int d);

/// Throws std::invalid_argument for a map that has none.
RationalMap inverse(const RationalMap& map);

}  // namespace voxelume::oracle
