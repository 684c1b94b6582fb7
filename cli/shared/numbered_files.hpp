// SPDX-License-Identifier: Apache-2.0
// Files with a number in place of the #### of a pattern.
#pragma once

#include <set>
#include <string>

namespace voxelume::cli {

/// True if a name has a slot for a number, such as ####.
bool is_numbered(const std::string& name);

/// The numbers of the existing files that match a name such as frame.####.png.
std::set<int> numbers_of_files(const std::string& pattern);

}  // namespace voxelume::cli
