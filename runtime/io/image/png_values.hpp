// SPDX-License-Identifier: Apache-2.0
// PNG file -> the stored numbers: slices of scans hold values, not light.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "runtime/io/image_codec/picture_decoder.hpp"

namespace voxelume {

/// Throws Error::input for a file that is missing, damaged or above 2^26 pixels.
PngShape read_png_shape(const std::filesystem::path& path);

/// The numbers of PNGs of that shape, one after another, row 0 at the top, in the order of bytes of
/// this machine. Throws as read_png_shape does, and Error::input for another shape.
std::vector<std::byte> read_png_values(std::span<const std::filesystem::path> paths,
                                       const PngShape& shape);

}  // namespace voxelume
