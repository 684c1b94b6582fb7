// SPDX-License-Identifier: Apache-2.0
// A scene -> the scene as one of a light field's views shows it.
#pragma once

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Views from places in a row, which share a window: what lies in it has one place in all of them.
struct ViewRow {
    int views = 48;    ///< at least 1
    double cone = 40;  ///< degrees between the first and the last place, as seen from the window
    double focus = 0;  ///< metres along Z_E to the window; 0: to what the observer looks at
    double separation = 0;  ///< metres between the first and the last place; 0: as `cone` has it
};

/// The still scene as view `number` shows it, from 0 at the left to the right. Its observer stands
/// aside, and its image is the part of a wider one that the window is. So that this begins at a
/// whole pixel, the place is moved by at most half of a pixel in the window or, where `separation`
/// says how far places are apart, the window by at most half of a pixel.
///
/// Throws Error::usage for an observer without a pyramid, a part of an image, and a window that
/// isn't in front of the observer; Error::limit for views together wider than an image can be.
Scene view_of_row(const Scene& scene, const ViewRow& row, int number);

}  // namespace voxelume
