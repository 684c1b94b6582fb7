// SPDX-License-Identifier: Apache-2.0
// Classes of triangles that are difficult to voxelize, and the grids in which they lie.
#pragma once

#include "runtime/verify/exact/exact_cover.hpp"

namespace voxelume {

/// The number of consecutive triangles that share a grid. Each lies in a region of its own.
inline constexpr uint64_t kTrianglesOfOneGrid = 512;

/// The number of classes. Triangles change their class from grid to grid.
inline constexpr uint64_t kTriangleClasses = 10;

/// The regions of a grid: `counts` along each axis, x fastest, one for every triangle.
struct TriangleGrid {
    glm::ivec3 region{0};  ///< size in voxels, a whole number of bricks
    glm::ivec3 counts{0};

    glm::ivec3 size() const { return region * counts; }
    /// The start of the region of a grid's triangle `i`, in voxels.
    glm::ivec3 start(uint64_t i) const {
        const int n = int(i);
        return glm::ivec3(n % counts.x, n / counts.x % counts.y, n / (counts.x * counts.y)) *
               region;
    }
};

/// Rotates the axes by one place, `turns` times.
inline glm::ivec3 turned(glm::ivec3 p, int turns) {
    for (int i = 0; i < turns; ++i) p = {p.y, p.z, p.x};
    return p;
}

/// The grid of triangle `number`.
TriangleGrid grid_of_triangle(uint64_t number);

/// Triangle `number`, in a region that starts at the origin. Its position in the grid is exact in
/// floats of voxels. The classes are: small triangles, slivers, tilted by a unit, in grid planes,
/// on half voxels, large ones, without area, on corners, narrow ones of up to 16384 voxels, and
/// triangles far larger than the grid.
TriangleOnLattice stress_triangle(uint64_t seed, uint64_t number);

}  // namespace voxelume
