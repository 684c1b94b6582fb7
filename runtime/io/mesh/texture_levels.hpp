// SPDX-License-Identifier: Apache-2.0
// picture -> texture: its levels for distant looks.
#pragma once

#include "runtime/geometry/texture.hpp"
#include "runtime/io/image/png.hpp"

namespace voxelume {

/// The picture and its levels. A texel of a level is the mean, in linear light, of the area of the
/// level before that it stands for; texels count by their alpha where some of them have any.
TextureImage with_levels(const Picture& picture);

}  // namespace voxelume
