// SPDX-License-Identifier: Apache-2.0
// Models of a .vox file -> voxels, with Y up.
#pragma once

#include <glm/mat4x4.hpp>
#include <span>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/io/voxels/vox_file.hpp"

namespace voxelume {

/// The cubes of a file, a voxel 1 long, with its colours. `part` is the number of a model, from 1
/// on, whose origin is the corner at an object's translation; 0: all objects of frame 0, with their
/// placements, of which earlier ones cover later ones.
///
/// Palette entries whose material isn't diffuse are groups by the name of that material, after a
/// group "diffuse"; without such voxels there are no groups. Throws Error::input for a part that
/// there isn't, for voxels outside of their model, and for more bricks than a model may have.
VoxelModel read_vox_voxels(const VoxFile& vox, int part);

/// The map from a model's voxels, Y up, to an object with this pose.
glm::dmat4 placement_of(const VoxPose& pose);

/// The number of voxels with each palette index, over all models.
std::array<uint64_t, 256> count_palette(const VoxFile& vox);

}  // namespace voxelume
