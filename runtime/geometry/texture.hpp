// SPDX-License-Identifier: Apache-2.0
// The images that meshes wear.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

namespace voxelume {

/// An entry of Mesh::group_textures for a group without a texture.
inline constexpr uint32_t kNoTexture = 0xFFFFFFFFu;

/// The continuation of a texture outside of its image; the numbers are those of the kernel.
enum class TextureWrap : uint8_t { repeat, mirror, clamp };

/// An image and its levels for distant views, each of half the size of the one before.
struct TextureImage {
    int width = 0, height = 0;
    /// Level after level, each in rows from its upper left texel: 0xAABBGGRR, colours in sRGB.
    std::vector<uint32_t> texels;
};

/// The size of a level of an image along one axis: level 0 is the image, and each further one has
/// half of the texels, rounded down, but never fewer than 1.
inline int level_size(int size, int level) {
    return std::max(size >> level, 1);
}

/// The number of an image's levels: the last one is of one texel.
inline int level_count(const TextureImage& image) {
    return std::bit_width(unsigned(std::max(image.width, image.height)));
}

/// The texels of all levels.
inline uint64_t texel_count(const TextureImage& image) {
    uint64_t count = 0;
    for (int level = 0; level < level_count(image); ++level)
        count +=
            uint64_t(level_size(image.width, level)) * uint64_t(level_size(image.height, level));
    return count;
}

/// Values of Texture::alpha; between them, a texture isn't there where its alpha in 255ths is
/// below the value. The numbers are those of the kernel.
inline constexpr uint32_t kAlphaOpaque = 0, kAlphaBlend = 256;

/// The maps of a texture, in the order of the kernel's numbers: roughness (green) and metalness
/// (blue), and emission.
inline constexpr size_t kGlossMap = 0, kEmissionMap = 1, kMapCount = 2;

/// A texture that multiplies a value of the material other than its colour, on the same triangles.
struct TextureMap {
    uint32_t texture = kNoTexture;  ///< its number in the mesh
    /// Position (u, v) of the texture that has the map is (a u + b v + c, d u + e v + f) of the
    /// map.
    std::array<float, 6> transform = {1, 0, 0, 0, 1, 0};
};

struct Texture {
    std::shared_ptr<const TextureImage> image;  ///< never null
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    uint32_t alpha = kAlphaOpaque;  ///< meaning of the texels' alpha
    std::array<TextureMap, kMapCount> maps{};
    bool is_of_vertices = false;  ///< no picture: it has the alpha of vertices

    bool has_maps() const {
        return std::ranges::any_of(maps, [](const auto& m) { return m.texture != kNoTexture; });
    }
};

}  // namespace voxelume
