// SPDX-License-Identifier: Apache-2.0
// Files of voxels (.vxm, OpenVDB) -> models that need no voxelizing.
#pragma once

#include <filesystem>
#include <optional>

#include "runtime/geometry/voxel_model.hpp"

namespace voxelume {

/// Reads a model. The first bytes of its file decide its format.
///
/// A .vxm has to have the surface `surface`. From OpenVDB, cubes are the voxels of a fog whose
/// value is above 0; the value, at most 1, is their coverage, and `Cd` their colour. A smooth
/// surface is a level set. Throws Error::input for a file that is missing, damaged or has another
/// surface.
VoxelModel read_voxel_model(const std::filesystem::path& file, Surface surface);

/// The surface that a .vxm says it has; none for other files. Throws Error::input for a missing or
/// damaged one.
std::optional<Surface> surface_of_voxel_model(const std::filesystem::path& file);

}  // namespace voxelume
