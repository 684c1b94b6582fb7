// SPDX-License-Identifier: Apache-2.0
// Exposures that callers give.
#pragma once

#include <cmath>

#include "runtime/base/error.hpp"

namespace voxelume::api {

/// The stops as writers take them. Throws Error::usage for more than 64, either way, and for what
/// isn't a number: colours would be black, infinite or none.
inline float exposure_inside(double stops) {
    constexpr double kMaxStops = 64;
    if (std::abs(stops) <= kMaxStops) return float(stops);
    throw Error(ErrorKind::usage, "an exposure is from {} to {} stops, not {}", -kMaxStops,
                kMaxStops, stops);
}

}  // namespace voxelume::api
