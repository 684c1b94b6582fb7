// SPDX-License-Identifier: Apache-2.0
// mesh -> how thick its body is, measured on lines along the axes.
#pragma once

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The share of its area by which a body counts as thin.
inline constexpr double kThinShare = 0.02;

/// The thickness, in metres, that all but kThinShare of a closed mesh's area has behind it. A
/// regular lattice of 64 x 64 lines along each axis crosses it. Where a line enters through a face
/// that turns to it more than to the other axes, the way to the exit is the body's thickness times
/// the cosine of the angle, at least a third of that of a ball, and exactly that of a plate away
/// from its rim. Open meshes have some number, and those of which 1,024 faces lie before one
/// another nearly everywhere have 0. Sums are in the order of the triangles, so equal
/// meshes give equal numbers.
double thickness_of(const Mesh& mesh);

}  // namespace voxelume
