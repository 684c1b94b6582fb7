// SPDX-License-Identifier: Apache-2.0
// solid -> the part of it in a grid, which is closed where the grid ends
#pragma once

#include <glm/mat4x4.hpp>

#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// The part of `frame_from_solid * solid` inside the grid, in the space of `frame`.
///
/// The faces on the grid's sides are surface. A solid that doesn't reach past them stays as it is;
/// boxes and slabs along the axes stay one shape.
Solid clipped_solid(const Solid& solid, const glm::dmat4& frame_from_solid, const GridFrame& frame);

}  // namespace voxelume
