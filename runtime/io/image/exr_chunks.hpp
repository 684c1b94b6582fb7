// Planes of pixels -> the compressed chunks of 16 rows that a scanline OpenEXR file holds.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

/// Rows in a chunk of ZIP compression.
inline constexpr int kExrChunkRows = 16;

/// One channel of an image, 32 bits a value.
struct ExrPlane {
    std::string name;
    const void* values = nullptr;  ///< floats, or unsigned integers; not owned
    bool is_id = false;
    bool is_half = false;   ///< floats that the file has as halves
    bool is_color = false;  ///< what isn't finite becomes 0, what doesn't fit is clamped
};

/// What is handed on of a chunk: its first row, its bytes, and how many values became 0.
struct ExrChunk {
    int row = 0;
    std::string bytes;
    size_t replaced = 0;
};

/// Calls `write` with all chunks of the image from the top, compressed by so many threads.
///
/// `planes` are those of the file, in the order of their names; rows have `width` values each.
/// Halves are rounded to nearest. The bytes don't depend on the threads.
void compress_chunks(const std::vector<ExrPlane>& planes, int width, int height, int threads,
                     const std::function<void(const ExrChunk&)>& write);

}  // namespace voxelume
