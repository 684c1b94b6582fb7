// SPDX-License-Identifier: Apache-2.0
// A compiler's log -> what a message says of it.
#pragma once

#include <string>
#include <string_view>

namespace voxelume {

/// The first few lines of a log that name errors, or of all its lines if none does, and how many
/// more of these there are. The first comes without a line break, as lists of devices have one line
/// for each. Empty for a log without lines.
std::string first_errors(std::string_view log);

}  // namespace voxelume
