// SPDX-License-Identifier: Apache-2.0
// Analytic solids in long double: distances from the oracle's own formulas, ray crossings by
// bisection.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "runtime/scene/parts/solid.hpp"

namespace voxelume::oracle {

using Vector = glm::vec<3, long double>;

/// A tree of solids in a grid's space, in which points are in metres.
class AnalyticSolid {
  public:
    AnalyticSolid(const Solid& solid, const glm::dmat4& frame_from_solid);

    /// The distance, positive outside. For one shape under a turn and a uniform scale it is the
    /// Euclidean distance; otherwise it has the right sign and never exceeds the Euclidean
    /// distance.
    long double distance(const Vector& point) const;

    struct Crossing {
        long double t = 0;
        bool is_hit = false;
        bool is_certain = true;  ///< false: before t the ray grazes the surface so closely that two
                                 ///< crossings less than `uncertainty` apart may have been missed
        long double graze = -1;  ///< t of the last such place, -1 for none
    };

    /// The first t in (first, last) where a ray with unit `direction` (metres) changes sides.
    /// Places within 1000 `uncertainty` before the crossing belong to it.
    Crossing first_crossing(const Vector& origin, const Vector& direction, long double first,
                            long double last, long double uncertainty) const;

  private:
    struct Node {
        Solid solid;
        glm::mat<4, 4, long double> local_from_frame;
        long double scale = 1;  ///< smallest singular value of frame_from_local
        std::vector<Node> parts;
    };
    static Node make_node(const Solid& solid, const glm::mat<4, 4, long double>& frame_from_parent);
    static long double node_distance(const Node& node, const Vector& point);
    void search(const Vector& origin, const Vector& direction, long double first, long double last,
                long double uncertainty, Crossing& found) const;

    Node root_;
};

}  // namespace voxelume::oracle
