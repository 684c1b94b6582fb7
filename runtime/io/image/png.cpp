// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/png.hpp"

#include <fmt/format.h>
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
#include "runtime/base/main_memory.hpp"
#include "runtime/image/srgb.hpp"

namespace voxelume {

namespace {

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

}  // namespace

uint8_t srgb_code(float linear) {
    // A search in the thresholds rounds exactly, and gives equal codes on every machine; pow at
    // each pixel does neither.
    static const std::vector<float> thresholds = srgb_thresholds(255);
    if (std::isnan(linear)) return 0;
    return static_cast<uint8_t>(std::upper_bound(thresholds.begin(), thresholds.end(), linear) -
                                thresholds.begin());
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
    require_room(name, fmt::format("a picture of {}x{} pixels", header.width, header.height),
                 4 * double(pixels));
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
    require_room(path, "the file", double(file.size()));
    std::vector<uint8_t> bytes(file.size());
    file.read(0, bytes.data(), bytes.size());
    return parse_png(bytes, path, kMaxPixels);
}

}  // namespace voxelume
