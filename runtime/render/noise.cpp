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

}  // namespace

TileNoise average_tile(uint32_t tile, const Image& other, Image& image) {
    const int tiles_x = (image.width + 3) / 4;
    const int column = int(tile) % tiles_x * 4, row = int(tile) / tiles_x * 4;
    std::array<double, 16> half{};
    double sum = 0, squares = 0, covered = 0;
    int pixels = 0;
    for (int y = row; y < std::min(row + 4, image.height); ++y)
        for (int x = column; x < std::min(column + 4, image.width); ++x) {
            const size_t at = size_t(y) * size_t(image.width) + size_t(x);
            double& difference = half[size_t(pixels++)];
            for (const auto& [name, luminance] : kLight) {
                float& value = image.planes.at(name)[at];
                const float more = other.planes.at(name)[at];
                difference += 0.5 * luminance * (double(value) - double(more));
                value = 0.5f * (value + more);
                sum += luminance * double(value);
            }
            covered += double(image.planes.at("A")[at]);
        }
    for (const double difference : half) squares += difference * difference;
    return {sum > 0 ? std::sqrt(squares * pixels) / sum : 0, sum == 0 && covered > 0};
}

}  // namespace voxelume
