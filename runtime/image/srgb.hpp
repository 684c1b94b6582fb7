// SPDX-License-Identifier: Apache-2.0
// sRGB, the values that screens and pictures have (IEC 61966-2-1) <-> linear light.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace voxelume {

/// The linear value of an sRGB value, both 1 for white.
inline double srgb_to_linear(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// [k]: the linear value of code k of 0 to 255.
inline std::vector<float> srgb_levels() {
    std::vector<float> levels(256);
    for (size_t code = 0; code < levels.size(); ++code)
        levels[code] = float(srgb_to_linear(double(code) / 255));
    return levels;
}

/// [k]: the linear value at which code k ends and k + 1 begins, with `codes` the one of white.
inline std::vector<float> srgb_thresholds(uint16_t codes) {
    std::vector<float> thresholds(codes);
    for (size_t k = 0; k < thresholds.size(); ++k)
        thresholds[k] = float(srgb_to_linear((double(k) + 0.5) / double(codes)));
    return thresholds;
}

}  // namespace voxelume
