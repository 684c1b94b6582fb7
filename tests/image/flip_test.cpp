// SPDX-License-Identifier: Apache-2.0
// FLIP: the values that its definition gives in closed form, and the properties that any such
// measure must have.
#include "runtime/image/flip.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace voxelume {
namespace {

constexpr int kWidth = 37, kHeight = 23;

template <class Color>
Image image_of(const Color& color) {
    std::vector<float> values[3];
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::vec3 c = color(x, y);
            for (int channel = 0; channel < 3; ++channel) values[channel].push_back(c[channel]);
        }
    return {kWidth, kHeight, {{"R", values[0]}, {"G", values[1]}, {"B", values[2]}}, {}, {}};
}

Image flat(glm::vec3 color) {
    return image_of([color](int, int) { return color; });
}

TEST(Flip, OfAFlatImageIsTheColorsDistanceAlone) {
    // For greys HyAB is the difference of L*: the values 0.1 and 0.05 have L* 37.842 and 26.734.
    const double grey = std::pow(37.8424 - 26.7347, 0.7);
    // Green and blue are the farthest apart on the scale: L* 87.735 and 32.297, a* -86.183 and
    // 79.188, b* 83.180 and -107.860, with chroma multiplied by L* / 100.
    const double a = 0.87735 * -86.183 - 0.32297 * 79.188;
    const double b = 0.87735 * 83.180 + 0.32297 * 107.860;
    const double largest = std::pow(87.735 - 32.297 + std::hypot(a, b), 0.7);
    EXPECT_NEAR(mean_flip(flat({0.1f, 0.1f, 0.1f}), flat({0.05f, 0.05f, 0.05f})),
                grey * 0.95 / (0.4 * largest), 1e-4);
    EXPECT_NEAR(mean_flip(flat({0, 1, 0}), flat({0, 0, 1})), 1, 1e-6);
    // Black and white differ by more than the knee: by 100^0.7.
    const double white = std::pow(100, 0.7), knee = 0.4 * largest;
    EXPECT_NEAR(mean_flip(flat({0, 0, 0}), flat({1, 1, 1})),
                0.95 + (white - knee) / (largest - knee) * 0.05, 1e-4);
}

TEST(Flip, IsZeroForEqualImagesAndTheSameBothWays) {
    std::mt19937 random(20261121);
    const auto noise = [&](int, int) {
        const auto value = [&] { return float(random() % 1000) / 900; };
        return glm::vec3(value(), value(), value());
    };
    const Image first = image_of(noise), second = image_of(noise);
    for (const float value : flip_map(first, first)) ASSERT_EQ(value, 0);
    const std::vector<float> there = flip_map(first, second), back = flip_map(second, first);
    for (size_t i = 0; i < there.size(); ++i) {
        ASSERT_FLOAT_EQ(there[i], back[i]) << i;
        ASSERT_GT(there[i], 0) << i;
        ASSERT_LE(there[i], 1) << i;
    }
}

TEST(Flip, SeesAnEdgeMoreThanAShadeAndALineOnlyNearIt) {
    const Image dark = flat({0.2f, 0.2f, 0.2f});
    const Image line = image_of([](int x, int) { return glm::vec3(x == 18 ? 0.35f : 0.2f); });
    const std::vector<float> map = flip_map(line, dark);
    const auto at = [&](int x, int y) { return map[size_t(y * kWidth + x)]; };
    EXPECT_GT(at(18, 11), 0.05);
    EXPECT_EQ(at(2, 11), 0);
    EXPECT_NEAR(at(18, 4), at(18, 19), 1e-6);  // equal along the line
    EXPECT_NEAR(at(17, 11), at(19, 11), 1e-6);
    // An edge that only one image has raises the colours' difference to a lower power.
    const Image edge = image_of([](int x, int) { return glm::vec3(x < 18 ? 0.2f : 0.21f); });
    const Image shade = flat({0.21f, 0.21f, 0.21f});
    const std::vector<float> of_edge = flip_map(edge, dark), of_shade = flip_map(shade, dark);
    EXPECT_GT(of_edge[size_t(11 * kWidth + 19)], of_shade[size_t(11 * kWidth + 19)]);
}

TEST(Flip, CutsLightToWhatADisplayShows) {
    EXPECT_EQ(mean_flip(flat({1, 1, 1}), flat({7, 3, 2})), 0);
    EXPECT_EQ(mean_flip(flat({0, 0, 0}), flat({-1, 0, -0.5f})), 0);
}

}  // namespace
}  // namespace voxelume
