// SPDX-License-Identifier: Apache-2.0
// distance field -> the field without the parts of its mesh that are shown otherwise.
#pragma once

#include <glm/mat4x4.hpp>
#include <span>

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// The number of voxels from the points, along each axis, within which a field lies behind its
/// mesh.
inline constexpr int kLeftOut = 5;

/// Raises the distances around points, unless the field's voxels are larger than those of
/// `voxel_edge` by more than a third. Walls below two voxels around the points have no surface
/// then, and towards them the body's surface sinks, from nothing at kLeftOut voxels on, below that
/// of its mesh, which must be shown otherwise there. Points and edge are in the mesh's space.
void leave_out(std::span<const glm::vec3> points, double voxel_edge,
               const glm::dmat4& frame_from_mesh, BrickGrid& field);

}  // namespace voxelume
