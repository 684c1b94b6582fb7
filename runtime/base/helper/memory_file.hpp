// SPDX-License-Identifier: Apache-2.0
// A file in memory, which a helper program is given.
#pragma once

#include <cstddef>
#include <string_view>

namespace voxelume {

/// Owns a file that has no name and that other programs can't open.
class MemoryFile {
  public:
    /// Makes an empty file. `what` is what it is for, in the message of Error::input that this and
    /// `append` throw where there is no memory: "compressed meshes".
    explicit MemoryFile(std::string_view what);
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    int descriptor() const { return descriptor_; }
    void append(const void* data, size_t size) const;

  private:
    [[noreturn]] void fail() const;

    std::string_view what_;
    int descriptor_;
};

}  // namespace voxelume
