// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/png.hpp"

#include <spng.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "runtime/base/atomic_file.hpp"
#include "runtime/base/input_file.hpp"
#include "runtime/base/stamp.hpp"

namespace voxelume {

namespace {

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

double linear_from_srgb(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

/// Returns thresholds[k], the linear value at which code k ends and k + 1 begins.
std::array<float, 255> make_thresholds() {
    std::array<float, 255> thresholds{};
    for (size_t k = 0; k < thresholds.size(); ++k)
        thresholds[k] =
            static_cast<float>(linear_from_srgb((static_cast<double>(k) + 0.5) / 255.0));
    return thresholds;
}

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

uint8_t alpha_code(float alpha) {
    return static_cast<uint8_t>(std::lround(std::clamp(alpha, 0.0f, 1.0f) * 255.0f));
}

Picture develop(const Image& image, const ColorPlanes& planes, const PngOptions& options) {
    const float gain = std::exp2(options.exposure);
    Picture picture{image.width, image.height, {}};
    picture.pixels.resize(planes.red.size());
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        const float raw = planes.alpha ? (*planes.alpha)[i] : 1.0f;
        const float alpha = std::isnan(raw) ? 1.0f : raw;
        glm::vec3 color = planes.color(i);
        if (!options.keep_alpha)
            color += (1.0f - alpha) * options.background;
        else if (alpha > 0.0f)
            color /= alpha;
        color *= gain;
        picture.pixels[i] = {srgb_code(color.r), srgb_code(color.g), srgb_code(color.b),
                             options.keep_alpha ? alpha_code(alpha) : uint8_t{255}};
    }
    return picture;
}

/// The picture's bytes as PNG stores them: four a pixel, or three without alpha.
std::vector<uint8_t> pack_pixels(const Picture& picture, bool with_alpha) {
    const size_t channels = with_alpha ? 4 : 3;
    std::vector<uint8_t> bytes;
    bytes.reserve(picture.pixels.size() * channels);
    for (const std::array<uint8_t, 4>& pixel : picture.pixels)
        bytes.insert(bytes.end(), pixel.begin(), pixel.begin() + static_cast<long>(channels));
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

void encode(ByteSink& file, const Picture& picture, const PngOptions& options) {
    const bool with_alpha = options.keep_alpha;
    const std::vector<uint8_t> bytes = pack_pixels(picture, with_alpha);
    const Context context(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
    check_encoding(file, spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
    spng_ihdr header{};
    header.width = static_cast<uint32_t>(picture.width);
    header.height = static_cast<uint32_t>(picture.height);
    header.bit_depth = 8;
    header.color_type = with_alpha ? SPNG_COLOR_TYPE_TRUECOLOR_ALPHA : SPNG_COLOR_TYPE_TRUECOLOR;
    check_encoding(file, spng_set_ihdr(context.get(), &header));
    constexpr uint8_t kPerceptual = 0;
    check_encoding(file, spng_set_srgb(context.get(), kPerceptual));
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

void encode(ByteSink& file, const Image& image, const PngOptions& options) {
    const ColorPlanes planes = find_planes(file, image);
    encode(file, develop(image, planes, options), options);
}

}  // namespace

uint8_t srgb_code(float linear) {
    // A search in the thresholds rounds exactly, and gives equal codes on every machine; pow at
    // each pixel does neither.
    static const std::array<float, 255> thresholds = make_thresholds();
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
