// SPDX-License-Identifier: Apache-2.0
// The points where a straight line enters and leaves an analytic solid, in closed form.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "runtime/scene/parts/solid.hpp"

namespace voxelume::oracle {

/// The line origin + direction * t, for all real t.
struct Line {
    glm::dvec3 origin{0};
    glm::dvec3 direction{0};
};

/// One point where a line passes through a surface.
struct Crossing {
    double t = 0;
    bool enters = false;  ///< true if the line's direction leads into the solid
    int face = 0;         ///< number of the smooth part of the surface; it differs across edges
};

/// All crossings of a line. They alternate between entering and leaving, and t never decreases.
struct Crossings {
    std::array<Crossing, 4> list{};
    int count = 0;
};

/// A sphere, ellipsoid, box, cylinder, cone, torus, capsule or slab under any affine map.
class PlacedSolid {
  public:
    /// Places a solid. Throws std::invalid_argument for combinations.
    PlacedSolid(const Solid& solid, const glm::dmat4& world_from_solid);

    /// The crossings of a line. A line that only touches the solid has none.
    Crossings crossings(const Line& line) const;

    /// The unit normal that points out of the solid, at a point of the surface's part `face`.
    glm::dvec3 normal(const glm::dvec3& point, int face) const;

  private:
    Solid solid_;
    glm::dmat4 solid_from_world_;
};

}  // namespace voxelume::oracle
