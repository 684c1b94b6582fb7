// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/png.hpp"

#include <spng.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/image/srgb.hpp"

namespace voxelume {

namespace {

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

/// The planes that a picture needs, with defaults for missing ones.
struct ColorPlanes {
    const Plane<float>& red;
    const Plane<float>& green;
    const Plane<float>& blue;
    const Plane<float>* alpha;  ///< null for an opaque image

    glm::vec3 color(size_t i) const { return {red[i], green[i], blue[i]}; }
};

ColorPlanes find_planes(ByteSink& file, const Image& image) {
    if (image.width <= 0 || image.height <= 0) file.fail("the image has no pixels");
    const size_t pixels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
    for (const char* name : {"R", "G", "B"}) {
        const auto plane = image.planes.find(name);
        if (plane == image.planes.end() || plane->second.size() != pixels)
            file.fail(fmt::format("the image has no plane {} of its size", name));
    }
    const auto alpha = image.planes.find("A");
    const bool has_alpha = alpha != image.planes.end() && alpha->second.size() == pixels;
    return {image.planes.at("R"), image.planes.at("G"), image.planes.at("B"),
            has_alpha ? &alpha->second : nullptr};
}

/// The codes of a picture's channels, `channels` to a pixel.
std::vector<uint16_t> develop(const ColorPlanes& planes, const PngOptions& options) {
    const float gain = std::exp2(options.exposure);
    const ColorCodes codes(options.view_transform, options.bits);
    std::vector<uint16_t> values;
    values.reserve(planes.red.size() * (options.keep_alpha ? 4 : 3));
    for (size_t i = 0; i < planes.red.size(); ++i) {
        const float raw = planes.alpha ? (*planes.alpha)[i] : 1.0f;
        const float alpha = std::isnan(raw) ? 1.0f : raw;
        glm::vec3 color = planes.color(i);
        if (!options.keep_alpha)
            color += (1.0f - alpha) * options.background;
        else if (alpha > 0.0f)
            color /= alpha;
        for (const uint16_t code : codes(color * gain)) values.push_back(code);
        if (!options.keep_alpha) continue;
        const float maximum = codes.maximum();
        values.push_back(uint16_t(std::lround(std::clamp(alpha, 0.0f, 1.0f) * maximum)));
    }
    return values;
}

/// The bytes of codes, in this machine's order where they have two.
std::vector<uint8_t> bytes_of(const std::vector<uint16_t>& codes, int bits) {
    if (bits == 8) return {codes.begin(), codes.end()};
    std::vector<uint8_t> bytes(codes.size() * 2);
    std::memcpy(bytes.data(), codes.data(), bytes.size());
    return bytes;
}

void check_encoding(ByteSink& file, int code) {
    if (code != 0) file.fail(spng_strerror(code));
}

/// Texts of pictures come before their pixels. The library reads `stamp` when it encodes these.
void put_stamp(ByteSink& file, spng_ctx* context, std::string& stamp) {
    if (stamp.empty()) return;
    spng_text text{};
    text.type = SPNG_TEXT;
    constexpr std::string_view kKeyword = "Comment";
    kKeyword.copy(text.keyword, kKeyword.size());
    text.text = stamp.data();
    text.length = stamp.size();
    check_encoding(file, spng_set_text(context, &text, 1));
}

/// Says what the codes stand for: sRGB, or with a gamma of 1 light itself.
void put_meaning(ByteSink& file, spng_ctx* context, ViewTransform transform) {
    constexpr uint8_t kPerceptual = 0;
    if (transform == ViewTransform::none)
        check_encoding(file, spng_set_gama(context, 1.0));
    else
        check_encoding(file, spng_set_srgb(context, kPerceptual));
}

void encode(ByteSink& file, const Image& image, const PngOptions& options) {
    const bool with_alpha = options.keep_alpha;
    const std::vector<uint8_t> bytes =
        bytes_of(develop(find_planes(file, image), options), options.bits);
    const Context context(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
    check_encoding(file, spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
    spng_ihdr header{};
    header.width = static_cast<uint32_t>(image.width);
    header.height = static_cast<uint32_t>(image.height);
    header.bit_depth = static_cast<uint8_t>(options.bits);
    header.color_type = with_alpha ? SPNG_COLOR_TYPE_TRUECOLOR_ALPHA : SPNG_COLOR_TYPE_TRUECOLOR;
    check_encoding(file, spng_set_ihdr(context.get(), &header));
    put_meaning(file, context.get(), options.view_transform);
    std::string stamp = options.stamp;
    put_stamp(file, context.get(), stamp);
    check_encoding(file, spng_encode_image(context.get(), bytes.data(), bytes.size(), SPNG_FMT_PNG,
                                           SPNG_ENCODE_FINALIZE));
    size_t size = 0;
    int code = 0;
    const std::unique_ptr<void, decltype(&std::free)> png(
        spng_get_png_buffer(context.get(), &size, &code), std::free);
    check_encoding(file, code);
    file.write(png.get(), size);
}

}  // namespace

uint8_t srgb_code(float linear) {
    // A search in the thresholds rounds exactly, and gives equal codes on every machine; pow at
    // each pixel does neither.
    static const std::vector<float> thresholds = srgb_thresholds(255);
    if (std::isnan(linear)) return 0;
    return static_cast<uint8_t>(std::upper_bound(thresholds.begin(), thresholds.end(), linear) -
                                thresholds.begin());
}

void write_png(const std::filesystem::path& path, const Image& image, const PngOptions& options) {
    AtomicFile file(path);
    encode(file, image, options);
    file.commit();
}

std::string png_bytes(const Image& image, const PngOptions& options) {
    MemorySink sink("PNG");
    encode(sink, image, options);
    std::string bytes = sink.take();
    seal(bytes);
    return bytes;
}

Picture parse_png(std::span<const uint8_t> bytes, const std::filesystem::path& name,
                  uint64_t max_pixels) {
    const auto refuse = [&](const std::string& reason) {
        throw Error(ErrorKind::input, "{}: {}", SourcePlace(name.string()), reason);
    };
    const auto check = [&](int code) {
        if (code != 0) refuse(fmt::format("not a readable PNG: {}", spng_strerror(code)));
    };
    // libspng accepts a file once it has the pixels. Only the last chunk shows that nothing is
    // missing.
    constexpr std::array<uint8_t, 8> kEnd = {'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    if (std::search(bytes.begin(), bytes.end(), kEnd.begin(), kEnd.end()) == bytes.end())
        refuse("not a whole PNG: its end is missing");

    const Context context(spng_ctx_new(0), spng_ctx_free);
    check(spng_set_chunk_limits(context.get(), size_t{1} << 26, size_t{1} << 26));
    check(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()));
    spng_ihdr header{};
    check(spng_get_ihdr(context.get(), &header));
    const uint64_t pixels = uint64_t{header.width} * header.height;
    // Deflate compresses at most 1032:1, and a pixel takes at least an eighth of a byte.
    if (pixels > max_pixels || pixels / 8 / 1032 > bytes.size())
        refuse(fmt::format("declares {} x {} pixels, which it can't hold or which are above {}",
                           header.width, header.height, max_pixels));
    Picture picture{static_cast<int>(header.width), static_cast<int>(header.height), {}};
    picture.pixels.resize(pixels);
    check(spng_decode_image(context.get(), picture.pixels.data(), pixels * 4, SPNG_FMT_RGBA8,
                            SPNG_DECODE_TRNS));
    return picture;
}

Picture read_png(const std::filesystem::path& path) {
    constexpr uint64_t kMaxPixels = uint64_t{1} << 28;
    const InputFile file(path);
    // An 8-bit RGBA pixel takes at most 8 bytes as 16-bit samples, so a larger file can't be within
    // the limit.
    if (file.size() > 9 * kMaxPixels) file.refuse("is too large for a PNG that voxelume reads");
    std::vector<uint8_t> bytes(file.size());
    file.read(0, bytes.data(), bytes.size());
    return parse_png(bytes, path, kMaxPixels);
}

}  // namespace voxelume
