// SPDX-License-Identifier: Apache-2.0
// A hash of a file's bytes.
#pragma once

#include <filesystem>
#include <string>

namespace voxelume {

/// The 128-bit hash (XXH3) of a file's bytes, as 32 hexadecimal digits; empty for a file that can't
/// be read.
std::string hash_of_file(const std::filesystem::path& file);

}  // namespace voxelume
