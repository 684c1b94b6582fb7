// Rays from outside of a ring to points inside of it.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "kernels/shared/trace.h"
#include "runtime/geometry/mesh.hpp"
#include "runtime/verify/exact/exact_walk.hpp"
#include "runtime/verify/stress/stress_random.hpp"

namespace voxelume {

/// A ring with an elliptic tube in a grid, in voxels: around z, turned on to y, x by `turns`.
struct Ring {
    glm::ivec3 grid_size{0};
    glm::dvec3 center{0};
    double radius = 0, tube = 0, flatness = 1;
    int turns = 0;

    /// On the surface for `share` 1, within it for less.
    glm::dvec3 point(double around, double across, double share) const;
    /// At least so many voxels outside, where positive; inside, where negative.
    double outside(const glm::dvec3& p) const;
    Mesh mesh() const;
};

/// Of other sizes, shapes and axes; the last one alone in a wide space.
inline constexpr std::array kRings = {
    Ring{{87, 83, 45}, {43.3, 41.1, 22.6}, 25.2, 11.4, 1.3, 0},
    Ring{{69, 31, 75}, {34.6, 15.4, 37.9}, 18.7, 8.9, 0.8, 1},
    Ring{{190, 75, 214}, {101.4, 37.2, 88.3}, 27.1, 9.7, 1.1, 2},
};

/// A ray, and the t of a point inside the ring.
struct InwardRay {
    FixedRay ray;
    double inside = 0;
};

/// `share` is how far from the middle of the tube a point is inside for certain. From the grid's
/// sides, and through lattice points, edges and corners.
InwardRay inward_ray(const Ring& ring, const FixedGrid& grid, double share, StressRandom& random);

/// Rays beside each other, from one place on a side of the grid or from near each other.
std::array<InwardRay, VXL_BEAM_RAYS> inward_tile(const Ring& ring, const FixedGrid& grid,
                                                 double share, StressRandom& random);

/// Where a ray is at t, in voxels.
glm::dvec3 point_at(const FixedGrid& grid, const FixedRay& ray, double t);

}  // namespace voxelume
