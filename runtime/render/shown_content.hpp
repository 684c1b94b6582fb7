// SPDX-License-Identifier: Apache-2.0
// image or volume -> whether any object is in view, and whether any light reaches it
#pragma once

#include "runtime/image/image.hpp"
#include "runtime/image/volume.hpp"

namespace voxelume {

/// The content of all frames of a run together. Flags are true if unknown.
struct ShownContent {
    bool objects = true;  ///< some pixel or voxel shows an object
    bool light = true;    ///< some shown object isn't black
};

/// Describes an image. Ends at the first pixel that shows a lit object, so it is fast for most
/// pictures.
ShownContent content_of(const Image& image);
ShownContent content_of(const Volume& volume);

}  // namespace voxelume
