// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/texture_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace voxelume::oracle {
namespace {

/// The texel for any number, by the plain meaning of the three ways to continue beyond the edges.
int texel_of(int at, int size, Beyond beyond) {
    if (beyond == Beyond::clamp) return std::clamp(at, 0, size - 1);
    if (beyond == Beyond::repeat) return (at % size + size) % size;
    const int in_pair = (at % (2 * size) + 2 * size) % (2 * size);
    return in_pair < size ? in_pair : 2 * size - 1 - in_pair;
}

}  // namespace

double linear_light(double code) {
    const double s = code / 255;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

glm::dvec3 bilinear(const Picture& picture, const glm::dvec2& place) {
    const glm::dvec2 at = place * glm::dvec2(picture.width, picture.height) - 0.5;
    glm::dvec3 sum(0);
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 corner = glm::floor(at) + glm::dvec2(i & 1, i >> 1);
        const glm::dvec2 weight = 1.0 - glm::abs(at - corner);
        const int x = texel_of(int(corner.x), picture.width, picture.beyond_u);
        const int y = texel_of(int(corner.y), picture.height, picture.beyond_v);
        const auto& texel = picture.texels[size_t(y) * size_t(picture.width) + size_t(x)];
        for (int c = 0; c < 3; ++c) sum[c] += weight.x * weight.y * linear_light(texel[size_t(c)]);
    }
    return sum;
}

}  // namespace voxelume::oracle
