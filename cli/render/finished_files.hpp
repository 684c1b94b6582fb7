// SPDX-License-Identifier: Apache-2.0
// `--overwrite` and `--resume`: finds the files of frames that need no rendering.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/render/frame_files.hpp"

namespace voxelume::cli {

/// Decides which existing files are rendered again.
enum class Overwrite { always, never, changed };

/// The policy that the options ask for. Throws Error::usage for an unknown word, and if the two
/// options conflict.
Overwrite overwrite_of(const RenderCommand& command);

/// What already exists of a run.
struct Finished {
    size_t frames = 0;   ///< frames that need no rendering
    size_t damaged = 0;  ///< damaged files, including those without a hash
    size_t changed = 0;  ///< files that were made from something else
};

/// True if an image's file needs no rendering: by its hash or, where no file is replaced, since it
/// exists. Files that are rendered again are counted.
bool is_finished(const std::filesystem::path& image, const std::string& hash,
                 const ImageFileOptions& options, Overwrite overwrite, Finished& finished);

/// Says how many of `count` frames are there, and why others are rendered again.
void tell_of(const Finished& finished, size_t count);

/// Removes files that need no rendering from the list, and frames without remaining files.
Finished skip_finished(const Scene& scene, const ImageFileOptions& options, Overwrite overwrite,
                       std::vector<FrameFiles>& frames);

}  // namespace voxelume::cli
