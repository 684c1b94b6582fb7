// SPDX-License-Identifier: Apache-2.0
// The folders that processes make for PoCL's files: naming, making and removing them.
#pragma once

#include <filesystem>

namespace voxelume {

/// The file in such a folder that its process holds locked.
inline constexpr const char* kPoclFolderLock = "lock";

/// Removes the folders that killed processes left: those whose lock nobody holds. A folder less
/// than a minute old is left if its process may live, since it may not be locked yet. Other users'
/// folders are left, too.
void remove_stale_pocl_folders(const std::filesystem::path& parent);

/// Makes a folder in `parent` that only this user can read. Empty if that fails, if others could
/// replace it, or if the disk is so full that PoCL might end the program.
std::filesystem::path make_pocl_folder(const std::filesystem::path& parent);

}  // namespace voxelume
