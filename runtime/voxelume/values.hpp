// SPDX-License-Identifier: Apache-2.0
// The small values that the other headers share: vectors, colours, sizes.
#pragma once

#include <array>

namespace voxelume::v1 {

/// Components x, y, z; metres unless stated otherwise.
using Vec3 = std::array<double, 3>;

/// Red, green and blue: linear Rec. 709.
using Color = std::array<double, 3>;

/// Width and height in pixels.
using Size = std::array<int, 2>;

/// Three rows of four numbers: world = matrix * (x, y, z, 1).
using Matrix = std::array<std::array<double, 4>, 3>;

/// A vector with one number along all three axes.
constexpr Vec3 uniform(double x) {
    return {x, x, x};
}

/// The largest width and height of an image.
inline constexpr int kMaxImageSide = 65536;

}  // namespace voxelume::v1
