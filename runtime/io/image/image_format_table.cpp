// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/image_format_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runtime/base/main_memory.hpp"
#include "runtime/io/image/color_pictures.hpp"
#include "runtime/io/image/picture.hpp"

namespace voxelume {
namespace {

void write_channels(const std::filesystem::path& path, const Image& image,
                    const ImageStorage& how) {
    write_exr(path, image, how.exr, how.attributes);
}

std::unique_ptr<ImageRows> begin_channels(const std::filesystem::path& path,
                                          const ImageWindow& window, const ImageStorage& how) {
    return exr_rows(path, window, how.exr, how.attributes);
}

std::string encode_channels(const Image& image, const ImageStorage& how) {
    return exr_bytes(image, how.exr, how.attributes);
}

void write_codes(const std::filesystem::path& path, const Image& image, const ImageStorage& how) {
    write_png(path, image, how.png);
}

std::unique_ptr<ImageRows> begin_codes(const std::filesystem::path& path, const ImageWindow& window,
                                       const ImageStorage& how) {
    return png_rows(path, window, how.png);
}

std::string encode_codes(const Image& image, const ImageStorage& how) {
    return png_bytes(image, how.png);
}

/// A picture's codes as parts of 255: what is compared is what is seen.
Image read_codes(const std::filesystem::path& path) {
    const Picture picture = read_png(path);
    require_room(path, fmt::format("an image of {}x{} pixels", picture.width, picture.height),
                 16 * double(picture.pixels.size()));
    Image image{picture.width, picture.height, {}, {}, {}};
    constexpr const char* kNames[] = {"R", "G", "B", "A"};
    for (size_t channel = 0; channel < 4; ++channel) {
        std::vector<float> values;
        values.reserve(picture.pixels.size());
        for (const auto& pixel : picture.pixels)
            values.push_back(static_cast<float>(pixel[channel]) / 255.0f);
        image.planes[kNames[channel]] = std::move(values);
    }
    return image;
}

Picture parse_png_texture(std::span<const uint8_t> bytes, const std::filesystem::path& name) {
    return parse_png(bytes, name, kMaxTexturePixels);
}

// clang-format off
constexpr std::array<ImageFormatEntry, 4> kImageFormats = {{
    {".exr", "\x76\x2f\x31\x01", true, write_channels, begin_channels, encode_channels, read_exr,
     read_exr_colors, read_exr_size, nullptr},
    {".hdr", "#?", false, nullptr, nullptr, nullptr, nullptr,
     read_radiance_colors, read_radiance_size, nullptr},
    {".png", "\x89PNG", false, write_codes, begin_codes, encode_codes, read_codes,
     read_png_colors, read_png_size, parse_png_texture},
    {".jpg", "\xff\xd8\xff", false, nullptr, nullptr, nullptr, nullptr,
     nullptr, nullptr, parse_jpeg},
}};
// clang-format on

}  // namespace

std::span<const ImageFormatEntry> image_format_table() {
    return kImageFormats;
}

const ImageFormatEntry* image_format_of(std::string_view ending) {
    const auto* const row = std::ranges::find(kImageFormats, ending, &ImageFormatEntry::ending);
    return row == kImageFormats.end() ? nullptr : row;
}

const ImageFormatEntry* image_format_of(std::span<const uint8_t> bytes) {
    const auto* const row = std::ranges::find_if(kImageFormats, [&](const ImageFormatEntry& entry) {
        return bytes.size() >= entry.start.size() &&
               std::ranges::equal(bytes.first(entry.start.size()), entry.start,
                                  [](uint8_t a, char b) { return a == uint8_t(b); });
    });
    return row == kImageFormats.end() ? nullptr : row;
}

}  // namespace voxelume
