// SPDX-License-Identifier: Apache-2.0
// Quilts of light-field displays, and stereo pairs.
#pragma once

#include <string>

#include "values.hpp"

namespace voxelume::v1 {

/// Views of a light-field display: from positions in a row, through one window.
struct Quilt {
    int columns = 8;   ///< columns of views in the image
    int rows = 6;      ///< rows of views; at most 1,000 views in all
    double cone = 40;  ///< degrees between the outermost positions, as seen from the window
    double focus = 0;  ///< metres from the observer to the window, which is the plane of the
                       ///< screen; 0: to the observer's focus, else to the world's middle
    /// Metres between the outermost positions, instead of `cone`, as between the eyes of a stereo
    /// pair with two columns and one row; 0: `cone` counts.
    double separation = 0;
};

/// The end of the names of a quilt's files before ".png", by which players recognize it: its
/// columns, its rows and the proportions of its views, as in "_qs8x6a0.75". Pixels are
/// `pixel_aspect` times as wide as high.
std::string quilt_suffix(const Quilt& quilt, Size view, double pixel_aspect = 1);

}  // namespace voxelume::v1
