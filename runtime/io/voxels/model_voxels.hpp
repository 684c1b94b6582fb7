// SPDX-License-Identifier: Apache-2.0
// .vxm -> the voxels of a model.
#pragma once

#include <filesystem>

#include "runtime/geometry/voxel_model.hpp"

namespace voxelume {

/// Reads a model. Throws Error::input for a file that is missing, damaged or too large, or whose
/// model has another surface than `surface`.
VoxelModel read_model_voxels(const std::filesystem::path& path, Surface surface);

}  // namespace voxelume
