// SPDX-License-Identifier: Apache-2.0
// The files that `diff` compares: two images, or the frames of two animations.
#pragma once

#include <string>
#include <vector>

namespace voxelume::cli {

/// What is compared with what, and where pictures of it go.
struct DiffFiles {
    int frame = 0;             ///< of an animation
    std::string a, b;          ///< image and reference
    std::string output, flip;  ///< pictures; empty for none
};

/// What the command line names: patterns of frames, or files.
struct DiffNames {
    std::string a, b, output, flip;
    std::string frames;  ///< a list like 1-10; empty: all that are there

    /// True if they are names of an animation's frames.
    bool is_animation() const;
};

/// Throws Error::usage where an output is one of the images, or two outputs are one file, however
/// they are spelled and whatever links lead to them.
void check_outputs(const std::vector<DiffFiles>& list);

/// Throws Error::input where an image isn't there.
void check_inputs(const DiffFiles& files);

/// The pairs of files, in the order of the frames. Without a list these are the frames of which
/// there is a file of A or of B. Throws Error::usage for patterns that don't go together.
std::vector<DiffFiles> diff_files(const DiffNames& names);

}  // namespace voxelume::cli
