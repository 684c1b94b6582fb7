// SPDX-License-Identifier: Apache-2.0
// parts of a picture -> the picture; views -> their quilt.
#pragma once

#include <memory>
#include <vector>

#include "runtime/image/image.hpp"

namespace voxelume {

/// Joins parts that lie one below the other, in any order, without gaps. The result is a part
/// itself if the parts don't cover all of their picture. Its attributes are those of the first
/// part.
///
/// Throws Error::input for parts of different pictures, columns or channels, and for rows that two
/// parts have or that none between them has.
Image join_images(std::vector<Image> parts);

/// Copies view `number` to its place in a quilt of `columns` x `rows` views of its size: the first
/// one is at the bottom left, and the last one at the top right. An empty quilt gets its size, its
/// channels and its attributes from the view; later views need the same size and channels.
void place_view(const Image& view, int number, const glm::ivec2& columns_and_rows, Image& quilt);

}  // namespace voxelume
