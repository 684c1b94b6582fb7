// Triangles that are hard to voxelize, in classes, and the grids in which they lie.
#pragma once

#include "runtime/verify/exact/exact_cover.hpp"

namespace voxelume {

/// Triangles in a row that share a grid, each in a region of its own.
inline constexpr uint64_t kTrianglesOfOneGrid = 512;

/// Triangles change their class from grid to grid.
inline constexpr uint64_t kTriangleClasses = 10;

/// A grid's regions: `counts` of them along each axis, x fastest, one for every triangle.
struct TriangleGrid {
    glm::ivec3 region{0};  ///< voxels, whole bricks
    glm::ivec3 counts{0};

    glm::ivec3 size() const { return region * counts; }
    /// Where the region of a grid's triangle `i` begins, in voxels.
    glm::ivec3 start(uint64_t i) const {
        const int n = int(i);
        return glm::ivec3(n % counts.x, n / counts.x % counts.y, n / (counts.x * counts.y)) *
               region;
    }
};

/// Axes turned on by one, `turns` times.
inline glm::ivec3 turned(glm::ivec3 p, int turns) {
    for (int i = 0; i < turns; ++i) p = {p.y, p.z, p.x};
    return p;
}

/// The grid of triangle `number`.
TriangleGrid grid_of_triangle(uint64_t number);

/// Triangle `number`, in a region from the origin on. Its place in the grid is exact in floats of
/// voxels. Classes: small ones, slivers, tilted by a unit, in grid planes, on half voxels, large
/// ones, without area, on corners, of up to 16384 voxels but narrow, and far larger than the grid.
TriangleOnLattice stress_triangle(uint64_t seed, uint64_t number);

}  // namespace voxelume
