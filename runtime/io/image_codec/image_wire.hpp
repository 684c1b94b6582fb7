// SPDX-License-Identifier: Apache-2.0
// What both ends know: image_codec.cpp, which asks, and image_decoder_main.cpp, which answers.
#pragma once

#include <algorithm>
#include <cstdint>

#include "runtime/base/helper/helper_limits.hpp"
#include "runtime/io/image_codec/exr_header_check.hpp"

namespace voxelume {

inline constexpr const char* kImageDecoderName = "voxelume-image-decoder";

enum class ImageAnswer : uint32_t {
    refusal = 0x494D4701,  ///< the kind of the error, and its sentence
    begin = 0x494D4702,    ///< a header or a size
    rows = 0x494D4703,     ///< some rows of a channel, or a row of samples
    end = 0x494D4704       ///< what is left, by the question
};

/// The limits of a helper that decodes a file of `file_bytes` to `decoded_bytes`. The libraries
/// take a multiple of what they decode in one piece, which may be all of it.
inline HelperLimits image_limits(uint64_t file_bytes, uint64_t decoded_bytes, uint64_t threads) {
    constexpr uint64_t kPrograms = 1 << 29, kThread = 1 << 24;
    const uint64_t memory = kPrograms + threads * kThread + 2 * file_bytes + 6 * decoded_bytes;
    return {memory, memory, 20 + (file_bytes + decoded_bytes) / 4'000'000};
}

/// The maximum of numbers' bytes for a byte of a file. No compression of OpenEXR reaches it, so a
/// header beyond it is false.
inline constexpr uint64_t kMaxExrRatio = 4 * 4096;

/// The bytes of a block that is decoded at once. It may be larger than the image: a tile is.
inline uint64_t exr_block_bytes(uint64_t file_bytes, const ExrExtent& extent) {
    constexpr uint64_t kSmall = 1 << 26, kLarge = 1 << 30;
    return std::min({extent.block_bytes, std::max(kMaxExrRatio * file_bytes, kSmall), kLarge});
}

/// OpenEXR makes two blocks for each thread, and one without any. Their compressors make up to
/// three copies of each.
inline uint64_t exr_blocks_bytes(uint64_t file_bytes, const ExrExtent& extent, uint64_t threads) {
    return (2 * threads + 1) * 4 * exr_block_bytes(file_bytes, extent);
}

/// The number of threads, of those that are `wanted`, whose blocks take less than a gigabyte.
inline uint64_t exr_threads(uint64_t file_bytes, const ExrExtent& extent, uint64_t wanted) {
    constexpr uint64_t kBlocks = 1 << 30;
    uint64_t threads = wanted;
    while (threads > 0 && exr_blocks_bytes(file_bytes, extent, threads) > kBlocks) --threads;
    return threads;
}

inline HelperLimits exr_limits(uint64_t file_bytes, const ExrExtent& extent, uint64_t threads) {
    HelperLimits limits =
        image_limits(file_bytes, std::min(extent.pixel_bytes, kMaxExrRatio * file_bytes), threads);
    const uint64_t blocks = exr_blocks_bytes(file_bytes, extent, threads);
    return {limits.memory_bytes + blocks, limits.max_memory_bytes + blocks, limits.seconds};
}

/// Deep files are decoded row by row, to any size; a sample takes four bytes in each channel.
inline HelperLimits deep_exr_limits(uint64_t file_bytes, const ExrExtent& extent,
                                    uint64_t max_samples, uint64_t threads) {
    const double row_bytes = double(extent.row_bytes) * double(max_samples);
    HelperLimits limits = image_limits(
        file_bytes, uint64_t(std::min(row_bytes, double(kMaxExrRatio * file_bytes))), threads);
    limits.seconds += 64 * file_bytes / 4'000'000;
    return limits;
}

/// Several pictures in one file, which are decoded one after another. The file has their number and
/// the number of bytes of each, by eight bytes, and the pictures.
inline HelperLimits pictures_limits(uint64_t file_bytes, uint64_t pictures, uint64_t max_pixels) {
    HelperLimits limits = image_limits(file_bytes, 4 * max_pixels, 0);
    limits.seconds += 4 * max_pixels * pictures / 4'000'000;
    return limits;
}

/// The seconds by the clock for a helper that computes so long at most: it waits for the disk, or
/// shares the machine.
inline double seconds_to_wait(const HelperLimits& limits) {
    return 40 + 3.0 * double(limits.seconds);
}

}  // namespace voxelume
