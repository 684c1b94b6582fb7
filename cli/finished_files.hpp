// SPDX-License-Identifier: Apache-2.0
// `--overwrite` and `--resume`: which files of frames need no rendering.
#pragma once

#include <vector>

#include "cli/frame_files.hpp"

namespace voxelume::cli {

/// Which of the files that are there already are rendered.
enum class Overwrite { always, never, changed };

/// What the options ask for. Throws Error::usage for a word that is none, or both options at odds.
Overwrite overwrite_of(const RenderCommand& command);

/// Takes the files that need no rendering off the list, and frames that have none left. Returns how
/// many frames that are.
size_t skip_finished(const Scene& scene, const ImageFileOptions& options, Overwrite overwrite,
                     std::vector<FrameFiles>& frames);

}  // namespace voxelume::cli
