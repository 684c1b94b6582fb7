// SPDX-License-Identifier: Apache-2.0
// world -> the directions from which points of a lattice are seen from outside.
#pragma once

#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/float4.hpp"

namespace voxelume {

/// Vectors from outside of the world to a point in it, in voxels, one for each view. View 0 is the
/// observer's and has no vector of its own. The others run along the axes, with the view from above
/// first, then along the diagonals of faces, then along those of the cube.
std::vector<float4> ways_from_outside(const GridFrame& world);

}  // namespace voxelume
