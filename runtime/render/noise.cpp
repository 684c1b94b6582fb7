// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/noise.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace voxelume {
namespace {

struct Channel {
    const char* name;
    double luminance;
};

constexpr std::array<Channel, 4> kLight = {{{"R", 0.2126}, {"G", 0.7152}, {"B", 0.0722}, {"A", 0}}};

/// Calls `see` with the place of each of a tile's pixels.
template <class See>
void for_each_pixel(uint32_t tile, const Image& image, See&& see) {
    const int tiles_x = (image.width + 3) / 4;
    const int column = int(tile) % tiles_x * 4, row = int(tile) / tiles_x * 4;
    for (int y = row; y < std::min(row + 4, image.height); ++y)
        for (int x = column; x < std::min(column + 4, image.width); ++x)
            see(size_t(y) * size_t(image.width) + size_t(x));
}

/// Gives a pixel of `image` the variance of both images' samples. Its mean isn't changed yet.
void join_variance(const std::string& color, size_t at, int samples, const Image& other,
                   Image& image) {
    const std::string name = "variance." + color;
    const auto of = [&](const Image& half) {
        return MeanOfSamples{samples, double(half.planes.at(color)[at]),
                             double(half.planes.at(name)[at])};
    };
    image.planes.at(name)[at] = joined_variance(of(image), of(other));
}

}  // namespace

bool is_dark_tile(uint32_t tile, const Image& image) {
    double sum = 0, covered = 0;
    for_each_pixel(tile, image, [&](size_t at) {
        for (const auto& [name, luminance] : kLight)
            sum += luminance * double(image.planes.at(name)[at]);
        covered += double(image.planes.at("A")[at]);
    });
    return sum == 0 && covered > 0;
}

float joined_variance(const MeanOfSamples& a, const MeanOfSamples& b) {
    const auto squares = [](const MeanOfSamples& part) {
        return part.samples < 2 ? 0 : double(part.samples) * (part.samples - 1) * part.variance;
    };
    const double apart = a.mean - b.mean, all = double(a.samples) + b.samples;
    const double between = double(a.samples) * b.samples / all * apart * apart;
    const double variance = (squares(a) + squares(b) + between) / (all * (all - 1));
    return float(std::min(variance, double(std::numeric_limits<float>::max())));
}

double average_tile(uint32_t tile, int samples, const Image& other, Image& image) {
    std::array<double, 16> half{};
    double sum = 0, squares = 0;
    int pixels = 0;
    const bool has_variance = image.planes.contains("variance.R");
    for_each_pixel(tile, image, [&](size_t at) {
        double& difference = half[size_t(pixels++)];
        for (const auto& [name, luminance] : kLight) {
            float& value = image.planes.at(name)[at];
            const float more = other.planes.at(name)[at];
            if (has_variance && luminance > 0) join_variance(name, at, samples, other, image);
            difference += 0.5 * luminance * (double(value) - double(more));
            value = 0.5f * (value + more);
            sum += luminance * double(value);
        }
    });
    for (const double difference : half) squares += difference * difference;
    return sum > 0 ? std::sqrt(squares * pixels) / sum : 0;
}

}  // namespace voxelume
