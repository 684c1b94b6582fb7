// SPDX-License-Identifier: Apache-2.0
// The files to which a mesh's file refers: material libraries, textures, buffers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace voxelume {

/// The canonical path of a regular file that the file `of` names, in its folder or below it.
///
/// Backslashes count as slashes. If a name leads elsewhere, as names of the computer that wrote the
/// file do, only its last part counts. Empty where there is no such file, and for links that lead
/// out of the folder.
std::optional<std::filesystem::path> companion_file(const std::filesystem::path& of,
                                                    std::string name);

}  // namespace voxelume
