// SPDX-License-Identifier: Apache-2.0
// Temporary storage of compressed chunks until it is their turn in a file.
#pragma once

#include <xxhash.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/files/input_file.hpp"

namespace voxelume {

/// A hidden file in the folder of the file that the chunks are for. It never gets a name, and is
/// deleted with the spool.
class ExrChunkSpool {
  public:
    explicit ExrChunkSpool(const std::filesystem::path& target) : file_(target) {}

    /// Keeps a chunk, whose first row is `row`. Those of one part come from the top down.
    void put(size_t part, int row, const std::string& bytes) {
        chunks_.push_back(
            {part, row, file_.position(), bytes.size(), XXH3_64bits(bytes.data(), bytes.size())});
        file_.write(bytes.data(), bytes.size());
    }

    /// Calls `write` with the part, the row and the bytes of all chunks, part after part.
    template <class Write>
    void take_out(const Write& write) {
        std::ranges::stable_sort(chunks_, {}, &Chunk::part);
        const InputFile written(file_.temporary());
        std::string bytes;
        for (const Chunk& chunk : chunks_) {
            bytes.resize(chunk.size);
            written.read(chunk.position, bytes.data(), chunk.size);
            if (XXH3_64bits(bytes.data(), bytes.size()) != chunk.hash)
                file_.fail(
                    "rows that waited in a temporary file have changed; the disk or the "
                    "memory is faulty: write to another disk");
            write(chunk.part, chunk.row, bytes);
        }
    }

  private:
    struct Chunk {
        size_t part = 0;
        int row = 0;
        uint64_t position = 0;
        size_t size = 0;
        uint64_t hash = 0;
    };

    AtomicFile file_;
    std::vector<Chunk> chunks_;
};

}  // namespace voxelume
