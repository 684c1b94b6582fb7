// SPDX-License-Identifier: Apache-2.0
// Triangles many times as long as wide. From 128 voxels on their planes are computed in 128 bits.
#pragma once

#include "runtime/verify/stress/stress_random.hpp"
#include "runtime/verify/stress/triangle_classes.hpp"

namespace voxelume {

/// Grid number `grid` of long triangles. Its regions are up to 16384 voxels long.
TriangleGrid grid_of_long_triangles(uint64_t grid);

/// A triangle of that grid, in a region that starts at the origin.
TriangleOnLattice long_triangle(StressRandom& random, uint64_t grid);

}  // namespace voxelume
