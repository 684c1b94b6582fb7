// SPDX-License-Identifier: Apache-2.0
// OpenEXR's writer of headers and chunks of rows, onto a file of ours.
#pragma once

#include <openexr.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "runtime/base/files/byte_sink.hpp"
#include "runtime/io/image/exr_chunks.hpp"
#include "runtime/io/image/exr_layers.hpp"
#include "runtime/io/image/image_rows.hpp"

namespace voxelume {

/// Writes the header of a scanline file and its chunks. OpenEXR 3.1.5's own stream truncates small
/// files silently on a full disk.
class ExrChunkWriter {
  public:
    using Attributes = std::map<std::string, std::string>;

    /// `path` is for OpenEXR, which opens nothing.
    ExrChunkWriter(ByteSink& file, const std::filesystem::path& path);
    ~ExrChunkWriter() { exr_finish(&context_); }
    ExrChunkWriter(const ExrChunkWriter&) = delete;
    ExrChunkWriter& operator=(const ExrChunkWriter&) = delete;

    /// The first part has the attributes, and each part of a matte has that matte's own.
    void header(const ImageWindow& window, const Attributes& attributes,
                const std::vector<ExrPart>& parts);

    /// Writes the next chunk of a part, whose first row is the `row`-th of the image. Chunks come
    /// from the top down, part after part.
    void chunk(size_t part, int row, const std::string& bytes);

    /// Replaces a text that occurs once in the header by one of the same length.
    void retell(const std::string& name, const std::string& text);

    /// Writes the table of rows.
    void finish() { check(exr_finish(&context_)); }

  private:
    void allow_long_names(const std::vector<ExrPart>& parts);
    void add_channels(int part, const std::vector<ExrPlane>& planes);
    void add_texts(int part, const Attributes& texts);
    void set_windows(int part, const ImageWindow& window, double pixel_aspect);
    int64_t write(const void* bytes, uint64_t size, uint64_t position) noexcept;
    void check(exr_result_t result);

    ByteSink& file_;
    exr_context_t context_ = nullptr;
    int first_row_ = 0;
    bool is_in_header_ = false;
    std::string header_;  ///< its bytes
};

}  // namespace voxelume
