// SPDX-License-Identifier: Apache-2.0
// The differences of pictures of surfaces with maps from exact values and from other pictures.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

#include "tests/pictures/textures/texture_image.hpp"
#include "tests/support/instance_scenes.hpp"

namespace voxelume {

/// A row of texels whose right half has the second colour.
inline oracle::Picture halves(std::array<uint8_t, 3> left, std::array<uint8_t, 3> right) {
    oracle::Picture picture{64, 1, {}, oracle::Beyond::clamp, oracle::Beyond::clamp};
    for (int x = 0; x < 64; ++x) picture.texels.push_back(x < 32 ? left : right);
    return picture;
}

/// The RMS difference of the pixels from the means of 256 values, in 1/255. `value` returns the
/// colour at a column and row, or nothing outside the surface; pixels that the surface doesn't fill
/// don't count. More than `min` pixels must count.
template <class Value>
double rms_of_means(const Image& image, size_t min, const Value& value) {
    double squares = 0;
    size_t pixels = 0;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            glm::dvec3 sum(0);
            bool is_inside = true;
            for (int i = 0; i < 256 && is_inside; ++i) {
                const std::optional<glm::dvec3> color =
                    value(column + (i % 16 + 0.5) / 16, row + (i / 16 + 0.5) / 16);
                is_inside = color.has_value();
                sum += color.value_or(glm::dvec3(0)) / 256.0;
            }
            if (!is_inside) continue;
            const size_t pixel = size_t(row) * size_t(image.width) + size_t(column);
            const glm::dvec3 seen(image.planes.at("R")[pixel], image.planes.at("G")[pixel],
                                  image.planes.at("B")[pixel]);
            squares += glm::dot(seen - sum, seen - sum);
            ++pixels;
        }
    EXPECT_GT(pixels, min);
    return 255 * std::sqrt(squares / double(3 * pixels));
}

/// The RMS difference of two pictures over the pixels whose middles `counts` accepts, divided by
/// the second picture's mean. More than `min` values must count.
template <class Counts>
double relative_rms(const Image& image, const Image& expected, size_t min, const Counts& counts) {
    double squares = 0, sum = 0;
    size_t values = 0;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            if (!counts(column + 0.5, row + 0.5)) continue;
            const size_t pixel = size_t(row) * size_t(image.width) + size_t(column);
            for (const char* c : {"R", "G", "B"}) {
                const double is = image.planes.at(c)[pixel], should = expected.planes.at(c)[pixel];
                squares += (is - should) * (is - should);
                sum += should;
                ++values;
            }
        }
    EXPECT_GT(values, min);
    return std::sqrt(squares / double(values)) / (sum / double(values));
}

/// The mean light of a floor under a panel that shines downwards.
inline double light_on_floor(const Image& image) {
    const Plane<float>& plane = image.planes.at("G");
    return std::accumulate(plane.begin(), plane.end(), 0.0) / double(plane.size());
}

}  // namespace voxelume
