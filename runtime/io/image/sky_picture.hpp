// SPDX-License-Identifier: Apache-2.0
// A picture's file -> linear colours, in whichever format it is.
#pragma once

#include <filesystem>

#include "runtime/io/image/radiance_picture.hpp"

namespace voxelume {

/// The size of a picture's file by its header. Throws as read_sky_picture does.
glm::ivec2 sky_picture_size(const std::filesystem::path& path, int64_t max_pixels);

/// Reads an OpenEXR (channels R, G and B, or Y), Radiance or PNG file, whose colours are then taken
/// for sRGB. Values that are negative or no numbers become 0, those above 1e9 1e9. Throws
/// Error::input for a file that is missing, damaged, of another format or of more pixels than that.
ColorPicture read_sky_picture(const std::filesystem::path& path, int64_t max_pixels);

}  // namespace voxelume
