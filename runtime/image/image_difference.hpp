// SPDX-License-Identifier: Apache-2.0
// The measured differences between two images.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/image/image.hpp"

namespace voxelume {

/// The difference in one channel that both images have. The errors cover the pixels where both
/// values are finite.
struct ChannelDifference {
    std::string channel;
    double largest = 0.0;    ///< max |a - b|
    double rmse = 0.0;       ///< root of the mean of (a - b)^2
    double mae = 0.0;        ///< mean of |a - b|
    double mrse = 0.0;       ///< mean of ((a - b) / (|b| + 0.01))^2, b being the reference
    uint64_t differing = 0;  ///< pixels whose values are unequal; two NaNs are equal
    uint64_t unmatched = 0;  ///< those of them with a value that isn't finite; not in the errors
};

struct ImageDifference {
    std::vector<ChannelDifference> channels;  ///< in the order of their names, ids last
    std::vector<std::string> only_in_a;
    std::vector<std::string> only_in_b;
};

/// Compares `a` with the reference `b`; both have the same size. Ids have no distance, so only
/// `differing` is counted for them.
ImageDifference compare_images(const Image& a, const Image& b);

}  // namespace voxelume
