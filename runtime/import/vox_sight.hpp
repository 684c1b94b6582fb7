// SPDX-License-Identifier: Apache-2.0
// The cameras and render settings of a MagicaVoxel file, as an observer and as light.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "runtime/import/contents.hpp"
#include "runtime/import/file_light.hpp"
#include "runtime/io/voxels/vox_file.hpp"
#include "runtime/scene/parts/bounds.hpp"

namespace voxelume {

/// The first camera that is in use; null where the file has none.
const VoxCamera* used_camera(const VoxFile& vox);

/// `"observer": {...}` of the file's camera, who sees what is in the box; empty where it has none.
/// Voxels have edges of `voxel` metres.
FileObserver vox_observer(const VoxFile& vox, const Bounds& box, const glm::ivec2& size,
                          double voxel);

/// The light of the file's settings, or of MagicaVoxel's defaults where it has none. The scene's
/// voxels have edges of `voxel` metres.
FileLight vox_file_light(const VoxRender& render, double voxel = 1);

}  // namespace voxelume
