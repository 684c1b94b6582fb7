// SPDX-License-Identifier: Apache-2.0
// The path of the file of one frame of an animation.
#pragma once

#include <string>

namespace voxelume {

/// Returns `pattern` with the frame's number in it. In an `animation` two frames never share a
/// file.
///
/// The number replaces the last run of `#` in the file's name, with leading zeros up to the run's
/// length (`frame.####.exr` -> `frame.0012.exr`), or a `%d`, `%4d` or `%04d` there. Without either,
/// a single frame's pattern is the path itself, and an animation's gets four digits in front of its
/// extension, as in Blender (`out.exr` -> `out0012.exr`), behind a dot where the name ends in a
/// digit (`out2.exr` -> `out2.0012.exr`). Folders are left as they are.
std::string frame_path(const std::string& pattern, int frame, bool animation);

}  // namespace voxelume
