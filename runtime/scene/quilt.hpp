// SPDX-License-Identifier: Apache-2.0
// A scene -> the scene as one view of a light field.
#pragma once

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Views from positions in a row through one window: points in the window have the same pixel in
/// all views.
struct ViewRow {
    int views = 48;    ///< at least 1
    double cone = 40;  ///< degrees between the first and the last position, as seen from the window
    double focus = 0;  ///< metres along Z_E to the window; 0: the focus, else the world's middle
    double separation = 0;  ///< metres between the first and the last position; 0: `cone` decides
};

/// The still scene as view `number` shows it, from 0 at the left to the right. Its observer is
/// shifted sideways, and its image is the part of a wider one that lies in the window. So that this
/// part begins at a whole pixel, the position is moved by at most half of a pixel in the window or,
/// if `separation` gives the distance of positions, the window by at most half of a pixel.
///
/// Throws Error::usage for an observer without a pyramid, a part of an image, and a window that
/// isn't in front of the observer; Error::limit for views together wider than an image can be.
Scene view_of_row(const Scene& scene, const ViewRow& row, int number);

}  // namespace voxelume
