// SPDX-License-Identifier: Apache-2.0
// picture -> texture: its smaller copies, for distant views.
#pragma once

#include "runtime/geometry/texture.hpp"
#include "runtime/io/image/png.hpp"

namespace voxelume {

/// The picture and its levels. A texel of a level is the mean, in linear light, of the area that it
/// covers of the level before; texels are weighted by their alpha where some of them have any.
TextureImage with_levels(const Picture& picture);

/// An image of numbers and its levels, whose texels are the plain means of the areas that they
/// cover.
TextureImage with_levels_of_data(const Picture& picture);

/// The roughness, as a texel, of a map that can't be read: 0.7.
inline constexpr uint8_t kUnknownRoughness = 179;

/// An image of one texel, of these channels.
TextureImage one_texel(uint8_t red, uint8_t green, uint8_t blue);

}  // namespace voxelume
