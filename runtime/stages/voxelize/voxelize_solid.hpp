// SPDX-License-Identifier: Apache-2.0
// analytic solid -> object grid.
#pragma once

#include <glm/mat4x4.hpp>

#include <vector>
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/parts/solid.hpp"

#include "runtime/stages/voxelize/voxelize_options.hpp"

namespace voxelume {

/// Fills a grid with an analytic solid, which is evaluated directly instead of from a mesh of it.
///
/// `frame_from_solid` maps the model's space to the space in which `frame` is given; see
/// frame_around() for a frame. Parts of the solid outside of the frame are cut off.
///   smooth  distances at all nodes of the bricks in which one is below 2.8 voxels. They are right
///           within half a unit and the shapes' SolidShape::rounding.
///   cubes   the set that is asked for. SOLID and THIN are exact for the doubles given: points that
///           float can't decide are decided on the host in exact arithmetic, and the boundary
///           counts as inside. THIN: the voxel's middle and a middle of its faces are on different
///           sides.
///           SUPERCOVER leaves out no voxel that the surface touches, and the surface comes within
///           0.44 voxel of each voxel in it.
///   exact   SUPERCOVER; each voxel lists the solid itself, number 0 of BrickGrid::solids.
/// `attributes` and `colors` stay empty: material 0, object 0, white. The grid is the same, bit for
/// bit, for every device and number of lanes. Throws Error::limit as make_solid_program does, and
/// if the device's memory doesn't suffice.
BrickGrid voxelize_solid(const Device& device, const Solid& solid,
                         const glm::dmat4& frame_from_solid, const GridFrame& frame,
                         const VoxelizeOptions& options);

/// Voxelizes a `smooth` solid as voxelize_solid does, or everything outside of it.
BrickGrid voxelize_part(const Device& device, const Solid& solid, bool is_complement,
                        const glm::dmat4& frame_from_solid, const GridFrame& frame);

/// The grids of a formula's parts, in its order, as one grid with parts. Only parts that decide
/// somewhere in the common frame are kept. The grid has no bricks if there are none.
BrickGrid with_parts(std::vector<GridPart> parts);

/// Voxelizes a `smooth` solid as voxelize_solid does, with a grid for each of its parts_of() whose
/// surface passes through the frame.
BrickGrid voxelize_parts(const Device& device, const Solid& solid,
                         const glm::dmat4& frame_from_solid, const GridFrame& frame);

}  // namespace voxelume
