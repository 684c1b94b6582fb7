// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/color_pictures.hpp"

#include <algorithm>
#include <array>

#include "runtime/base/files/input_file.hpp"
#include "runtime/image/srgb.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/image/png_values.hpp"

namespace voxelume {
namespace {

std::vector<uint8_t> first_bytes(const InputFile& file, uint64_t maximum) {
    std::vector<uint8_t> bytes(std::min(file.size(), maximum));
    file.read(0, bytes.data(), bytes.size());
    return bytes;
}

}  // namespace

ColorPicture read_exr_colors(const std::filesystem::path& path, uint64_t) {
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

ColorPicture read_radiance_colors(const std::filesystem::path& path, uint64_t max_pixels) {
    const InputFile file(path);
    return parse_radiance(first_bytes(file, 5 * max_pixels + (1 << 20)), path, max_pixels);
}

ColorPicture read_png_colors(const std::filesystem::path& path, uint64_t) {
    const std::vector<float> levels = srgb_levels();
    const Picture png = read_png(path);
    ColorPicture picture{png.width, png.height, {}};
    picture.values.reserve(png.pixels.size() * 3);
    for (const auto& pixel : png.pixels)
        for (size_t c = 0; c < 3; ++c) picture.values.push_back(levels[pixel[c]]);
    return picture;
}

glm::ivec2 read_exr_size(const std::filesystem::path& path) {
    const ExrHeader header = read_exr_header(path);
    return {header.width, header.height};
}

glm::ivec2 read_radiance_size(const std::filesystem::path& path) {
    const InputFile file(path);
    return parse_radiance_size(first_bytes(file, 1 << 20), path);
}

glm::ivec2 read_png_size(const std::filesystem::path& path) {
    const PngShape shape = read_png_shape(path);
    return {shape.width, shape.height};
}

}  // namespace voxelume
