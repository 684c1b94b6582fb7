// SPDX-License-Identifier: Apache-2.0
// Volumetric image -> pictures of it, as viewers around the display see them.
#pragma once

#include <glm/vec2.hpp>

#include "runtime/image/image.hpp"
#include "runtime/image/volume.hpp"

namespace voxelume {

/// The direction from which a display is looked at; 0, 0 is the observer's side.
struct ViewPoint {
    double around = 0;  ///< radians around the display's middle, to the observer's right
    double above = 0;   ///< radians, between -pi/2 and pi/2
};

/// The picture of all voxels from outside the display, in perspective.
///
/// The voxels that show something fill the picture. Each has its own colour and covers what is
/// behind it by its opacity. The display's outline stands behind them all. R, G, B are linear.
Image view_volume(const Volume& volume, const ViewPoint& view, glm::ivec2 size);

/// The slices `first` to `end` - 1 laid over one another, as the observer sees them.
Image view_slices(const Volume& volume, int first, int end, glm::ivec2 size);

/// The front and `view` side by side; below them eight slices from near to far, row by row.
Image view_sheet(const Volume& volume, const ViewPoint& view, glm::ivec2 size);

}  // namespace voxelume
