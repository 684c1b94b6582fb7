// SPDX-License-Identifier: Apache-2.0
// Rays from outside of a ring to points inside it.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "kernels/shared/trace.h"
#include "runtime/geometry/mesh.hpp"
#include "runtime/verify/exact/exact_walk.hpp"
#include "runtime/verify/stress/stress_random.hpp"

namespace voxelume {

/// A ring with an elliptic tube in a grid, in voxels. It lies around z; `turns` rotates the axes.
struct Ring {
    glm::ivec3 grid_size{0};
    glm::dvec3 center{0};
    double radius = 0, tube = 0, flatness = 1;
    int turns = 0;

    /// A point of the tube: on the surface for a `share` of 1, inside it for less.
    glm::dvec3 point(double around, double across, double share) const;
    /// A lower bound, in voxels: of the distance outside the ring if positive, of the depth inside
    /// if negative.
    double outside(const glm::dvec3& p) const;
    Mesh mesh() const;
};

/// Rings of different sizes, shapes and axes. The last one is alone in a wide space.
inline constexpr std::array kRings = {
    Ring{{87, 83, 45}, {43.3, 41.1, 22.6}, 25.2, 11.4, 1.3, 0},
    Ring{{69, 31, 75}, {34.6, 15.4, 37.9}, 18.7, 8.9, 0.8, 1},
    Ring{{190, 75, 214}, {101.4, 37.2, 88.3}, 27.1, 9.7, 1.1, 2},
};

/// A ray, and the t of one of its points inside the ring.
struct InwardRay {
    FixedRay ray;
    double inside = 0;
};

/// A ray from the grid's sides, or through lattice points, edges and corners. `share` is the share
/// of the tube within which a point is certainly inside.
InwardRay inward_ray(const Ring& ring, const FixedGrid& grid, double share, StressRandom& random);

/// A tile of neighbouring rays, from one point on a side of the grid or from near each other.
std::array<InwardRay, VXL_BEAM_RAYS> inward_tile(const Ring& ring, const FixedGrid& grid,
                                                 double share, StressRandom& random);

/// The position of a ray at t, in voxels.
glm::dvec3 point_at(const FixedGrid& grid, const FixedRay& ray, double t);

}  // namespace voxelume
