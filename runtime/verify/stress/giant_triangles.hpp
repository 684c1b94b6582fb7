// SPDX-License-Identifier: Apache-2.0
// Triangles far larger than their grid: their planes need the upper of 128 bits.
#pragma once

#include "runtime/verify/stress/stress_random.hpp"
#include "runtime/verify/stress/triangle_classes.hpp"

namespace voxelume {

/// Grid number `grid` of giant triangles: a pillar of regions. In each region one triangle fills a
/// slanting section.
TriangleGrid grid_of_giant_triangles(uint64_t grid);

/// The triangle of region `number` of that grid, relative to the region's origin. Its corners are
/// up to 16384 voxels from the grid's origin.
TriangleOnLattice giant_triangle(StressRandom& random, uint64_t grid, uint64_t number);

}  // namespace voxelume
