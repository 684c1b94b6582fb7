// SPDX-License-Identifier: Apache-2.0
// The voxels whose crosshairs a triangle meets, in integers: the reference for the device's THIN.
#pragma once

#include <vector>

#include "runtime/verify/exact/exact_cover.hpp"

namespace voxelume {

/// The voxels of a region that starts at the origin which the triangle crosses on a line through
/// their centre along an axis. Some appear more than once. Bounds are those of exact_row.
///
/// Seen along the line, the triangle is filled row by row between two of its edges. A line that
/// lies on an edge is moved by (e, e², e³) for an infinitesimal e. A voxel contains the lower end
/// of its part of the line, but not the upper.
std::vector<glm::ivec3> exact_thin(const TriangleOnLattice& triangle, const glm::ivec3& region);

}  // namespace voxelume
