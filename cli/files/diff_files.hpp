// SPDX-License-Identifier: Apache-2.0
// The files that `diff` compares: two images, or the frames of two animations.
#pragma once

#include <string>
#include <vector>

namespace voxelume::cli {

/// Which files are compared, and where pictures of the comparison go.
struct DiffFiles {
    int frame = 0;             ///< number in an animation
    std::string a, b;          ///< image and reference
    std::string output, flip;  ///< pictures; empty for none
};

/// What the command line names: patterns of frames, or files.
struct DiffNames {
    std::string a, b, output, flip;
    std::string frames;  ///< a list like 1-10; empty: all that exist

    /// True if these are patterns for an animation's frames.
    bool is_animation() const;
};

/// Throws Error::usage if an output is one of the images, or if two outputs are the same file,
/// however they are spelled and whatever links lead to them.
void check_outputs(const std::vector<DiffFiles>& list);

/// Throws Error::input if an image doesn't exist.
void check_inputs(const DiffFiles& files);

/// The pairs of files, in the order of the frames. Without a list, these are the frames for which a
/// file of A or of B exists. Throws Error::usage for patterns that conflict.
std::vector<DiffFiles> diff_files(const DiffNames& names);

}  // namespace voxelume::cli
