// SPDX-License-Identifier: Apache-2.0
// PNG -> 8-bit picture, or the stored numbers, by libspng.
#include <fmt/format.h>
#include <spng.h>

#include <algorithm>
#include <memory>

#include "runtime/base/error.hpp"
#include "runtime/io/image_codec/picture_decoder.hpp"

namespace voxelume {
namespace {

/// The bytes of a PNG, and its header.
class PngDecoder {
  public:
    PngDecoder(std::span<const uint8_t> bytes, const std::filesystem::path& name)
        : name_(name), context_(spng_ctx_new(0), spng_ctx_free) {
        // libspng accepts a file once it has the pixels. Only the last chunk shows that nothing is
        // missing.
        constexpr std::array<uint8_t, 8> kEnd = {'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
        if (std::search(bytes.begin(), bytes.end(), kEnd.begin(), kEnd.end()) == bytes.end())
            refuse("not a whole PNG: its end is missing");
        check(spng_set_chunk_limits(context_.get(), size_t{1} << 26, size_t{1} << 26));
        check(spng_set_png_buffer(context_.get(), bytes.data(), bytes.size()));
        check(spng_get_ihdr(context_.get(), &header_));
        // Deflate compresses at most 1032:1, and a pixel takes at least an eighth of a byte.
        is_possible_ = pixels() / 8 / 1032 <= bytes.size();
    }

    const spng_ihdr& header() const { return header_; }
    uint64_t pixels() const { return uint64_t{header_.width} * header_.height; }

    /// Throws for more than `max_pixels`, which the message calls `limit`.
    void check_size(uint64_t max_pixels, const std::string& limit) const {
        if (pixels() > max_pixels || !is_possible_)
            refuse(fmt::format("declares {} x {} pixels, which it can't hold or which are above {}",
                               header_.width, header_.height, limit));
    }
    void decode(void* values, size_t size, int format, int flags) const {
        check(spng_decode_image(context_.get(), values, size, format, flags));
    }
    [[noreturn]] void refuse(const std::string& reason) const {
        throw Error(ErrorKind::input, "{}: {}", SourcePlace(name_.string()), reason);
    }

  private:
    void check(int code) const {
        if (code != 0) refuse(fmt::format("not a readable PNG: {}", spng_strerror(code)));
    }

    const std::filesystem::path& name_;
    std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context_;
    spng_ihdr header_{};
    bool is_possible_ = false;
};

PngShape shape_of(const spng_ihdr& header) {
    const bool is_grey = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE;
    const bool has_alpha = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ||
                           header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
    return {int(header.width), int(header.height), is_grey && header.bit_depth == 16 ? 16 : 8,
            is_grey     ? 1
            : has_alpha ? 4
                        : 3};
}

}  // namespace

Picture decode_png(std::span<const uint8_t> bytes, const std::filesystem::path& name,
                   uint64_t max_pixels, const PictureRoom& room) {
    const PngDecoder png(bytes, name);
    png.check_size(max_pixels, std::to_string(max_pixels));
    Picture picture{int(png.header().width), int(png.header().height), {}};
    room(picture.width, picture.height);
    picture.pixels.resize(png.pixels());
    png.decode(picture.pixels.data(), png.pixels() * 4, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS);
    return picture;
}

PngShape decode_png_shape(std::span<const uint8_t> bytes, const std::filesystem::path& name) {
    const PngDecoder png(bytes, name);
    png.check_size(kMaxSlicePixels, "2^26");
    return shape_of(png.header());
}

std::vector<std::byte> decode_png_values(std::span<const uint8_t> bytes,
                                         const std::filesystem::path& name, const PngShape& shape) {
    const PngDecoder png(bytes, name);
    png.check_size(kMaxSlicePixels, "2^26");
    const PngShape found = shape_of(png.header());
    if (found != shape)
        png.refuse(
            fmt::format("is a slice of {} x {} pixels of {} bits, and the first has {} x "
                        "{} of {}; slices of a stack are alike",
                        found.width, found.height, found.bits * found.channels, shape.width,
                        shape.height, shape.bits * shape.channels));
    const int format = shape.channels == 4   ? SPNG_FMT_RGBA8
                       : shape.channels == 3 ? SPNG_FMT_RGB8
                       : shape.bits == 16    ? SPNG_FMT_PNG
                                             : SPNG_FMT_G8;
    std::vector<std::byte> values(shape.bytes());
    png.decode(values.data(), values.size(), format, 0);
    return values;
}

}  // namespace voxelume
