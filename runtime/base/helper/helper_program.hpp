// SPDX-License-Identifier: Apache-2.0
// Where a helper program of ours is installed.
#pragma once

#include <filesystem>

namespace voxelume {

/// The helper program of that name: the first file that may be run in the folders where the system
/// looks for modules of the program or library that this code is part of. Where there is none, a
/// path that doesn't exist, so that nothing is started from the current folder.
std::filesystem::path helper_program(const char* name);

}  // namespace voxelume
