// SPDX-License-Identifier: Apache-2.0
// A picture's file in any format -> linear colours.
#pragma once

#include <filesystem>

#include "runtime/io/image/radiance_picture.hpp"

namespace voxelume {

/// The size of a picture's file by its header. Throws as read_sky_picture does.
glm::ivec2 sky_picture_size(const std::filesystem::path& path, int64_t max_pixels);

/// Reads an OpenEXR (channels R, G and B, or Y), Radiance or PNG file; colours of a PNG are taken
/// for sRGB. Negative values and NaN become 0, values above 1e9 become 1e9. Throws Error::input for
/// a file that is missing, damaged, of another format or of more than `max_pixels`.
ColorPicture read_sky_picture(const std::filesystem::path& path, int64_t max_pixels);

}  // namespace voxelume
