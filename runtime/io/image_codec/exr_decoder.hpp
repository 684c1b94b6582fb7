// SPDX-License-Identifier: Apache-2.0
// OpenEXR files -> headers and rows of pixels, by OpenEXR in this process.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runtime/base/files/input_file.hpp"
#include "runtime/image/image.hpp"

namespace voxelume {

/// A part of a file with several.
struct ExrPartHeader {
    std::string name;
    std::vector<std::string> channels;  ///< their own names
    bool is_read = true;                ///< false for what read_exr leaves out
};

/// The contents of a header, for display to people.
struct ExrHeader {
    int width = 0;
    int height = 0;
    std::string layout;       ///< "scanline", "tiled", "deep scanline", "deep tiled"
    std::string compression;  ///< "ZIP"
    std::map<std::string, std::string> channels;    ///< name -> "half", "float" or "uint"; those
                                                    ///< that read_exr reads
    std::map<std::string, std::string> attributes;  ///< text and chromaticities, both as text
    std::vector<ExrPartHeader> parts;               ///< empty for a file with one

    bool holds_ids(const std::string& channel) const { return channels.at(channel) == "uint"; }
    /// The bytes of all channels in memory.
    double pixel_bytes() const { return 4.0 * double(channels.size()) * width * height; }
};

/// Takes an image's rows from decode_exr.
class ExrSink {
  public:
    virtual ~ExrSink() = default;

    /// Is called first, and before memory is taken for pixels.
    virtual void begin(const ExrHeader& header) = 0;

    /// The maximum number of rows that are decoded together.
    virtual int rows_at_once() const = 0;

    /// Returns where `count` rows of a channel from `first` on are put, as float, or as uint32_t
    /// where it holds ids.
    virtual void* room(const std::string& channel, int first, int count) = 0;

    /// Says that all rows for which there was room are there.
    virtual void take_rows() = 0;
};

/// Reads the headers alone. Throws Error::input, as decode_exr does.
ExrHeader decode_exr_header(const InputFile& file);

/// Throws for a deep file, and for one that declares more pixels than it can hold.
void check_exr_size(const InputFile& file, const ExrHeader& header);

/// Gives the rows of every channel to `sink`, and returns the image without them. See read_exr.
Image decode_exr(const InputFile& file, ExrSink& sink);

}  // namespace voxelume
