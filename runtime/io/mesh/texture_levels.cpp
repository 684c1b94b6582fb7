// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/texture_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec4.hpp>

#include "runtime/io/mesh/mesh_color.hpp"

namespace voxelume {
namespace {

/// The texels of a level that a texel of the next level covers along one axis: at most four, since
/// a texel may cover three where the size was odd.
struct Cover {
    int first = 0, count = 0;
    std::array<float, 4> weights{};
};

std::vector<Cover> covers(int from, int to) {
    std::vector<Cover> all(static_cast<size_t>(to));
    const double step = double(from) / to;
    for (int i = 0; i < to; ++i) {
        Cover& cover = all[size_t(i)];
        const double low = i * step, high = (i + 1) * step;
        cover.first = int(low);
        for (int at = cover.first; at < from && at < high && cover.count < 4; ++at)
            cover.weights[size_t(cover.count++)] =
                float((std::min(high, at + 1.0) - std::max(low, double(at))) / step);
    }
    return all;
}

/// Sums of linear colours and of weights.
struct TexelSum {
    glm::vec4 weighted{0};  ///< colours times alpha, and alpha
    glm::vec3 plain{0};

    void add(uint32_t texel, float weight) {
        static const std::vector<float> linear = srgb_levels();
        const glm::vec3 color(linear[texel & 255], linear[texel >> 8 & 255],
                              linear[texel >> 16 & 255]);
        const float alpha = float(texel >> 24) / 255 * weight;
        weighted += glm::vec4(color * alpha, alpha);
        plain += color * weight;
    }

    uint32_t texel() const {
        const glm::vec3 color = weighted.w > 0 ? glm::vec3(weighted) / weighted.w : plain;
        return uint32_t(srgb_code(color.x)) | uint32_t(srgb_code(color.y)) << 8 |
               uint32_t(srgb_code(color.z)) << 16 |
               uint32_t(std::lround(std::min(weighted.w, 1.0f) * 255)) << 24;
    }
};

/// Sums of numbers.
struct DataSum {
    glm::vec4 sum{0};

    void add(uint32_t texel, float weight) {
        for (int c = 0; c < 4; ++c) sum[c] += float(texel >> 8 * c & 255) * weight;
    }

    uint32_t texel() const {
        uint32_t packed = 0;
        for (int c = 0; c < 4; ++c)
            packed |= uint32_t(std::lround(std::clamp(sum[c], 0.0f, 255.0f))) << 8 * c;
        return packed;
    }
};

/// Appends the level after `level`, whose first texel is number `first`.
template <class Sum>
void append_level(TextureImage& image, int level, size_t first) {
    const int width = level_size(image.width, level);
    const std::vector<Cover> across = covers(width, level_size(image.width, level + 1)),
                             down = covers(level_size(image.height, level),
                                           level_size(image.height, level + 1));
    for (const Cover& row : down)
        for (const Cover& column : across) {
            Sum sum;
            for (int y = 0; y < row.count; ++y)
                for (int x = 0; x < column.count; ++x)
                    sum.add(image.texels[first + size_t(row.first + y) * size_t(width) +
                                         size_t(column.first + x)],
                            row.weights[size_t(y)] * column.weights[size_t(x)]);
            image.texels.push_back(sum.texel());
        }
}

template <class Sum>
TextureImage image_of(const Picture& picture) {
    TextureImage image{picture.width, picture.height, {}};
    image.texels.reserve(texel_count(image));
    for (const auto& p : picture.pixels)
        image.texels.push_back(uint32_t{p[0]} | uint32_t{p[1]} << 8 | uint32_t{p[2]} << 16 |
                               uint32_t{p[3]} << 24);
    size_t first = 0;
    for (int level = 0; level + 1 < level_count(image); ++level) {
        const size_t next = image.texels.size();
        append_level<Sum>(image, level, first);
        first = next;
    }
    return image;
}

}  // namespace

TextureImage with_levels(const Picture& picture) {
    return image_of<TexelSum>(picture);
}

TextureImage with_levels_of_data(const Picture& picture) {
    return image_of<DataSum>(picture);
}

TextureImage one_texel(uint8_t red, uint8_t green, uint8_t blue) {
    return {1, 1, {uint32_t{red} | uint32_t{green} << 8 | uint32_t{blue} << 16 | 0xFF000000u}};
}

}  // namespace voxelume
