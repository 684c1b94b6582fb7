// SPDX-License-Identifier: Apache-2.0
// Files of voxels (.vxm, OpenVDB, .vox and those of voxel_file_table.hpp) -> models that need no
// voxelizing.
#pragma once

#include <filesystem>
#include <optional>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/io/voxels/vox_file.hpp"
#include "runtime/scene/parts/voxel_values.hpp"

namespace voxelume {

/// Reads a model. The first bytes of its file decide its format.
///
/// A .vxm has to have the surface `surface`. From OpenVDB, cubes are the voxels of a fog whose
/// value is above 0; the value, at most 1, is their coverage, and `Cd` their colour. A smooth
/// surface is a level set. A .vox has cubes alone, and `part` says which of its models, as
/// read_vox_voxels has it. For other formats see read_voxel_file. Throws Error::input for a file
/// that is missing, damaged or has another surface, and for a part of other files.
VoxelModel read_voxel_model(const std::filesystem::path& file, Surface surface, int part = 0,
                            const VoxelValues& values = {});

/// Reads a model as read_voxel_model does, with colours as codes if its file has them as codes.
VoxelModel read_coded_model(const std::filesystem::path& file, Surface surface, int part = 0,
                            const VoxelValues& values = {});

/// True if a file begins as those of MagicaVoxel do.
bool is_vox_file(const std::filesystem::path& file);

/// The part of a .vox file whose structure has been read, with codes as colours.
VoxelModel read_vox_model(const VoxFile& vox, Surface surface, int part);

/// The surface that a .vxm says it has; none for other files. Throws Error::input for a missing or
/// damaged one.
std::optional<Surface> surface_of_voxel_model(const std::filesystem::path& file);

}  // namespace voxelume
