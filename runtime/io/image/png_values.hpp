// SPDX-License-Identifier: Apache-2.0
// PNG file -> the stored numbers: slices of scans hold values, not light.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace voxelume {

/// The format of a PNG: grey, or colours with or without opacity.
struct PngShape {
    int width = 0, height = 0;
    int bits = 8;      ///< bits of a number, 8 or 16; fewer bits are spread over 0..255
    int channels = 1;  ///< 3 for colours, 4 with an opacity, both of 8 bits

    size_t bytes() const { return size_t(width) * size_t(height) * size_t(channels * bits / 8); }
    friend bool operator==(const PngShape&, const PngShape&) = default;
};

/// Throws Error::input for a file that is missing, damaged or above 2^26 pixels.
PngShape read_png_shape(const std::filesystem::path& path);

/// The numbers of a PNG of that shape, row 0 at the top, in the order of bytes of this machine.
/// Throws as read_png_shape does, and Error::input for another shape.
std::vector<std::byte> read_png_values(const std::filesystem::path& path, const PngShape& shape);

}  // namespace voxelume
