// SPDX-License-Identifier: Apache-2.0
// The t at which a ray meets a triangle, in rational numbers.
#pragma once

#include <optional>

#include "tests/oracles/rational_map.hpp"

namespace voxelume::oracle {

/// The t >= 0 at which o + d t is in the closed triangle, from either side. Returns nothing for a
/// ray that misses the triangle or lies in its plane, and for a triangle without area.
std::optional<mpq_class> ray_meets_triangle(const RationalPoint& o, const RationalPoint& d,
                                            const std::array<RationalPoint, 3>& triangle);

}  // namespace voxelume::oracle
