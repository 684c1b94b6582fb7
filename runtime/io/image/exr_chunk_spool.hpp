// SPDX-License-Identifier: Apache-2.0
// Where compressed chunks wait until it is their turn in a file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "runtime/base/files/atomic_file.hpp"

namespace voxelume {

/// A hidden file, beside the one that chunks are for. It never gets a name, and is gone with the
/// spool.
class ExrChunkSpool {
  public:
    explicit ExrChunkSpool(const std::filesystem::path& beside) : file_(beside) {}

    /// Keeps a chunk, whose first row is `row`. Those of one part come from the top down.
    void put(size_t part, int row, const std::string& bytes);

    /// Calls `write` with all chunks, part after part.
    void take_out(const std::function<void(size_t part, int row, const std::string& bytes)>& write);

  private:
    struct Chunk {
        size_t part = 0;
        int row = 0;
        uint64_t position = 0;
        size_t size = 0;
    };

    AtomicFile file_;
    std::vector<Chunk> chunks_;
};

}  // namespace voxelume
