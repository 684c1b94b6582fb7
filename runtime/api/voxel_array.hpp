// SPDX-License-Identifier: Apache-2.0
// Voxels in a caller's memory -> models that scenes name.
#pragma once

#include <span>

#include "runtime/scene_file/assets.hpp"
#include "runtime/voxelume/objects.hpp"

namespace voxelume::api {

/// The arrays as models of cubes, by their names. Throws as SceneOptions::voxels says.
GivenVoxels given_voxels(std::span<const v1::VoxelArray> arrays);

}  // namespace voxelume::api
