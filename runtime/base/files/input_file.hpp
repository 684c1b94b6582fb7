// SPDX-License-Identifier: Apache-2.0
// A file open for reading. Its size is known before memory is allocated for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/base/error.hpp"

namespace voxelume {

/// A file to read. Every failure is an Error::input that names the file.
class InputFile {
  public:
    /// Opens the file. Throws if it is missing, may not be read or isn't a plain file;
    /// files of /proc and /sys aren't.
    explicit InputFile(const std::filesystem::path& path);
    /// Takes a descriptor that is open already, as a helper program does; `path` is for messages.
    InputFile(const std::filesystem::path& path, int descriptor);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    uint64_t size() const { return size_; }
    const std::filesystem::path& path() const { return path_; }
    int descriptor() const { return descriptor_; }

    /// Fills `data` from `position`. Throws if the file ends before `size` bytes are read.
    void read(uint64_t position, void* data, size_t size) const;

    /// Returns all bytes. Throws Error::limit if the file has more than `max_bytes`.
    std::string read_all(uint64_t max_bytes) const;
    /// The whole file.
    std::vector<uint8_t> bytes() const;

    /// Throws Error::input "PATH: REASON".
    [[noreturn]] void refuse(const std::string& reason) const;

  private:
    void take_size();

    std::filesystem::path path_;
    int descriptor_ = -1;
    uint64_t size_ = 0;
};

}  // namespace voxelume
