// SPDX-License-Identifier: Apache-2.0
// Ranked coverage -> the channels and attributes of Cryptomatte.
//
// Source: the Cryptomatte specification 1.2 (Psyop), with MurmurHash3_x86_32 of Austin Appleby.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/image/image.hpp"

namespace voxelume {

/// The start of the names of Cryptomatte's attributes.
constexpr std::string_view kMatteKey = "cryptomatte/";

/// MurmurHash3_x86_32 of a text, with the seed 0.
uint32_t murmur_hash(std::string_view text);

/// The bits of the float by which Cryptomatte names something: the hash, changed where the float
/// wouldn't be a normal number.
uint32_t cryptomatte_bits(std::string_view name);

/// The objects or materials that cover each pixel, rank after rank.
struct RankedCoverage {
    std::vector<uint32_t> numbers;  ///< from 1 on; 0 for nothing
    std::vector<float> shares;      ///< parts of the pixel
    uint32_t ranks = 0;
};

/// Adds the channels LAYER00.R ... of an image, two ranks in each four, and the attributes with the
/// manifest. `names` are those of the numbers 1, 2, ...; larger numbers are nothing.
void add_cryptomatte(const std::string& layer, const std::vector<std::string>& names,
                     const RankedCoverage& coverage, Image& image);

}  // namespace voxelume
