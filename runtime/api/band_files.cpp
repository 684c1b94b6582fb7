// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/band_files.hpp"

#include <fmt/format.h>

#include <utility>

#include "runtime/api/image_files.hpp"
#include "runtime/base/stopwatch.hpp"

namespace voxelume::api {

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
    Stopwatch watch(seconds_);
    const v1::Image::Implementation image{change_(band), texts_, false};
    for (size_t i = 0; i < names_.size(); ++i)
        write_band(names_[i], window_, image, options_, files_[i]);
    watch.stop();
}

void BandFiles::finish(const RenderReport& report) {
    Stopwatch watch(seconds_);
    for (const std::unique_ptr<ImageRows>& file : files_) {
        if (texts_.contains("noise")) file->retell("noise", noise_text(report.noise));
        file->finish();
    }
    watch.stop();
}

}  // namespace voxelume::api
