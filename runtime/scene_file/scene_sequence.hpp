// Numbered files of a scene: which of them a frame shows.
#pragma once

#include <filesystem>

#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {

/// The file that `key` names at a frame. With a `sequence` beside it the name is a pattern such as
/// "smoke.####.vdb", as outputs have it; without one it is the file.
///
/// Throws Error::scene for a name without a place for the number, Error::input when files are
/// missing, all of them named in one sentence when `search.all_files`.
std::filesystem::path file_at(const SceneFields& fields, std::string_view key,
                              const AssetSearch& search);

}  // namespace voxelume
