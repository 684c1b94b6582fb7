// The name that a mistyped one was probably meant to be.
#pragma once

#include <string>
#include <vector>

namespace voxelume::cli {

/// The entry of `names` with the fewest insertions, deletions, replacements and swaps of neighbours
/// from `typed`, the first one on ties; empty when none is nearer than half of the letters, two at
/// least.
std::string nearest_name(const std::string& typed, const std::vector<std::string>& names);

}  // namespace voxelume::cli
