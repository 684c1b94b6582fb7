// SPDX-License-Identifier: Apache-2.0
// PNG and JPEG -> pixels or numbers, by libspng and libjpeg-turbo in this process.
//
// All functions throw Error::input, which begins with `name`, for bytes that are damaged or cut
// off.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace voxelume {

/// The pixels of a picture: red, green, blue and alpha, row 0 at the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::array<uint8_t, 4>> pixels;
};

/// The format of a PNG: grey, or colours with or without opacity.
struct PngShape {
    int width = 0, height = 0;
    int bits = 8;      ///< bits of a number, 8 or 16; fewer bits are spread over 0..255
    int channels = 1;  ///< 3 for colours, 4 with an opacity, both of 8 bits

    size_t bytes() const { return size_t(width) * size_t(height) * size_t(channels * bits / 8); }
    friend bool operator==(const PngShape&, const PngShape&) = default;
};

/// The maximum numbers of pixels: of a texture's picture, 8192 x 8192, and of a slice of a scan.
inline constexpr uint64_t kMaxTexturePixels = uint64_t{1} << 26;
inline constexpr uint64_t kMaxSlicePixels = uint64_t{1} << 26;

/// Is told a picture's size before memory is taken for it; it may throw.
using PictureRoom = std::function<void(int width, int height)>;

/// Decodes any PNG of at most `max_pixels` as 8-bit RGBA.
Picture decode_png(std::span<const uint8_t> bytes, const std::filesystem::path& name,
                   uint64_t max_pixels, const PictureRoom& room);

/// Decodes a JPEG of at most kMaxTexturePixels, see parse_jpeg.
Picture decode_jpeg(std::span<const uint8_t> bytes, const std::filesystem::path& name);

/// The format of a PNG of at most kMaxSlicePixels, and the numbers of one of that format, see
/// read_png_values.
PngShape decode_png_shape(std::span<const uint8_t> bytes, const std::filesystem::path& name);
std::vector<std::byte> decode_png_values(std::span<const uint8_t> bytes,
                                         const std::filesystem::path& name, const PngShape& shape);

}  // namespace voxelume
