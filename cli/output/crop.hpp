// SPDX-License-Identifier: Apache-2.0
// The part of an image that --crop names.
#pragma once

#include <string>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// A part of an image, in pixels from the top left.
struct ImagePart {
    Size first{}, size{};
};

/// Reads "X,Y,WIDTH,HEIGHT"; an empty text means all of the scene's image. Throws Error::usage for
/// other texts, and for a part that isn't inside the image.
ImagePart part_of(const std::string& text, const Scene& scene);

}  // namespace voxelume::cli
