// SPDX-License-Identifier: Apache-2.0
// The names of stacks of slices on the command line.
#pragma once

#include <string>

namespace voxelume::cli {

/// The first slice of the stack that a name such as slice####.png stands for: the file with the
/// lowest number in place of the last run of #, with at least as many digits. Other names, and
/// names of existing files, stay as they are. Throws Error::input if there is no such file.
std::string first_slice(const std::string& name);

}  // namespace voxelume::cli
