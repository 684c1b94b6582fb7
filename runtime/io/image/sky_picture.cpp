// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/sky_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/srgb.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/image/png_values.hpp"

namespace voxelume {
namespace {

enum class Format : uint8_t { exr, radiance, png };

Format format_of(const std::filesystem::path& path) {
    const std::string ending = ending_of(path);
    if (ending == ".exr") return Format::exr;
    if (ending == ".hdr") return Format::radiance;
    if (ending == ".png") return Format::png;
    throw Error(ErrorKind::input, "{}: a sky's picture has to be .exr, .hdr or .png",
                SourcePlace(path.string()));
}

std::vector<uint8_t> bytes_of(const InputFile& file, uint64_t maximum) {
    std::vector<uint8_t> bytes(std::min(file.size(), maximum));
    file.read(0, bytes.data(), bytes.size());
    return bytes;
}

ColorPicture read_exr_colors(const std::filesystem::path& path) {
    const Image image = read_exr(path);
    const bool is_grey = !image.planes.contains("R") && image.planes.contains("Y");
    std::array<const Plane<float>*, 3> planes{};
    for (size_t c = 0; c < 3; ++c) {
        const auto plane = image.planes.find(is_grey ? "Y" : std::string(1, "RGB"[c]));
        if (plane == image.planes.end())
            InputFile(path).refuse("has neither channels R, G and B nor a channel Y");
        planes[c] = &plane->second;
    }
    ColorPicture picture{image.width, image.height, {}};
    picture.values.reserve(planes[0]->size() * 3);
    for (size_t i = 0; i < planes[0]->size(); ++i)
        for (const Plane<float>* plane : planes) picture.values.push_back((*plane)[i]);
    return picture;
}

ColorPicture read_png_colors(const std::filesystem::path& path) {
    const std::vector<float> levels = srgb_levels();
    const Picture png = read_png(path);
    ColorPicture picture{png.width, png.height, {}};
    picture.values.reserve(png.pixels.size() * 3);
    for (const auto& pixel : png.pixels)
        for (size_t c = 0; c < 3; ++c) picture.values.push_back(levels[pixel[c]]);
    return picture;
}

ColorPicture read_colors(const std::filesystem::path& path, uint64_t max_pixels) {
    switch (format_of(path)) {
        case Format::exr:
            return read_exr_colors(path);
        case Format::radiance: {
            const InputFile file(path);
            return parse_radiance(bytes_of(file, 5 * max_pixels + (1 << 20)), path, max_pixels);
        }
        case Format::png:
            break;
    }
    return read_png_colors(path);
}

glm::ivec2 size_of(const std::filesystem::path& path) {
    switch (format_of(path)) {
        case Format::exr: {
            const ExrHeader header = read_exr_header(path);
            return {header.width, header.height};
        }
        case Format::radiance: {
            const InputFile file(path);
            return parse_radiance_size(bytes_of(file, 1 << 20), path);
        }
        case Format::png:
            break;
    }
    const PngShape shape = read_png_shape(path);
    return {shape.width, shape.height};
}

}  // namespace

glm::ivec2 sky_picture_size(const std::filesystem::path& path, int64_t max_pixels) {
    const glm::ivec2 size = size_of(path);
    if (int64_t{size.x} * size.y > max_pixels)
        InputFile(path).refuse(fmt::format("has {} x {} pixels, and a sky's picture at most {}",
                                           size.x, size.y, max_pixels));
    return size;
}

ColorPicture read_sky_picture(const std::filesystem::path& path, int64_t max_pixels) {
    sky_picture_size(path, max_pixels);
    ColorPicture picture = read_colors(path, uint64_t(max_pixels));
    constexpr float kBrightest = 1e9f;
    for (float& value : picture.values)
        value = value > 0 ? std::min(value, kBrightest) : 0.0f;  // not a number: 0
    return picture;
}

}  // namespace voxelume
