// SPDX-License-Identifier: Apache-2.0
// Bands of an image -> its files.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/api/border/handles.hpp"
#include "runtime/batch/banded_image.hpp"
#include "runtime/io/image/image_rows.hpp"
#include "runtime/voxelume/image.hpp"
#include "runtime/voxelume/render.hpp"

namespace voxelume::api {

/// Changes a band before it is written.
using BandChange =
    std::function<std::shared_ptr<const Image>(const std::shared_ptr<const Image>& band)>;

/// The error of an image's light, as its files have it.
std::string noise_text(const NoiseReached& noise);

/// Writes an image's files band by band. They appear under their names when all is there.
class BandFiles final : public BandSink {
  public:
    /// `texts` are the texts of the files' headers. If the image's noise is one of them, its value
    /// is written at the end.
    BandFiles(const ImageWindow& window, Attributes texts, const v1::FrameFiles& files,
              const v1::ImageFileOptions& options, BandChange change);

    void add(const std::shared_ptr<const Image>& band) override;
    void finish(const RenderReport& report) override;

    double seconds() const { return seconds_; }  ///< seconds that writing took

  private:
    ImageWindow window_;
    Attributes texts_;
    std::vector<std::filesystem::path> names_;
    v1::ImageFileOptions options_;
    BandChange change_;
    std::vector<std::unique_ptr<ImageRows>> files_;
    double seconds_ = 0;
};

}  // namespace voxelume::api
