// The voxels whose crosshairs a triangle meets, in integers: what the device's THIN is held
// against.
#pragma once

#include <vector>

#include "runtime/verify/exact/exact_cover.hpp"

namespace voxelume {

/// The voxels of a region from the origin on that the triangle crosses on a line through their
/// centre along an axis, some more than once. Bounds are those of exact_row.
///
/// Seen along the line, the triangle is filled row by row between two of its edges; a line that
/// lies on an edge is moved by (e, e², e³) for an infinitesimal e. A voxel has the lower of the two
/// ends of its part of the line, and not the upper.
std::vector<glm::ivec3> exact_thin(const TriangleOnLattice& triangle, const glm::ivec3& region);

}  // namespace voxelume
