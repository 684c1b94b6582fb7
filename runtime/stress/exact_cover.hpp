// The voxels that a triangle meets, in integers: what the device's SUPERCOVER is held against.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace voxelume {

/// Corners in 1/4096 voxel.
using TriangleOnLattice = std::array<glm::ivec3, 3>;

/// Voxels of a row; none where first > last.
struct VoxelRow {
    int64_t first = 0, last = -1;
};

/// The voxels of row (y, z) along x whose closed cubes the closed triangle meets. The triangle
/// spans at most 2^8 voxels and lies within 2^12 of the origin.
///
/// The row's prism and the triangle meet in a polygon. Its corners are corners of the triangle,
/// points where the triangle's edges pass the prism's sides, or points where the prism's edges pass
/// the triangle; the row's voxels reach from the lowest of them to the highest.
VoxelRow exact_row(const TriangleOnLattice& triangle, int y, int z);

}  // namespace voxelume
