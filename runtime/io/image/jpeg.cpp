// SPDX-License-Identifier: Apache-2.0
// JPEG -> 8-bit picture, by libjpeg-turbo.
#include <turbojpeg.h>

#include <memory>

#include "runtime/base/error.hpp"
#include "runtime/io/image/picture.hpp"

namespace voxelume {
namespace {

struct CloseDecoder {
    void operator()(void* decoder) const { tjDestroy(decoder); }
};

}  // namespace

Picture parse_jpeg(std::span<const uint8_t> bytes, const std::filesystem::path& name) {
    const std::unique_ptr<void, CloseDecoder> decoder(tjInitDecompress());
    const auto refuse = [&](const std::string& reason) {
        throw Error(ErrorKind::input, "{}: {}", SourcePlace(name.string()), reason);
    };
    const auto check = [&](int code) {
        if (code != 0) refuse(fmt::format("not a whole JPEG: {}", tjGetErrorStr2(decoder.get())));
    };
    if (!decoder) refuse("there is no memory to decode a JPEG");
    int width = 0, height = 0, sampling = 0, space = 0;
    check(tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &width, &height, &sampling,
                              &space));
    if (width <= 0 || height <= 0 || uint64_t(width) * uint64_t(height) > kMaxTexturePixels)
        refuse(fmt::format("a JPEG of {} x {} pixels; at most 2^26 are read", width, height));
    if (space == TJCS_CMYK || space == TJCS_YCCK)
        refuse("a JPEG of printing inks (CMYK); save it as RGB");
    Picture picture{width, height, {}};
    picture.pixels.resize(size_t(width) * size_t(height));
    // A file of very many scans would take hours for few bytes.
    check(tjDecompress2(decoder.get(), bytes.data(), bytes.size(), picture.pixels.data()->data(),
                        width, 0, height, TJPF_RGBA, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS));
    return picture;
}

}  // namespace voxelume
