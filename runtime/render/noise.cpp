// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/noise.hpp"

#include <algorithm>
#include <array>

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

double average_tile(uint32_t tile, const Image& other, Image& image) {
    std::array<double, 16> half{};
    double sum = 0, squares = 0;
    int pixels = 0;
    for_each_pixel(tile, image, [&](size_t at) {
        double& difference = half[size_t(pixels++)];
        for (const auto& [name, luminance] : kLight) {
            float& value = image.planes.at(name)[at];
            const float more = other.planes.at(name)[at];
            difference += 0.5 * luminance * (double(value) - double(more));
            value = 0.5f * (value + more);
            sum += luminance * double(value);
        }
    });
    for (const double difference : half) squares += difference * difference;
    return sum > 0 ? std::sqrt(squares * pixels) / sum : 0;
}

}  // namespace voxelume
