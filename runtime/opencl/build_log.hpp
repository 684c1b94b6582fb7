// SPDX-License-Identifier: Apache-2.0
// A compiler's log -> the lines that a message quotes.
#pragma once

#include <string>
#include <string_view>

namespace voxelume {

/// The first lines of a log that name errors, or of all its lines if none does, and the number of
/// further such lines. The first line comes without a line break, as lists of devices have one line
/// for each device. Empty for a log without lines.
std::string first_errors(std::string_view log);

}  // namespace voxelume
