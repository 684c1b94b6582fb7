// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/mesh_maps.hpp"

#include <algorithm>

#include "runtime/io/mesh/mesh_textures.hpp"
#include "runtime/io/mesh/texture_levels.hpp"

namespace voxelume {
namespace {

/// The transform from UVs of the base texture to UVs of a map. v counts downwards in Texture, and
/// upwards in the library.
std::array<float, 6> transform_by(const MtlTexture& map, const MtlTexture& base) {
    glm::dvec2 ratio(0);
    for (int i = 0; i < 2; ++i)
        if (base.scale[i] != 0) ratio[i] = map.scale[i] / base.scale[i];
    const double u = map.offset.x - ratio.x * base.offset.x;
    const double v = 1 - map.offset.y - ratio.y * (1 - base.offset.y);
    return {float(ratio.x), 0, float(u), 0, float(ratio.y), float(v)};
}

using Pixel = std::array<uint8_t, 4>;

/// The pixel of a picture that corresponds to pixel (x, y) of a picture of another size.
const Pixel& pixel_at(const Picture& picture, int x, int y, glm::ivec2 size) {
    const auto at_x = size_t((2 * int64_t{x} + 1) * picture.width / (2 * int64_t{size.x}));
    const auto at_y = size_t((2 * int64_t{y} + 1) * picture.height / (2 * int64_t{size.y}));
    return picture.pixels[at_y * size_t(picture.width) + at_x];
}

/// The red channel at (x, y), or `otherwise` without a picture.
uint8_t value_at(const std::optional<Picture>& picture, int x, int y, glm::ivec2 size,
                 uint8_t otherwise) {
    return picture ? pixel_at(*picture, x, y, size)[0] : otherwise;
}

/// The size of the picture of more texels; 1 x 1 without pictures.
glm::ivec2 larger_size(std::initializer_list<const Picture*> pictures) {
    glm::ivec2 size(1);
    int64_t texels = 0;
    for (const Picture* picture : pictures)
        if (picture && int64_t{picture->width} * picture->height > texels) {
            size = {picture->width, picture->height};
            texels = int64_t{size.x} * size.y;
        }
    return size;
}

const Picture* pointer_to(const std::optional<Picture>& picture) {
    return picture ? &*picture : nullptr;
}

/// Joins roughness in green and metalness in blue, as glTF has them, in the size of the larger
/// picture.
Picture joined(const std::optional<Picture>& rough, uint8_t no_rough,
               const std::optional<Picture>& metal, uint8_t no_metal) {
    const glm::ivec2 size = larger_size({pointer_to(rough), pointer_to(metal)});
    Picture picture{size.x, size.y, {}};
    picture.pixels.reserve(size_t(size.x) * size_t(size.y));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            picture.pixels.push_back({255, value_at(rough, x, y, size, no_rough),
                                      value_at(metal, x, y, size, no_metal), 255});
    return picture;
}

}  // namespace

bool has_maps(const MtlMaterial& m) {
    return !m.emission_map.file.empty() || !m.roughness_map.file.empty() ||
           !m.metallic_map.file.empty();
}

Picture covered_by(const Picture& cover, const std::optional<Picture>& colors) {
    const bool has_alpha = lets_through(cover);
    const auto share = [&](const Pixel& p) {
        return has_alpha ? p[3] : uint8_t((int{p[0]} + p[1] + p[2] + 1) / 3);
    };
    const glm::ivec2 size = larger_size({&cover, pointer_to(colors)});
    Picture picture{size.x, size.y, {}};
    picture.pixels.reserve(size_t(size.x) * size_t(size.y));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            Pixel pixel = colors ? pixel_at(*colors, x, y, size) : Pixel{255, 255, 255, 255};
            pixel[3] = share(pixel_at(cover, x, y, size));
            picture.pixels.push_back(pixel);
        }
    return picture;
}

bool lets_through(const Picture& picture) {
    const auto alpha = [](const Pixel& p) { return p[3]; };
    const auto& pixels = picture.pixels;
    return std::ranges::any_of(
               pixels, [](int a) { return a < 255; }, alpha) &&
           std::ranges::any_of(
               pixels, [](int a) { return a > 0; }, alpha);
}

void LibraryMaps::add(const MtlMaterial& material, Texture& texture) {
    const MtlTexture &rough = material.roughness_map, &metal = material.metallic_map,
                     &emission = material.emission_map;
    const MtlTexture& gloss = rough.file.empty() ? metal : rough;
    const auto map = [&](const MtlTexture& from, const Key& key, const auto& image) -> TextureMap {
        if (from.file.empty()) return {};
        return {appended(key, from.clamps, image), transform_by(from, material.diffuse_map)};
    };
    texture.maps[kGlossMap] = map(gloss, {kGlossMap, rough.file, metal.file, gloss.clamps},
                                  [&] { return gloss_image(rough.file, metal.file); });
    texture.maps[kEmissionMap] = map(emission, {kEmissionMap, emission.file, "", emission.clamps},
                                     [&] { return emission_image(emission.file); });
}

/// The number of a texture, whose image is made once.
uint32_t LibraryMaps::appended(const Key& key, bool clamps,
                               const std::function<TextureImage()>& image) {
    const auto [entry, is_new] = known_.try_emplace(key, kNoTexture);
    if (!is_new) return entry->second;
    const TextureWrap wrap = clamps ? TextureWrap::clamp : TextureWrap::repeat;
    const auto made = std::make_shared<const TextureImage>(image());
    mesh_.textures.push_back({made, wrap, wrap});
    return entry->second = uint32_t(mesh_.textures.size() - 1);
}

std::optional<Picture> LibraryMaps::read(const std::string& file) {
    if (file.empty()) return std::nullopt;
    return companion_picture(mesh_file_, file, mesh_);
}

TextureImage LibraryMaps::gloss_image(const std::string& rough, const std::string& metal) {
    const std::optional<Picture> of_rough = read(rough), of_metal = read(metal);
    return with_levels_of_data(joined(of_rough, rough.empty() ? 255 : kUnknownRoughness, of_metal,
                                      metal.empty() ? 255 : 0));
}

TextureImage LibraryMaps::emission_image(const std::string& file) {
    const std::optional<Picture> picture = read(file);
    return picture ? with_levels(*picture) : one_texel(0, 0, 0);
}

}  // namespace voxelume
