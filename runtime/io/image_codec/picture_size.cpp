// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image_codec/picture_size.hpp"

namespace voxelume {
namespace {

/// A number of `count` bytes, the highest first.
uint64_t number_at(std::span<const uint8_t> bytes, size_t first, size_t count) {
    uint64_t number = 0;
    for (size_t i = 0; i < count; ++i) number = number << 8 | bytes[first + i];
    return number;
}

}  // namespace

uint64_t declared_pixels(std::span<const uint8_t> bytes) {
    constexpr size_t kWidth = 16, kHeight = 20, kEnd = 24;  // in a PNG
    if (bytes.size() >= kEnd && bytes[0] == 0x89)
        return number_at(bytes, kWidth, 4) * number_at(bytes, kHeight, 4);
    uint64_t pixels = 0;
    any_jpeg_segment(bytes, [&](uint8_t kind, std::span<const uint8_t> content) {
        // The kinds C0 to CF begin frames, but tables are among them: C4, C8 and CC.
        if ((kind & 0xF0) != 0xC0 || kind == 0xC4 || kind == 0xC8 || kind == 0xCC) return false;
        if (content.size() >= 5) pixels = number_at(content, 1, 2) * number_at(content, 3, 2);
        return pixels > 0;
    });
    return pixels;
}

}  // namespace voxelume
