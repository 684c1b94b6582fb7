// SPDX-License-Identifier: Apache-2.0
// voxels of a file and their placement -> the world's bricks in which they are stored.
#pragma once

#include <glm/mat4x4.hpp>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/memory/count/brick_count.hpp"

namespace voxelume {

/// The expected counts of a file's voxels in `world`: voxels by their volume, and bricks that the
/// file's leaves of 4³ voxels overlap.
///
/// `spread` is the ratio of the box around a turned brick, in the object's space, to the brick. The
/// bricks of cubes are exact for maps that turn by right angles, and too many for others. For
/// voxels much larger than the world's, and for smooth ones, they follow from the volume alone.
BrickCount count_voxels(const VoxelModel& voxels, const glm::dmat4& world_from_object,
                        double spread, const GridFrame& world, TakenBricks& taken);

/// The minimum counts, for a world that shows all of the file's voxels: at least the bricks of the
/// file, and one voxel of the world for each group that fits in it.
SurfaceExtent min_count(const VoxelModel& voxels, const glm::dmat4& world_from_object,
                        const GridFrame& world);

}  // namespace voxelume
