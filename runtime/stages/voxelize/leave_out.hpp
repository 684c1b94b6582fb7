// SPDX-License-Identifier: Apache-2.0
// distance field -> the field without the parts of its mesh that are shown otherwise.
#pragma once

#include <glm/mat4x4.hpp>
#include <span>

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// Within so many voxels of the points along each axis, a field has no surface.
inline constexpr int kLeftOut = 5;

/// Makes the distances around points outside, as if nothing were there, unless the field's voxels
/// are larger than those of `voxel_edge` by more than a third. Where the field is cut, its body
/// ends in a wall within four such voxels of the points, which must lie in a body that is shown
/// otherwise. Points and edge are in the mesh's space.
void leave_out(std::span<const glm::vec3> points, double voxel_edge,
               const glm::dmat4& frame_from_mesh, BrickGrid& field);

}  // namespace voxelume
