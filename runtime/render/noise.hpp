// SPDX-License-Identifier: Apache-2.0
// How noisy an image is, by two halves of its samples.
#pragma once

#include <cmath>
#include <cstdint>

#include "runtime/image/image.hpp"

namespace voxelume {

/// The noise of the tiles of an image.
struct NoiseReached {
    double squares = 0;  ///< of the tiles' relative standard errors, added up
    uint64_t tiles = 0;

    double mean() const { return tiles == 0 ? 0 : std::sqrt(squares / double(tiles)); }
};

/// Whether a tile shows surfaces of which no light came.
bool is_dark_tile(uint32_t tile, const Image& image);

/// Averages a tile's light over two images with equally many samples, in `image`. Returns the
/// standard error of the light of its pixels over their mean, 0 where there is none. A pixel's
/// error is half of the difference of its two values.
double average_tile(uint32_t tile, const Image& other, Image& image);

}  // namespace voxelume
