// SPDX-License-Identifier: Apache-2.0
// image with a sample or few a pixel -> the pixels that need more.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/image/image.hpp"

namespace voxelume {

/// The numbers, along the rows, of the pixels that differ from one of their eight neighbours: in
/// their object, in the direction of their surface by more than 26 degrees, in their depth by more
/// than a twentieth of the nearer one, or in the square root of R, G or B by more than `contrast`;
/// and of those that lie at most `reach` columns and rows from such a pixel.
///
/// The image has R, G, B, Z, N and objectId.
std::vector<uint32_t> contrasting_pixels(const Image& image, double contrast, int reach = 0);

/// Averages pixels of an image, which have `samples` samples, with `more_samples` further ones.
/// Pixel i of the list is pixel i % 16 of tile i / 16 of `more`, whose tiles of 4 x 4 lie in a row.
/// Where the first samples met nothing, the points of the others are taken over; shares of mattes
/// are added up and ranked again.
void add_samples(const std::vector<uint32_t>& pixels, const Image& more, int samples,
                 int more_samples, Image& image);

/// The part of an image of `size` pixels from column and row `first` on.
Image part_of(Image image, glm::ivec2 first, glm::ivec2 size);

}  // namespace voxelume
