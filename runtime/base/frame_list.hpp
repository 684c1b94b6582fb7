// SPDX-License-Identifier: Apache-2.0
// The frames that `--frames` names.
#pragma once

#include <string>
#include <vector>

namespace voxelume {

/// Reads a list such as `1-10,20,30-60x5`: numbers and ranges with both ends and, after `x`, a
/// step. `..` means the same as `-`.
///
/// Frames keep their order, a frame that is named twice stands where it is named first, and
/// negative numbers work (`-5..-1`). Throws Error::usage that quotes the part it can't read. A list
/// holds at most a million frames.
std::vector<int> parse_frame_list(const std::string& text);

}  // namespace voxelume
