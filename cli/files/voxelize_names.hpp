// SPDX-License-Identifier: Apache-2.0
// The files that `voxelize` reads and writes: one, or one for each frame.
#pragma once

#include <string>
#include <vector>

namespace voxelume::cli {

/// The names of a command line, or those of one frame.
struct VoxelizeNames {
    std::string file;
    std::vector<std::string> outputs;
    int frame = 0;  ///< 0: not one of several
};

/// True if a file to be read is a sequence such as walk.####.obj. Stacks of slices are one array.
bool is_file_sequence(const std::string& file);

/// The names of input and outputs for each frame of a sequence of files: the frames of `list`, or
/// all that are found. `gaps` gets the names of numbers that are missing between them.
///
/// Throws Error::usage for outputs that don't go together, Error::input when files are missing,
/// some of them named in one sentence.
std::vector<VoxelizeNames> names_of_files(const VoxelizeNames& names, const std::string& list,
                                          std::vector<std::string>& gaps);

/// Each frame's names for the frames of `list`, or the first `count`, of one moving file. Throws
/// Error::usage for outputs that don't go together, and for a frame that the file doesn't have.
std::vector<VoxelizeNames> names_of_frames(const VoxelizeNames& names, const std::string& list,
                                           int count);

}  // namespace voxelume::cli
