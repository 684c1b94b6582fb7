// SPDX-License-Identifier: Apache-2.0
// Image file of a mesh's texture -> 8-bit picture.
#pragma once

#include <filesystem>
#include <span>

#include "runtime/io/image/png.hpp"

namespace voxelume {

/// Decodes a JPEG of grey, YCbCr, RGB, or inks (CMYK, YCCK), which become the colour that they
/// leave of white light; alpha is 255. With Adobe's marker inks are stored inverted. The rotation
/// that a camera noted isn't applied, as UVs refer to the stored rows. Throws Error::input, which
/// begins with `name`, for bytes that are damaged or cut off, and above kMaxTexturePixels.
Picture parse_jpeg(std::span<const uint8_t> bytes, const std::filesystem::path& name);

/// Decodes a PNG or JPEG, as its first bytes tell. Throws as parse_jpeg does.
Picture parse_picture(std::span<const uint8_t> bytes, const std::filesystem::path& name);

/// Reads a picture's file. Throws as parse_picture does, and Error::input for a file that can't be
/// read.
Picture read_picture(const std::filesystem::path& path);

}  // namespace voxelume
