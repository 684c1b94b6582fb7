// SPDX-License-Identifier: Apache-2.0
// How noisy an image is, by two halves of its samples.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

#include "runtime/image/image.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The noise of the tiles of an image: a sum that doesn't depend on the order of tiles.
class NoiseReached {
  public:
    uint64_t tiles = 0;

    /// Adds a tile's relative standard error.
    void add(double error) {
        squares_ += Wide(std::min(error * error, kMaxSquare) * kUnit);
        ++tiles;
    }
    NoiseReached& operator+=(const NoiseReached& other) {
        squares_ += other.squares_;
        tiles += other.tiles;
        return *this;
    }
    double mean() const {
        return tiles == 0 ? 0 : std::sqrt(double(squares_) / kUnit / double(tiles));
    }

  private:
    __extension__ using Wide = unsigned __int128;
    static constexpr double kUnit = 0x1p64, kMaxSquare = 0x1p30;
    Wide squares_ = 0;  ///< in units of 2^-64
};

/// The number of samples below which surfaces without light get more: few paths may find it.
inline constexpr int kDarkSamples = 256;

using NoiseClock = std::chrono::steady_clock;

/// True if there is time for as much work as was done since the start.
inline bool has_time(const NoiseTarget& target, NoiseClock::time_point start) {
    const std::chrono::duration<double> spent = NoiseClock::now() - start;
    return target.seconds == 0 || 2 * spent.count() <= target.seconds;
}

/// The part of a frame's time that each of its images may take.
inline double time_share(const RenderSettings& render) {
    return render.shows_image && render.shows_volume ? 0.5 : 1;
}

/// The luminance of linear Rec. 709 light.
constexpr double luminance(double red, double green, double blue) {
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

/// The standard error of the light of a group of pixels or voxels over its mean, by two halves of
/// the samples.
class ErrorOfHalves {
  public:
    /// Adds half of the difference of a pixel's two values, and their mean.
    void add(double half_difference, double mean) {
        squares_ += half_difference * half_difference;
        sum_ += mean;
        ++count_;
    }
    /// 0 where there is no light.
    double relative() const { return sum_ > 0 ? std::sqrt(squares_ * count_) / sum_ : 0; }

  private:
    double squares_ = 0, sum_ = 0;
    int count_ = 0;
};

/// True if the noise of a scene's image is known once the image is rendered.
bool measures_noise(const Scene& scene);

/// True if a tile shows surfaces from which no light came.
bool is_dark_tile(uint32_t tile, const Image& image);

/// Averages a tile's light over two images with `samples` samples each, in `image`, whose
/// variance, if it has one, becomes that of the average. Returns the standard error of the light
/// of its pixels over their mean, 0 where there is none. A pixel's error is half of the difference
/// of its two values.
double average_tile(uint32_t tile, int samples, const Image& other, Image& image);

/// A pixel of an image that has variances, which are infinite for one sample.
struct SampledPixel {
    const Image& image;
    size_t at;
    int samples;
};

/// The variance of the mean of both pixels' samples of a colour ("R", "G" or "B"), finite (Chan,
/// Golub and LeVeque 1983).
float joined_variance(const std::string& color, const SampledPixel& a, const SampledPixel& b);

}  // namespace voxelume
