// SPDX-License-Identifier: Apache-2.0
// `--overwrite` and `--resume`: which files of frames need no rendering.
#pragma once

#include <vector>

#include "cli/render/frame_files.hpp"

namespace voxelume::cli {

/// Decides which existing files are rendered again.
enum class Overwrite { always, never, changed };

/// What the options ask for. Throws Error::usage for an unknown word, and where the two options
/// conflict.
Overwrite overwrite_of(const RenderCommand& command);

/// What already exists of a run.
struct Finished {
    size_t frames = 0;   ///< need no rendering
    size_t damaged = 0;  ///< files, those without a hash with them
    size_t changed = 0;  ///< files that were made from something else
};

/// Takes the files that need no rendering off the list, and frames that have none left.
Finished skip_finished(const Scene& scene, const ImageFileOptions& options, Overwrite overwrite,
                       std::vector<FrameFiles>& frames);

}  // namespace voxelume::cli
