// SPDX-License-Identifier: Apache-2.0
#include "cli/output/output_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace voxelume::cli {

namespace {

/// The format for standard output: the one that the ending behind the "-" names, or else the first
/// format for screens. Null for outputs that are files.
const ImageFormat* format_of_stream(const std::string& output) {
    for (const ImageFormat& format : image_formats())
        if (output == "-" ? !format.holds_channels : output == fmt::format("-{}", format.ending))
            return &format;
    return nullptr;
}

}  // namespace

bool is_stream(const std::string& output) {
    return format_of_stream(output) != nullptr;
}

OutputStream::OutputStream(const std::vector<std::string>& outputs) {
    const auto found = std::ranges::find_if(outputs, is_stream);
    if (found != outputs.end()) format_ = format_of_stream(*found);
}

Channels OutputStream::channels(const ImageFileOptions& options) const {
    return format_->holds_channels ? options.channels : kColorAlone;
}

void OutputStream::write(const Image& image, const ImageFileOptions& options) const {
    const std::string bytes = image.encode(format_->ending, options);
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() ||
        std::fflush(stdout) != 0)
        throw Error(ErrorKind::output,
                    fmt::format("can't write to standard output: {}", std::strerror(errno)));
}

}  // namespace voxelume::cli
