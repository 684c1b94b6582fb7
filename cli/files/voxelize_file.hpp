// SPDX-License-Identifier: Apache-2.0
// The voxels of one file, or of one frame of it.
#pragma once

#include <string>
#include <vector>

#include "cli/files/voxelize_options.hpp"

namespace voxelume::cli {

/// True if `file`, or its frames if `is_frame`, is a mesh: neither a scene nor a file of voxels. A
/// frame of a glTF file is one of the scene that shows it.
bool is_mesh_input(const std::string& file, bool is_frame);

/// The scene that the command's file is, or that shows what moves in it.
Scene scene_in(const VoxelizeCommand& command);

/// Prints notes, unless --quiet was given.
void tell_notes(const VoxelizeCommand& command, const std::vector<std::string>& notes);

/// Makes the voxels of one file or frame, and tells what it made. Returns their edge in metres;
/// 0: as in the file. Throws Error::usage for options that don't go with the file, and Error as
/// reading and writing do.
double voxelize_file(const VoxelizeCommand& command);

}  // namespace voxelume::cli
