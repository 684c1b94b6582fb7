// SPDX-License-Identifier: Apache-2.0
// The part of a convex solid's edges that a distance field must show, if the field knows only the
// distances at the nodes of a lattice.
//
// The distance d of a convex solid is a convex function, in any affine space. Half-Taylor
// interpolation (Kraaijpoel & van Leeuwen 2010) subtracts from the trilinear interpolation of the
// same nodes a sum of second differences, none of which is negative for a convex function. So
// wherever the trilinear interpolation of d is below zero, the field is below zero, too, and a ray
// that comes there has met it. Around an edge with the angle w between its faces, the interpolation
// can be above d by half a voxel's diagonal along the difference of their normals, 1/2 cos(w/2)
// voxels on average over the corners (Jensen's inequality), so the edge may recede by 1/2 cot(w/2)
// voxels: 0.5 at 90 degrees, 1.2 at 45.
#pragma once

#include <array>
#include <glm/geometric.hpp>

#include "runtime/scene/scene.hpp"
#include "tests/oracles/analytic_solids.hpp"

namespace voxelume::oracle {

/// The trilinear interpolation of a solid's distances on the world's lattice.
class LatticeDistance {
  public:
    LatticeDistance(const World& world, const Solid& solid, const glm::dmat4& world_from_object)
        : origin_(world.bounds.min), edge_(world.voxel_size), solid_(solid, world_from_object) {}

    /// The distance at a point of the world, in metres; positive outside.
    double at(const glm::dvec3& point) const {
        const glm::dvec3 place = (point - origin_) / edge_;
        const glm::dvec3 voxel = glm::floor(place), part = place - voxel;
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
            const glm::dvec3 share = side * part + (1.0 - side) * (1.0 - part);
            const glm::dvec3 node = origin_ + (voxel + side) * edge_;
            sum += share.x * share.y * share.z * double(solid_.distance(Vector(node)));
        }
        return sum;
    }

    /// The minimum of `at` on the part of a ray that is inside the solid, from `t` metres on, in
    /// steps of a sixteenth of a voxel.
    double min_on(const glm::dvec3& origin, const glm::dvec3& direction, double t) const {
        const double step = edge_.x / 16;
        double minimum = 0;
        for (t += step; solid_.distance(Vector(origin + t * direction)) < 0; t += step)
            minimum = std::min(minimum, at(origin + t * direction));
        return minimum;
    }

  private:
    glm::dvec3 origin_, edge_;  // metres
    AnalyticSolid solid_;
};

/// True if the shape is convex and has edges, which a field rounds.
constexpr bool has_convex_edges(SolidKind kind) {
    return kind == SolidKind::box || kind == SolidKind::cylinder || kind == SolidKind::cone;
}

}  // namespace voxelume::oracle
