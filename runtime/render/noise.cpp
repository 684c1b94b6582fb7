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
    double share;  ///< of the luminance
};

constexpr std::array<Channel, 4> kLight = {
    {{"R", luminance(1, 0, 0)}, {"G", luminance(0, 1, 0)}, {"B", luminance(0, 0, 1)}, {"A", 0}}};

/// Calls `see` with the index of each of a tile's pixels.
template <class See>
void for_each_pixel(uint32_t tile, const Image& image, See&& see) {
    const int tiles_x = (image.width + 3) / 4;
    const int column = int(tile) % tiles_x * 4, row = int(tile) / tiles_x * 4;
    for (int y = row; y < std::min(row + 4, image.height); ++y)
        for (int x = column; x < std::min(column + 4, image.width); ++x)
            see(size_t(y) * size_t(image.width) + size_t(x));
}

}  // namespace

bool is_dark_tile(uint32_t tile, const Image& image) {
    double sum = 0, covered = 0;
    for_each_pixel(tile, image, [&](size_t at) {
        for (const auto& [name, share] : kLight) sum += share * double(image.planes.at(name)[at]);
        covered += double(image.planes.at("A")[at]);
    });
    return sum == 0 && covered > 0;
}

float joined_variance(const std::string& color, const SampledPixel& a, const SampledPixel& b) {
    const auto mean = [&](const SampledPixel& of) {
        return double(of.image.planes.at(color)[of.at]);
    };
    const auto squares = [&](const SampledPixel& of) {
        if (of.samples < 2) return 0.0;
        const float variance = of.image.planes.at("variance." + color)[of.at];
        return double(of.samples) * (of.samples - 1) * double(variance);
    };
    const double apart = mean(a) - mean(b), all = double(a.samples) + b.samples;
    const double between = double(a.samples) * b.samples / all * apart * apart;
    const double variance = (squares(a) + squares(b) + between) / (all * (all - 1));
    return float(std::min(variance, double(std::numeric_limits<float>::max())));
}

double average_tile(uint32_t tile, int samples, const Image& other, Image& image) {
    ErrorOfHalves error;
    const bool has_variance = image.planes.contains("variance.R");
    for_each_pixel(tile, image, [&](size_t at) {
        double difference = 0, light = 0;
        for (const auto& [name, share] : kLight) {
            float& value = image.planes.at(name)[at];
            const float more = other.planes.at(name)[at];
            if (has_variance && share > 0)
                image.planes.at(std::string("variance.") + name)[at] =
                    joined_variance(name, {image, at, samples}, {other, at, samples});
            difference += 0.5 * share * (double(value) - double(more));
            value = 0.5f * (value + more);
            light += share * double(value);
        }
        error.add(difference, light);
    });
    return error.relative();
}

}  // namespace voxelume
