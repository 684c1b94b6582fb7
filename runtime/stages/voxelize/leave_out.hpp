// SPDX-License-Identifier: Apache-2.0
// distance field -> the field without the parts of its mesh that are shown in another way.
#pragma once

#include <glm/mat4x4.hpp>
#include <span>

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// The number of voxels around the points, along each axis, within which a field lies behind its
/// mesh.
inline constexpr int kLeftOut = 5;

/// Raises the distances around points, unless the field's voxels are larger than those of
/// `voxel_edge` by more than a third. Walls thinner than two voxels around the points then have no
/// surface, and within kLeftOut voxels of the points the body's surface sinks gradually below that
/// of its mesh, which must be shown in another way there. Points and edge are in the mesh's space.
void leave_out(std::span<const glm::vec3> points, double voxel_edge,
               const glm::dmat4& frame_from_mesh, BrickGrid& field);

}  // namespace voxelume
