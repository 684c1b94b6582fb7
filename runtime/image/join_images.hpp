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

/// The quilt of views of one size and of the same channels, `columns` to a row: the first one is at
/// the bottom left, and the last one at the top right.
Image quilt_of(const std::vector<std::shared_ptr<const Image>>& views, int columns);

}  // namespace voxelume
