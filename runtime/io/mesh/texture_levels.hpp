// SPDX-License-Identifier: Apache-2.0
// picture -> texture: its levels for distant looks.
#pragma once

#include "runtime/geometry/texture.hpp"
#include "runtime/io/image/png.hpp"

namespace voxelume {

/// The picture and its levels. A texel of a level is the mean, in linear light, of the area of the
/// level before that it stands for; texels count by their alpha where some of them have any.
TextureImage with_levels(const Picture& picture);

/// The same of a picture whose channels are numbers, and no colours: texels are plain means of
/// them.
TextureImage with_levels_of_data(const Picture& picture);

/// An image of one texel, of these channels.
TextureImage one_texel(uint8_t red, uint8_t green, uint8_t blue);

}  // namespace voxelume
