// SPDX-License-Identifier: Apache-2.0
// The headers of an OpenEXR file's parts, and which channels of them make an image.
#pragma once

#include <openexr.h>

#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/files/input_file.hpp"
#include "runtime/io/image_codec/exr_decoder.hpp"

namespace voxelume {

/// A channel of an image, and where it is in the file.
struct ExrChannel {
    int part = 0;
    std::string own;   ///< its name in the part
    std::string name;  ///< in the image
    exr_pixel_type_t type = EXR_PIXEL_FLOAT;
};

/// True if a text belongs to the file format: it says that a part consists of scanlines or of
/// tiles, or is the name of one of several parts.
bool is_of_format(std::string_view attribute, bool has_parts);

/// Owns a handle of OpenEXR's core library, which parses headers without allocating memory for
/// pixels or row tables.
class ExrHeaderReader {
  public:
    /// `file` was checked by check_exr_header. Throws Error::input, as its members do.
    explicit ExrHeaderReader(const InputFile& file);
    ~ExrHeaderReader() { exr_finish(&context_); }
    ExrHeaderReader(const ExrHeaderReader&) = delete;
    ExrHeaderReader& operator=(const ExrHeaderReader&) = delete;

    ExrHeader read() const;

    /// The channels of the first part and of those that go with it, see read_exr.
    std::vector<ExrChannel> channels() const;

    /// Refuses parts with more chunks than the file has room for in its table of them.
    void check_chunks() const;

  private:
    void check(exr_result_t result) const;
    int part_count() const;
    exr_attr_box2i_t window(int part) const;
    exr_storage_t storage(int part) const;
    std::string part_name(int part) const;
    bool is_read(int part) const;
    const exr_attr_chlist_t& list(int part) const;
    void add_attributes(int part, ExrHeader& header) const;

    const InputFile& file_;
    exr_context_t context_ = nullptr;
};

}  // namespace voxelume
