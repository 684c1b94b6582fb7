// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/band_files.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "runtime/api/image_files.hpp"

namespace voxelume::api {
namespace {

/// Adds the seconds of its life to a sum.
class Stopwatch {
  public:
    explicit Stopwatch(double& sum) : sum_(sum) {}
    ~Stopwatch() {
        sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    double& sum_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::string noise_text(const NoiseReached& noise) {
    return fmt::format("{:.5f}", noise.mean());
}

BandFiles::BandFiles(const ImageWindow& window, Attributes texts, const v1::FrameFiles& files,
                     const v1::ImageFileOptions& options, BandChange change)
    : window_(window),
      texts_(std::move(texts)),
      names_(files.images),
      options_(options),
      change_(std::move(change)),
      files_(names_.size()) {}

void BandFiles::add(const std::shared_ptr<const Image>& band) {
    const Stopwatch watch(seconds_);
    const v1::Image::Implementation image{change_(band), texts_, false};
    for (size_t i = 0; i < names_.size(); ++i)
        write_band(names_[i], window_, image, options_, files_[i]);
}

void BandFiles::finish(const RenderReport& report) {
    const Stopwatch watch(seconds_);
    for (const std::unique_ptr<ImageRows>& file : files_) {
        if (texts_.contains("noise")) file->retell("noise", noise_text(report.noise));
        file->finish();
    }
}

}  // namespace voxelume::api
