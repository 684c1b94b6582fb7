// SPDX-License-Identifier: Apache-2.0
// The files that `voxelize` reads and writes: one input, or one for each frame.
#pragma once

#include <string>
#include <vector>

namespace voxelume::cli {

/// The names on a command line, or those of one frame.
struct VoxelizeNames {
    std::string file;
    std::vector<std::string> outputs;
    int frame = 0;  ///< 0: not one of several frames
};

/// True if an input file is a sequence such as walk.####.obj. A stack of slices is one array
/// instead.
bool is_file_sequence(const std::string& file);

/// The names of input and outputs for each frame of a sequence of files: the frames of `list`, or
/// all that exist. `gaps` gets the names of missing files between them.
///
/// Throws Error::usage for outputs that conflict, and Error::input if files are missing; the
/// message names some of them.
std::vector<VoxelizeNames> names_of_files(const VoxelizeNames& names, const std::string& list,
                                          std::vector<std::string>& gaps);

/// The names for the frames of `list`, or for the first `count` frames, of one moving file. Throws
/// Error::usage for outputs that conflict, and for a frame that the file doesn't have.
std::vector<VoxelizeNames> names_of_frames(const VoxelizeNames& names, const std::string& list,
                                           int count);

}  // namespace voxelume::cli
