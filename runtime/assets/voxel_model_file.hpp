// Files of voxels (.vxm, OpenVDB) -> models that need no voxelizing.
#pragma once

#include <filesystem>

#include "runtime/geometry/voxel_model.hpp"

namespace voxelume {

/// Reads a model by what its file begins with.
///
/// .vxm: its own surface must be `surface`. OpenVDB: as cubes the voxels of a fog whose value is
/// above 0, covering by that value, at most 1, with the colours of `Cd`; as smooth a level set.
/// Throws Error::input for a file that is missing, damaged or holds another surface.
VoxelModel read_voxel_model(const std::filesystem::path& file, Surface surface);

}  // namespace voxelume
