// SPDX-License-Identifier: Apache-2.0
// The voxels that a triangle meets, in integers: the reference for the device's SUPERCOVER.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace voxelume {

inline constexpr int kUnitsPerVoxel = 4096;

/// A triangle by its corners, in 1/4096 voxel.
using TriangleOnLattice = std::array<glm::ivec3, 3>;

/// The voxels of a row; none if first > last.
struct VoxelRow {
    int64_t first = 0, last = -1;
};

/// The voxels of row (y, z) along x whose closed cubes the closed triangle meets. Corners and rows
/// lie within 2^15 voxels of the origin: coordinates are up to 2^27 units and differences 2^28, so
/// that the sum of products of two fits 58 bits. Products of three are formed in 128 bits.
///
/// The row's prism and the triangle meet in a polygon. Its corners are corners of the triangle,
/// points where the triangle's edges pass the prism's sides, or points where the prism's edges pass
/// the triangle. The row's voxels extend from the lowest of these points to the highest.
VoxelRow exact_row(const TriangleOnLattice& triangle, int y, int z);

/// The rows y of layer z that have such voxels.
VoxelRow exact_rows(const TriangleOnLattice& triangle, int z);

}  // namespace voxelume
