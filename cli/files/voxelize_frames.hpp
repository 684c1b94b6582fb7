// SPDX-License-Identifier: Apache-2.0
// Voxels of several files, or of the frames of one that moves: all of one size.
#pragma once

#include "cli/files/voxelize_options.hpp"

namespace voxelume::cli {

/// True if the names of a command line stand for several files or frames.
bool has_frames(const VoxelizeCommand& command);

/// Makes the voxels of each frame. All frames have voxels of one size. Throws as voxelize_file
/// does, and Error::usage for options and names that don't go with frames.
void voxelize_frames(VoxelizeCommand command);

}  // namespace voxelume::cli
