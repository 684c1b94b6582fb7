// SPDX-License-Identifier: Apache-2.0
// Two image files -> how far they are apart, and pictures of it.
#pragma once

#include "cli/files/diff_files.hpp"
#include "cli/files/diff_limits.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// Throws Error::usage where FLIP is wanted of channels that don't have the colours.
void check_colors(const DiffLimits& limits, const std::vector<std::string>& channels);

/// Compares files, writes the pictures of it, and names the files in messages. Throws Error::usage
/// for images of two kinds, Error::render for those that can't be compared, and Error as reading
/// and writing do.
ImageDifference compare_files(const DiffFiles& files, const CompareOptions& options,
                              const DiffLimits& limits);

}  // namespace voxelume::cli
