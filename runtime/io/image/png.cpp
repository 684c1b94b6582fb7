// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/png.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/image/srgb.hpp"
#include "runtime/io/image_codec/image_codec.hpp"

namespace voxelume {

namespace {

/// Throws where memory has no room for a picture's pixels.
PictureRoom room_for(const std::filesystem::path& name) {
    return [&name](int width, int height) {
        require_room(name, fmt::format("a picture of {}x{} pixels", width, height),
                     4.0 * width * height);
    };
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

Picture parse_png(std::span<const uint8_t> bytes, const std::filesystem::path& name,
                  uint64_t max_pixels) {
    if (decodes_apart())
        return ask_picture(PictureKind::png, bytes, name, max_pixels, room_for(name));
    return decode_png(bytes, name, max_pixels, room_for(name));
}

std::vector<Picture> parse_pngs(std::span<const std::span<const uint8_t>> pictures,
                                const std::filesystem::path& name, uint64_t max_pixels) {
    if (decodes_apart()) return ask_pngs(pictures, name, max_pixels);
    std::vector<Picture> decoded;
    decoded.reserve(pictures.size());
    for (const std::span<const uint8_t> picture : pictures)
        decoded.push_back(parse_png(picture, name, max_pixels));
    return decoded;
}

Picture read_png(const std::filesystem::path& path) {
    constexpr uint64_t kMaxPixels = uint64_t{1} << 28;
    const InputFile file(path);
    // An 8-bit RGBA pixel takes at most 8 bytes as 16-bit samples, so a larger file can't be within
    // the limit.
    if (file.size() > 9 * kMaxPixels) file.refuse("is too large for a PNG that voxelume reads");
    require_room(path, "the file", double(file.size()));
    if (decodes_apart()) return ask_picture(PictureKind::png, file, kMaxPixels, room_for(path));
    return decode_png(file.bytes(), path, kMaxPixels, room_for(path));
}

}  // namespace voxelume
