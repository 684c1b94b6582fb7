// SPDX-License-Identifier: Apache-2.0
// The parts that `merge` puts together: whether they are those of one run, and whole.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cli/output/shard_manifest.hpp"

namespace voxelume::cli {

/// A part, and the file that tells of it.
struct MergePart {
    std::filesystem::path file;
    ShardManifest manifest;
};

/// Throws Error::input.
template <class... Args>
[[noreturn]] void refuse_merge(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(ErrorKind::input, "merge: " + fmt::format(format, std::forward<Args>(args)...));
}

/// Throws Error::input where parts belong to different runs.
void check_same_run(const std::vector<MergePart>& parts);

/// Throws Error::input where a part isn't there, or there twice.
void check_numbers(const std::vector<MergePart>& parts);

/// Returns the path of a part's file. Throws Error::input unless it has the bytes that it was told
/// of with.
std::filesystem::path checked_file(const MergePart& part, const ShardFile& file);

/// Throws Error::input unless every frame of the run is one part's, and its files as they were
/// written.
void check_frames(const std::vector<MergePart>& parts);

/// The files of the image that a part is of. A part may be someone else's, so what it names lies in
/// its folder, links followed, unless files may lie `outside`. Throws Error::input.
std::vector<std::filesystem::path> checked_outputs(const MergePart& part, bool outside);

}  // namespace voxelume::cli
