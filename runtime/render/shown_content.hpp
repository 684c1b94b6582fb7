// SPDX-License-Identifier: Apache-2.0
// image or volume -> whether any object is in view, and whether any light reaches it
#pragma once

#include "runtime/image/image.hpp"
#include "runtime/image/volume.hpp"

namespace voxelume {

/// What the frames of a run show, together. True wherever it can't be told.
struct ShownContent {
    bool objects = true;  ///< some pixel or voxel shows an object
    bool light = true;    ///< some of these isn't black
};

/// Ends at the first pixel or voxel that shows a lit object, so an ordinary picture costs nothing.
ShownContent content_of(const Image& image);
ShownContent content_of(const Volume& volume);

}  // namespace voxelume
