// triangles of nasty classes -> mismatches between the voxels that they get and the exact ones.
#pragma once

#include "runtime/stress/exact_cover.hpp"
#include "runtime/stress/stress.hpp"

namespace voxelume {

/// Triangles that share a grid, each in a region of its own.
inline constexpr uint64_t kTrianglesOfOneGrid = 512;
inline constexpr int kRegion = 48;  ///< voxels along a region's edge

/// Triangle `number`, in a region from the origin on. Classes change from grid to grid: small ones,
/// slivers, tilted by a unit, in grid planes, on half voxels, large ones, without area, on corners.
TriangleOnLattice stress_triangle(uint64_t seed, uint64_t number);

/// Tries the SUPERCOVER of triangles.
StressResult stress_triangles(const StressRun& run);

}  // namespace voxelume
