// SPDX-License-Identifier: Apache-2.0
// Planes of pixels -> the compressed chunks of 16 rows that a scanline OpenEXR file holds.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/io/image/image_rows.hpp"

namespace voxelume {

/// The number of rows in a chunk of ZIP compression.
inline constexpr int kExrChunkRows = kBandRows;

/// One channel of an image, with 32 bits a value.
struct ExrPlane {
    std::string name;
    const void* values = nullptr;  ///< floats, or unsigned integers; not owned
    bool is_id = false;
    bool is_half = false;   ///< true for floats that the file stores as halves
    bool is_color = false;  ///< if true, values that aren't finite become 0, and others are clamped
};

/// A compressed chunk: its first row, its bytes, and the number of values that became 0.
struct ExrChunk {
    int row = 0;
    std::string bytes;
    size_t replaced = 0;
};

/// The number of copies of a chunk's bytes in memory while it is compressed.
inline constexpr int kChunkCopies = 4;

/// The number of threads, at most `threads`, that can compress chunks of `chunk_bytes` with little
/// memory in addition to a band of an image: 64 MiB, or what one thread takes.
int threads_for_band(size_t chunk_bytes, int threads);

/// Calls `write` with every chunk of the image, from the top down. `threads` threads compress them.
///
/// `planes` are the file's channels, in the order of their names; each row has `width` values.
/// Halves are rounded to nearest. The bytes don't depend on the number of threads.
void compress_chunks(const std::vector<ExrPlane>& planes, int width, int height, int threads,
                     const std::function<void(const ExrChunk&)>& write);

}  // namespace voxelume
