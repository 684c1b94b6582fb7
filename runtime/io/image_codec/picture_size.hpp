// SPDX-License-Identifier: Apache-2.0
// The size that a picture declares, read without a library.
#pragma once

#include <cstdint>
#include <span>

namespace voxelume {

/// The pixels that the header of a PNG or JPEG declares; 0 where none is found. It is for limits:
/// decoders look for themselves.
uint64_t declared_pixels(std::span<const uint8_t> bytes);

/// Calls `take` for each segment of a JPEG before its scans, with its kind and what follows its
/// length, until that returns true. Returns whether it did.
template <class Take>
bool any_jpeg_segment(std::span<const uint8_t> bytes, const Take& take) {
    constexpr uint8_t kStartOfScan = 0xDA;
    // Segments are FF, a kind, and their length with its own two bytes.
    for (size_t at = 2; at + 4 <= bytes.size() && bytes[at] == 0xFF;) {
        const uint8_t kind = bytes[at + 1];
        if (kind == 0xFF) {  // a fill byte
            ++at;
            continue;
        }
        const size_t length = size_t(bytes[at + 2]) << 8 | bytes[at + 3];
        if (kind == kStartOfScan) return false;
        if (length >= 2 && at + 2 + length <= bytes.size() &&
            take(kind, bytes.subspan(at + 4, length - 2)))
            return true;
        at += 2 + length;
    }
    return false;
}

}  // namespace voxelume
