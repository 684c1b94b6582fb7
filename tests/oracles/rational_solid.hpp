// SPDX-License-Identifier: Apache-2.0
// The side of an analytic solid that a point is on, by the signs of polynomials in rational
// numbers. It shares no code with the kernels or with the host's exact side.
#pragma once

#include <vector>

#include "runtime/scene/parts/solid.hpp"
#include "tests/oracles/rational_map.hpp"

namespace voxelume::oracle {

/// A tree of solids under a rational affine map.
class RationalSolid {
  public:
    RationalSolid(const Solid& solid, const RationalMap& frame_from_solid);

    /// Returns -1 inside, 0 on the boundary, 1 outside. For a combination, it is the minimum of its
    /// parts' sides (union) or the maximum (intersection); parts that are subtracted have the
    /// opposite sign.
    int side(const glm::dvec3& point) const;

  private:
    /// The side, or another value if long doubles can't decide it: they do where a value is more
    /// than 10^6 times as large as the bound on its rounding.
    int likely_side(const glm::dvec3& point) const;

    Solid solid_;
    RationalMap solid_from_frame_;
    std::array<long double, 12> rounded_{};  // solid_from_frame_ in long doubles: three rows of
                                             // linear, then the offset
    std::vector<RationalSolid> parts_;
};

}  // namespace voxelume::oracle
