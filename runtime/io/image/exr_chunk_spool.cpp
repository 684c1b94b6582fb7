// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/exr_chunk_spool.hpp"

#include <algorithm>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

void ExrChunkSpool::put(size_t part, int row, const std::string& bytes) {
    chunks_.push_back({part, row, file_.position(), bytes.size()});
    file_.write(bytes.data(), bytes.size());
}

void ExrChunkSpool::take_out(
    const std::function<void(size_t part, int row, const std::string& bytes)>& write) {
    std::ranges::stable_sort(chunks_, {}, &Chunk::part);
    const InputFile written(file_.temporary());
    std::string bytes;
    for (const Chunk& chunk : chunks_) {
        bytes.resize(chunk.size);
        written.read(chunk.position, bytes.data(), chunk.size);
        write(chunk.part, chunk.row, bytes);
    }
}

}  // namespace voxelume
