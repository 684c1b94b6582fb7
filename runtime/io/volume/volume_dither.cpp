// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/volume/volume_dither.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "runtime/io/image/png.hpp"

namespace voxelume {

namespace {

/// Bayer's rank, 0..63. Bits of x ^ y and of y alternate; a coordinate's lowest bit counts most.
///
///     x = x2 x1 x0, y = y2 y1 y0, q = x ^ y   ->   rank = q0 y0 q1 y1 q2 y2
int bayer_rank(int x, int y) {
    const int q = x ^ y;
    int rank = 0;
    for (int bit = 0; bit < 3; ++bit) rank = rank << 2 | (q >> bit & 1) << 1 | (y >> bit & 1);
    return rank;
}

}  // namespace

float threshold_at(Dither dither, int column, int row, int plane) {
    if (dither == Dither::none) return 0.5f;
    const int x = (column + 3 * plane) & 7, y = (row + 5 * plane) & 7;
    return (static_cast<float>(bayer_rank(x, y)) + 0.5f) / 64.0f;
}

int level_of(float value, int maximum, float threshold) {
    const float scaled = value * static_cast<float>(maximum);
    const float whole = std::floor(scaled);
    return std::min(static_cast<int>(whole) + (scaled - whole > threshold ? 1 : 0), maximum);
}

glm::vec3 light_of(const glm::vec3& color, float opacity, float exposure) {
    return glm::clamp(color * (opacity * std::exp2(exposure)), glm::vec3(0), glm::vec3(1));
}

float luminance(const glm::vec3& light) {
    return 0.2126f * light.r + 0.7152f * light.g + 0.0722f * light.b;
}

float srgb_share(float linear) {
    return static_cast<float>(srgb_code(linear)) / 255.0f;
}

}  // namespace voxelume
