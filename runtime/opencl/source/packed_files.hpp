// SPDX-License-Identifier: Apache-2.0
// Files of compiled kernels <-> the bytes of one entry of the cache.
#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace voxelume {

/// An entry that wasn't made by `packed`.
class PackedFileError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Packs the files, named by their paths from `root`.
std::string packed(const std::filesystem::path& root, std::span<const std::filesystem::path> files);

/// The name and the content of each file of an entry, as views of its bytes.
///
/// All names are checked: they lead only to files below the intended folder, and are names of files
/// that are kept. Throws PackedFileError otherwise.
std::vector<std::pair<std::string, std::string_view>> packed_files(std::string_view bytes);

}  // namespace voxelume
