// SPDX-License-Identifier: Apache-2.0
// voxels of a file and where they are placed -> the world's bricks that they are stored in.
#pragma once

#include <glm/mat4x4.hpp>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/memory/count/brick_count.hpp"

namespace voxelume {

/// What a file's voxels are expected to take of `world`: its voxels in their volume, and the bricks
/// that the file's leaves of 4³ voxels reach into.
///
/// `spread` is the ratio of the box around a turned brick, in the object's space, to the brick. The
/// bricks of cubes are exact for maps that turn by right angles, and too many for others. For
/// voxels much larger than the world's, and for smooth ones, they follow from the volume alone.
BrickCount count_voxels(const VoxelModel& voxels, const glm::dmat4& world_from_object,
                        double spread, const GridFrame& world, TakenBricks& taken);

/// What they take at least, where the world shows all of them: no fewer bricks than the file's, and
/// one voxel for all of the file's that a larger one of the world holds.
SurfaceExtent min_count(const VoxelModel& voxels, const glm::dmat4& world_from_object,
                        const GridFrame& world);

}  // namespace voxelume
