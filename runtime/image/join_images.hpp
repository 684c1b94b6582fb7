// SPDX-License-Identifier: Apache-2.0
// parts of a picture -> the picture.
#pragma once

#include <vector>

#include "runtime/image/image.hpp"

namespace voxelume {

/// An image of parts that lie one below the other, in any order, without gaps. It is a part itself
/// if they aren't all of their picture. Its attributes are those of the first part.
///
/// Throws Error::input for parts of different pictures, columns or channels, and for rows that two
/// parts have or that none between them has.
Image join_images(std::vector<Image> parts);

}  // namespace voxelume
