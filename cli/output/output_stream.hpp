// SPDX-License-Identifier: Apache-2.0
// `-o -`: an image on standard output.
#pragma once

#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// True if an output is standard output: "-" is a PNG there, "-.exr" OpenEXR.
bool is_stream(const std::string& output);

/// The output of a job that is standard output, if there is one.
class OutputStream {
  public:
    explicit OutputStream(const std::vector<std::string>& outputs);

    bool is_wanted() const { return format_ != nullptr; }
    /// The channels that the image needs.
    Channels channels(const ImageFileOptions& options) const;
    /// Writes the image. Throws Error::output.
    void write(const Image& image, const ImageFileOptions& options) const;

  private:
    const ImageFormat* format_ = nullptr;  ///< null: no output is standard output
};

}  // namespace voxelume::cli
