// SPDX-License-Identifier: Apache-2.0
#include "cli/output/output_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace voxelume::cli {

bool is_stream(const std::string& output) {
    return output == "-" || output == "-.png" || output == "-.exr";
}

OutputStream::OutputStream(const std::vector<std::string>& outputs) {
    const auto found = std::ranges::find_if(outputs, is_stream);
    if (found != outputs.end()) ending_ = *found == "-.exr" ? ".exr" : ".png";
}

Channels OutputStream::channels(const ImageFileOptions& options) const {
    return ending_ == ".exr" ? options.channels : kColorAlone;
}

void OutputStream::write(const Image& image, const ImageFileOptions& options) const {
    const std::string bytes = image.encode(ending_, options);
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() ||
        std::fflush(stdout) != 0)
        throw Error(ErrorKind::output,
                    fmt::format("can't write to standard output: {}", std::strerror(errno)));
}

}  // namespace voxelume::cli
