// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/sky_picture.hpp"

#include <algorithm>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/image/image_format_table.hpp"

namespace voxelume {
namespace {

const ImageFormatEntry& format_of(const std::filesystem::path& path) {
    const ImageFormatEntry* format = image_format_of(ending_of(path));
    if (format != nullptr && format->read_colors != nullptr) return *format;
    throw Error(ErrorKind::input, "{}: a sky's picture has to be {}", SourcePlace(path.string()),
                image_endings(&ImageFormatEntry::read_colors));
}

}  // namespace

glm::ivec2 sky_picture_size(const std::filesystem::path& path, int64_t max_pixels) {
    const glm::ivec2 size = format_of(path).read_size(path);
    if (int64_t{size.x} * size.y > max_pixels)
        InputFile(path).refuse(fmt::format("has {} x {} pixels, and a sky's picture at most {}",
                                           size.x, size.y, max_pixels));
    return size;
}

ColorPicture read_sky_picture(const std::filesystem::path& path, int64_t max_pixels) {
    sky_picture_size(path, max_pixels);
    ColorPicture picture = format_of(path).read_colors(path, uint64_t(max_pixels));
    constexpr float kBrightest = 1e9f;
    for (float& value : picture.values)
        value = value > 0 ? std::min(value, kBrightest) : 0.0f;  // NaN becomes 0
    return picture;
}

}  // namespace voxelume
