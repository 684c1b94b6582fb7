// SPDX-License-Identifier: Apache-2.0
// What the bytes of a file that is being written should be, without keeping them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/base/files/byte_sink.hpp"

namespace voxelume {

/// The hashes of a file's blocks, and the bytes of its last block if that isn't full: 8 bytes for
/// each 64 KiB, and 64 KiB.
class WrittenBlocks {
  public:
    static constexpr size_t kBlock = size_t{1} << 16;

    /// The file's size in bytes.
    uint64_t size() const { return uint64_t(hashes_.size()) * kBlock + last_.size(); }

    /// Takes bytes before they are written at `position`. Bytes between the file's end and
    /// `position` are zeros. A full block that is changed in part is read for its other bytes:
    /// returns false if that block isn't as it was written.
    [[nodiscard]] bool put(uint64_t position, const char* data, size_t size, const ReadBytes& read);

    /// True if bytes that were read at `position` are those that were written. `position` is a
    /// multiple of kBlock, and the bytes end with a block or with the file.
    bool match(uint64_t position, const char* data, size_t size) const;

  private:
    bool patch(uint64_t block, size_t offset, const char* data, size_t size, const ReadBytes& read);
    void append(const char* data, size_t size);

    std::vector<uint64_t> hashes_;
    std::vector<char> last_;
};

}  // namespace voxelume
