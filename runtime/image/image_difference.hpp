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
    uint64_t above = 0;      ///< pixels above the threshold, with the unmatched ones; ids: unequal
    bool is_id = false;      ///< true if these are ids, which have no distance
};

/// The choice of differences that count.
struct CompareOptions {
    std::vector<std::string> channels{};  ///< these alone; empty: all
    double threshold = 0.0;               ///< |a - b| up to this isn't above it
};

struct ImageDifference {
    std::vector<ChannelDifference> channels;  ///< in the order of their names, ids last
    std::vector<std::string> only_in_a;
    std::vector<std::string> only_in_b;
    uint64_t pixels = 0;  ///< number of pixels of each image
    uint64_t above = 0;   ///< pixels above the threshold in some channel that both images have
};

/// Compares `a` with the reference `b`; both have the same size. Ids, those of Cryptomatte among
/// them, have no distance, so only `differing` and `above` are counted for them.
///
/// Throws Error::usage for channels of the options that neither image has.
ImageDifference compare_images(const Image& a, const Image& b, const CompareOptions& options = {});

/// An image of |a - b| for each channel that both images have: 0 where values are equal, 65504, the
/// largest half, where one isn't finite. For ids it is 1 where they are unequal.
Image difference_image(const Image& a, const Image& b, const CompareOptions& options = {});

}  // namespace voxelume
