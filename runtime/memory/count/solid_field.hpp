// SPDX-License-Identifier: Apache-2.0
// solid -> the distance of points from its surface, in doubles, by which planning counts bricks.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// The distance to a solid's surface under a map, positive outside.
///
/// It is a lower bound under any map, so that a ball of that radius around the point is on one side
/// of the surface. Combinations take the minimum or maximum over their parts, as kernels do.
class SolidField {
  public:
    SolidField(const Solid& solid, const glm::dmat4& frame_from_solid);

    /// The distance in metres, as `p` in the frame's space.
    double distance(const glm::dvec3& p) const { return distance(0, p); }

  private:
    /// A node of the tree; its parts follow it, each with its own before the next.
    struct Node {
        Solid shape;  ///< without parts
        glm::dmat4 shape_from_frame{1};
        double scale = 1;  ///< the minimum factor by which the map stretches the shape's lengths
        uint32_t end = 0;  ///< one past the last node of its parts
    };

    void add(const Solid& solid, const glm::dmat4& frame_from_parent);
    double distance(uint32_t number, const glm::dvec3& p) const;

    std::vector<Node> nodes_;
};

}  // namespace voxelume
