// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/emission_maps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "kernels/shared/texture.h"
#include "runtime/geometry/texture.hpp"
#include "runtime/image/srgb.hpp"
#include "runtime/io/image/png.hpp"

namespace voxelume {
namespace {

/// A texture coordinate wrapped to 0..1.
double wrapped(double at, uint32_t wrap) {
    if (wrap == VXL_TEXTURE_WRAP_CLAMP) return std::clamp(at, 0.0, 1.0);
    if (wrap == VXL_TEXTURE_WRAP_MIRROR) return std::abs(at - 2 * std::round(at / 2));
    return at - std::floor(at);
}

/// A level of a texture.
struct Level {
    const uint32_t* texels;
    int width, height;
    uint32_t wrap;

    uint32_t texel_at(const glm::dvec2& uv) const {
        const auto number = [](double at, uint32_t how, int size) {
            return std::clamp(int(wrapped(at, how & VXL_TEXTURE_WRAP_MASK) * size), 0, size - 1);
        };
        return texels[size_t(number(uv.y, wrap >> VXL_TEXTURE_WRAP_V_SHIFT, height)) *
                          size_t(width) +
                      size_t(number(uv.x, wrap, width))];
    }
};

/// The first level on which a part of a texture covers at most `max_texels`.
Level level_of(const uint32_t* head, double part, double max_texels) {
    Level level{head + VXL_TEXTURE_HEAD, int(head[0]), int(head[1]), head[2]};
    while ((level.width > 1 || level.height > 1) &&
           part * level.width * level.height > max_texels) {
        level.texels += size_t(level.width) * size_t(level.height);
        level.width = level_size(level.width, 1);
        level.height = level_size(level.height, 1);
    }
    return level;
}

}  // namespace

EmissionMaps::EmissionMaps(const EmissiveSource& source) {
    const Pyramid& pyramid = source.pyramid;
    if (!pyramid.texture_maps) return;
    worn_ = pyramid.triangle_textures.read(size_t(source.first_triangle) * VXL_WORN_WORDS,
                                           size_t(source.triangle_count) * VXL_WORN_WORDS);
    textures_ = pyramid.textures.read();
}

size_t EmissionMaps::map_of(size_t i) const {
    if (worn_.empty()) return 0;
    const uint32_t texture = worn_[i * VXL_WORN_WORDS + VXL_WORN_TEXTURE];
    if (texture == VXL_NO_TEXTURE || !(textures_[texture + 2] & VXL_TEXTURE_HAS_MAPS)) return 0;
    const uint32_t record = texture - (VXL_MAP_COUNT - VXL_MAP_EMISSION) * VXL_MAP_WORDS;
    const uint32_t offset = textures_[record + VXL_MAP_OFFSET];
    return offset == 0 ? 0 : uint32_t(texture + offset);
}

EmissionMaps::Uvs EmissionMaps::uvs(size_t i) const {
    if (map_of(i) == 0) return {};
    const uint32_t* const worn = &worn_[i * VXL_WORN_WORDS];
    const uint32_t* const map =
        &textures_[worn[VXL_WORN_TEXTURE] - (VXL_MAP_COUNT - VXL_MAP_EMISSION) * VXL_MAP_WORDS +
                   VXL_MAP_TRANSFORM];
    const auto number = [&](int k) { return double(std::bit_cast<float>(map[k])); };
    Uvs found;
    for (size_t corner = 0; corner < 3; ++corner) {
        const double u = double(std::bit_cast<float>(worn[VXL_WORN_UVS + 2 * corner]));
        const double v = double(std::bit_cast<float>(worn[VXL_WORN_UVS + 2 * corner + 1]));
        found[corner] = {number(0) * u + number(1) * v + number(2),
                         number(3) * u + number(4) * v + number(5)};
    }
    return found;
}

glm::dvec3 EmissionMaps::mean(size_t i, const Uvs& part) const {
    const size_t map = map_of(i);
    if (map == 0) return glm::dvec3(1);
    constexpr int kRows = 6;  // the part is sampled at the middles of kRows^2 equal triangles
    const glm::dvec2 a = part[1] - part[0], b = part[2] - part[0];
    const double area = std::abs(a.x * b.y - a.y * b.x) / 2;
    static const std::vector<float> linear = srgb_levels();
    const Level level = level_of(&textures_[map], area, double(kRows * kRows) / 2);
    glm::dvec3 sum(0);
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < 2 * row + 1; ++column) {
            // Triangles in a row point alternately up and down.
            const double down = column % 2 == 1 ? 1.0 / 3 : 0;
            const double y = (row + 2.0 / 3 - down) / kRows;
            const int pair = column / 2;
            const double x = (pair + 1.0 / 3 + down) / kRows;
            const uint32_t texel = level.texel_at(part[0] + (y - x) * a + x * b);
            sum += glm::dvec3(linear[texel & 255], linear[texel >> 8 & 255],
                              linear[texel >> 16 & 255]);
        }
    return sum / double(kRows * kRows);
}

}  // namespace voxelume
