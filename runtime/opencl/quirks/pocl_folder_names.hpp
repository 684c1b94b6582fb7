// SPDX-License-Identifier: Apache-2.0
// The folders that processes make for PoCL's files: how they are named, made and cleared away.
#pragma once

#include <filesystem>

namespace voxelume {

/// The file in such a folder that its process holds locked.
inline constexpr const char* kPoclFolderLock = "lock";

/// Removes the folders that killed processes left: those whose lock nobody holds. A folder less
/// than a minute old of a process that may live is left, since it may not have locked it yet; so
/// are other users'.
void remove_stale_pocl_folders(const std::filesystem::path& parent);

/// A new folder in `parent` that only this user can read. Empty if that fails, if others could put
/// another in its place, or if the disk is so full that PoCL might end the program.
std::filesystem::path make_pocl_folder(const std::filesystem::path& parent);

}  // namespace voxelume
