// SPDX-License-Identifier: Apache-2.0
// JPEG -> 8-bit picture, by libjpeg-turbo.
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "runtime/base/error.hpp"
#include "runtime/io/image_codec/picture_decoder.hpp"
#include "runtime/io/image_codec/picture_size.hpp"

namespace voxelume {
namespace {

struct CloseDecoder {
    void operator()(void* decoder) const { tjDestroy(decoder); }
};

/// True if a JPEG has the marker of Adobe's programs, which store inks inverted.
bool has_adobe_marker(std::span<const uint8_t> bytes) {
    constexpr uint8_t kApp14 = 0xEE;
    constexpr std::string_view kName = "Adobe";
    return any_jpeg_segment(bytes, [&](uint8_t kind, std::span<const uint8_t> content) {
        return kind == kApp14 && content.size() >= kName.size() &&
               std::equal(kName.begin(), kName.end(), content.begin());
    });
}

/// Replaces inks by the colour that white light has after cyan, magenta and yellow over black.
void light_of_inks(Picture& picture, bool is_inverted) {
    for (auto& pixel : picture.pixels) {
        std::array<unsigned, 4> left{};  // of 255, beginning with white
        for (size_t i = 0; i < 4; ++i) left[i] = is_inverted ? pixel[i] : 255u - pixel[i];
        for (size_t i = 0; i < 3; ++i) pixel[i] = uint8_t((left[i] * left[3] + 127) / 255);
        pixel[3] = 255;
    }
}

}  // namespace

Picture decode_jpeg(std::span<const uint8_t> bytes, const std::filesystem::path& name) {
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
    const bool has_inks = space == TJCS_CMYK || space == TJCS_YCCK;
    Picture picture{width, height, {}};
    picture.pixels.resize(size_t(width) * size_t(height));
    // A file of very many scans would take hours for few bytes.
    check(tjDecompress2(decoder.get(), bytes.data(), bytes.size(), picture.pixels.data()->data(),
                        width, 0, height, has_inks ? TJPF_CMYK : TJPF_RGBA,
                        TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS));
    if (has_inks) light_of_inks(picture, has_adobe_marker(bytes));
    return picture;
}

}  // namespace voxelume
