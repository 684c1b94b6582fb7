// Which side of an analytic solid a point is on, by the signs of polynomials in rational numbers.
// Shares no code with the kernels, nor with the host's exact side.
#pragma once

#include <vector>

#include "runtime/scene/solid.hpp"
#include "tests/oracles/rational_map.hpp"

namespace voxelume::oracle {

/// A tree of solids under a rational affine map.
class RationalSolid {
  public:
    RationalSolid(const Solid& solid, const RationalMap& frame_from_solid);

    /// -1 inside, 0 on the boundary, 1 outside. Of a combination: the least of its parts' sides
    /// (union) or the greatest (intersection), those taken away with the other sign.
    ///
    /// Signs are first asked of long doubles, and believed where the value is 10^6 times as large
    /// as what rounding leaves of it.
    int side(const glm::dvec3& point) const;

  private:
    /// The side, or something else where long doubles don't say.
    int likely_side(const glm::dvec3& point) const;

    Solid solid_;
    RationalMap solid_from_frame_;
    std::array<long double, 12> rounded_{};  // of that map: three rows of linear, then the offset
    std::vector<RationalSolid> parts_;
};

}  // namespace voxelume::oracle
