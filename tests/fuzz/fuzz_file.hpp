// SPDX-License-Identifier: Apache-2.0
// The file in memory that each input of a fuzz target replaces.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "tests/fuzz/fuzz_name.hpp"

namespace voxelume {

/// The file for the target, in a folder that no other process uses.
inline std::filesystem::path fuzz_file() {
    const std::filesystem::path shared = "/dev/shm";
    const std::filesystem::path folder =
        (std::filesystem::is_directory(shared) ? shared : std::filesystem::temp_directory_path()) /
        ("voxelume_fuzz." + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    return folder / fuzz_name();
}

/// Replaces the bytes of a file that nothing else writes. It stays open, since opening a file takes
/// as long as reading a small one.
inline void write_bytes(const std::filesystem::path& file, std::span<const uint8_t> bytes) {
    static std::map<std::filesystem::path, int> open_files;
    const auto [known, is_new] = open_files.try_emplace(file);
    int& descriptor = known->second;
    if (is_new) descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    if (pwrite(descriptor, bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()) ||
        ftruncate(descriptor, off_t(bytes.size())) != 0)
        std::abort();
}

/// Writes an input into two files. Its first two bytes are the number of the following bytes that
/// go into the first file.
inline void write_pair(const std::filesystem::path& first, const std::filesystem::path& second,
                       std::span<const uint8_t> bytes) {
    const size_t wanted = bytes.size() < 2 ? 0 : bytes[0] + 256u * bytes[1];
    const auto parts = bytes.subspan(std::min<size_t>(2, bytes.size()));
    const size_t length = std::min(wanted, parts.size());
    write_bytes(first, parts.first(length));
    write_bytes(second, parts.subspan(length));
}

}  // namespace voxelume
