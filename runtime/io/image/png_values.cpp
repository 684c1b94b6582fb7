// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/png_values.hpp"

#include <fmt/format.h>
#include <spng.h>

#include <memory>
#include <string_view>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxSlicePixels = uint64_t{1} << 26;

using Decoder = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

/// A PNG in memory, and its header.
class PngFile {
  public:
    explicit PngFile(const std::filesystem::path& path)
        : file_(path), decoder_(spng_ctx_new(0), spng_ctx_free) {
        // A number of 16 bits takes two bytes, so a larger file can't be within the limit.
        if (file_.size() > 9 * kMaxSlicePixels) file_.refuse("is too large for a slice");
        bytes_.resize(file_.size());
        file_.read(0, bytes_.data(), bytes_.size());
        // libspng accepts a file once it has the pixels. Only the last chunk shows that nothing is
        // missing.
        constexpr std::string_view kEnd("IEND\xae\x42\x60\x82", 8);
        if (std::string_view(bytes_.data(), bytes_.size()).find(kEnd) == kEnd.npos)
            file_.refuse("not a whole PNG: its end is missing");
        check(spng_set_chunk_limits(decoder_.get(), size_t{1} << 26, size_t{1} << 26));
        check(spng_set_png_buffer(decoder_.get(), bytes_.data(), bytes_.size()));
        check(spng_get_ihdr(decoder_.get(), &header_));
        // Deflate compresses at most 1032:1, and a pixel takes at least an eighth of a byte.
        const uint64_t pixels = uint64_t{header_.width} * header_.height;
        if (pixels > kMaxSlicePixels || pixels / 8 / 1032 > bytes_.size())
            file_.refuse(
                fmt::format("declares {} x {} pixels, which it can't hold or which are above 2^26",
                            header_.width, header_.height));
    }

    PngShape shape() const {
        const bool is_grey = header_.color_type == SPNG_COLOR_TYPE_GRAYSCALE;
        const bool has_alpha = header_.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ||
                               header_.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
        return {int(header_.width), int(header_.height),
                is_grey && header_.bit_depth == 16 ? 16 : 8,
                is_grey     ? 1
                : has_alpha ? 4
                            : 3};
    }

    std::vector<std::byte> values() const {
        const PngShape shape = this->shape();
        const int format = shape.channels == 4   ? SPNG_FMT_RGBA8
                           : shape.channels == 3 ? SPNG_FMT_RGB8
                           : shape.bits == 16    ? SPNG_FMT_PNG
                                                 : SPNG_FMT_G8;
        std::vector<std::byte> values(shape.bytes());
        check(spng_decode_image(decoder_.get(), values.data(), values.size(), format, 0));
        return values;
    }

    [[noreturn]] void refuse(const std::string& sentence) const { file_.refuse(sentence); }

  private:
    void check(int code) const {
        if (code != 0) file_.refuse(fmt::format("not a readable PNG: {}", spng_strerror(code)));
    }

    InputFile file_;
    Decoder decoder_;
    std::vector<char> bytes_;
    spng_ihdr header_{};
};

}  // namespace

PngShape read_png_shape(const std::filesystem::path& path) {
    return PngFile(path).shape();
}

std::vector<std::byte> read_png_values(const std::filesystem::path& path, const PngShape& shape) {
    const PngFile file(path);
    const PngShape found = file.shape();
    if (found != shape)
        file.refuse(
            fmt::format("is a slice of {} x {} pixels of {} bits, and the first has {} x "
                        "{} of {}; slices of a stack are alike",
                        found.width, found.height, found.bits * found.channels, shape.width,
                        shape.height, shape.bits * shape.channels));
    return file.values();
}

}  // namespace voxelume
