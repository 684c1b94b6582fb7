// SPDX-License-Identifier: Apache-2.0
// Files whose names have a number in place of ####.
#pragma once

#include <set>
#include <string>

namespace voxelume::cli {

/// True if a name has a place for a number.
bool is_numbered(const std::string& name);

/// The numbers of the files that there are of a name such as frame.####.png.
std::set<int> numbers_of_files(const std::string& pattern);

}  // namespace voxelume::cli
