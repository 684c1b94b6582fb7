// SPDX-License-Identifier: Apache-2.0
// Hashes of files' bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

/// The 128-bit hash (XXH3) of a file's bytes, as 32 hexadecimal digits; empty for a file that can't
/// be read.
std::string hash_of_file(const std::filesystem::path& file);

/// The 64-bit hash (XXH3) of `count` bytes from `first` on. Throws Error::input if the file ends
/// before them.
uint64_t hash_of_bytes(const InputFile& file, uint64_t first, uint64_t count);

}  // namespace voxelume
