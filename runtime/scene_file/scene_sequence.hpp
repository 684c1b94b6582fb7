// SPDX-License-Identifier: Apache-2.0
// Numbered files of a scene.
#pragma once

#include <filesystem>

#include "runtime/scene/scene_motion.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {

/// The file that `key` names. If there is a `sequence`, too, the name is a pattern such as
/// "smoke.####.vdb", as for outputs, and the file is the first one.
///
/// Throws Error::scene for a name without a place for the number, Error::input when files are
/// missing, all of them named in one sentence.
std::filesystem::path first_file(const SceneFields& fields, std::string_view key,
                                 const AssetSearch& search);

/// All files of a `sequence`, for a value that `first_file` has checked.
FileSequence read_files(const SceneFields& fields, std::string_view key,
                        const ValueReference& value, const AssetSearch& search);

}  // namespace voxelume
