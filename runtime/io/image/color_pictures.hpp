// SPDX-License-Identifier: Apache-2.0
// Files of pictures -> linear colours, one pair of functions a format.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>

#include "runtime/io/image/radiance_picture.hpp"

namespace voxelume {

/// Reads a file's colours: the channels R, G and B, or Y, of an OpenEXR file; a Radiance file of at
/// most `max_pixels`; a PNG, which is taken for sRGB. The three functions throw Error::input for a
/// file that is missing, damaged or without these channels.
ColorPicture read_exr_colors(const std::filesystem::path& path, uint64_t max_pixels);
ColorPicture read_radiance_colors(const std::filesystem::path& path, uint64_t max_pixels);
ColorPicture read_png_colors(const std::filesystem::path& path, uint64_t max_pixels);

/// Reads the size alone from the header. The three functions throw Error::input for a file that is
/// missing or damaged.
glm::ivec2 read_exr_size(const std::filesystem::path& path);
glm::ivec2 read_radiance_size(const std::filesystem::path& path);
glm::ivec2 read_png_size(const std::filesystem::path& path);

}  // namespace voxelume
