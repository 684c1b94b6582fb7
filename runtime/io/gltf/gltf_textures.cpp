// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_textures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/base/error.hpp"
#include "runtime/io/image/picture.hpp"
#include "runtime/io/image_codec/image_codec.hpp"
#include "runtime/io/mesh/alpha_ramp.hpp"
#include "runtime/io/mesh/mesh_textures.hpp"
#include "runtime/io/mesh/texture_levels.hpp"

namespace voxelume {
namespace {

TextureWrap wrap_of(const GltfValue& sampler, const char* key) {
    constexpr uint64_t kClamp = 33071, kMirror = 33648;
    const uint64_t wrap = sampler.count(key, 0);
    return wrap == kClamp    ? TextureWrap::clamp
           : wrap == kMirror ? TextureWrap::mirror
                             : TextureWrap::repeat;
}

/// The meaning of the alpha of a material's texture, which the material's factor multiplies.
uint32_t alpha_of(const GltfValue& material) {
    const std::string mode = material.text("alphaMode", "OPAQUE");
    if (mode == "BLEND") return kAlphaBlend;
    if (mode != "MASK") return kAlphaOpaque;
    const std::vector<double> factor =
        material.at("pbrMetallicRoughness").numbers("baseColorFactor", 4);
    const double cutoff = std::clamp(material.number("alphaCutoff", 0.5), 0.0, 1.0);
    const double share = factor.empty() ? 1 : std::clamp(factor[3], 0.0, 1.0);
    // With an opacity below the cutoff no texel reaches the cutoff.
    if (share <= cutoff) return share < cutoff ? kAlphaOpaque : 255;
    return uint32_t(std::clamp(std::ceil(255 * cutoff / share), 0.0, 255.0));
}

/// The replacement of a map that can't be read: nothing is emissive, and nothing is metal.
TextureImage without_map(size_t map) {
    return map == kEmissionMap ? one_texel(0, 0, 0) : one_texel(0, kUnknownRoughness, 0);
}

constexpr std::array<const char*, kMapCount> kMapNames = {"metallic-roughness", "emissive"};

/// True if the colours of a primitive's vertices have an alpha.
bool has_alpha(const GltfValue& root, const GltfValue& primitive) {
    const int colors = primitive.at("attributes").index("COLOR_0", root.size("accessors"));
    return colors >= 0 && root.item("accessors", size_t(colors)).text("type") == "VEC4";
}

}  // namespace

void GltfTextures::expect_mesh(int number) {
    if (!meshes_.insert(number).second) return;
    const GltfValue root = file_.root();
    for (const GltfValue& primitive : root.item("meshes", size_t(number)).items("primitives"))
        if (has_alpha(root, primitive))
            vertex_alphas_.insert(primitive.index("material", root.size("materials")));
}

bool GltfTextures::shows_vertex_alpha(int material) const {
    if (material < 0 || !vertex_alphas_.contains(material)) return false;
    const GltfValue item = file_.root().item("materials", size_t(material));
    return alpha_of(item) != kAlphaOpaque && of_material(material).texture < 0;
}

void GltfTextures::note_lost_alpha(int material, Mesh& mesh) {
    if (material < 0 || shows_vertex_alpha(material)) return;
    const GltfValue item = file_.root().item("materials", size_t(material));
    if (alpha_of(item) == kAlphaOpaque || !lost_alphas_.insert(material).second) return;
    mesh.notes.push_back(
        fmt::format("the alpha of its vertices isn't shown where they have its {}: that has "
                    "textures",
                    item.place()));
}

GltfTextureUse GltfTextures::of_material(int material) const {
    if (material < 0) return {};
    const GltfValue item = file_.root().item("materials", size_t(material));
    GltfTextureUse use = gltf_base_texture(file_, item);
    for (size_t map = 0; map < kMapCount && use.texture < 0; ++map)
        use = gltf_map(file_, item, map, unlit_.contains(material));
    return use;
}

uint32_t GltfTextures::append(int material, Mesh& mesh) {
    if (material < 0) return kNoTexture;
    const GltfValue item = file_.root().item("materials", size_t(material));
    if (shows_vertex_alpha(material)) {
        mesh.textures.push_back(alpha_ramp(alpha_of(item)));
        return uint32_t(mesh.textures.size() - 1);
    }
    const int number = gltf_base_texture(file_, item).texture;
    std::array<TextureMap, kMapCount> maps;
    for (size_t map = 0; map < kMapCount; ++map) maps[map] = map_of(material, map, mesh);
    const bool has_maps = Texture{nullptr, {}, {}, 0, maps}.has_maps();
    if (number < 0 && !has_maps) return kNoTexture;
    const uint32_t alpha = number < 0 ? kAlphaOpaque : alpha_of(item);
    const auto [entry, is_new] =
        appended_.try_emplace({number, alpha, has_maps ? material : -1}, kNoTexture);
    if (!is_new) return entry->second;
    Texture made = texture_of(number, false, mesh);
    if (!made.image && !has_maps) return kNoTexture;
    made.alpha = made.image ? alpha : kAlphaOpaque;
    if (!made.image) made.image = std::make_shared<const TextureImage>(one_texel(255, 255, 255));
    made.maps = maps;
    mesh.textures.push_back(made);
    return entry->second = uint32_t(mesh.textures.size() - 1);
}

/// One of the file's textures. It has no image if none can be read.
Texture GltfTextures::texture_of(int number, bool is_data, Mesh& mesh) {
    Texture made;
    if (number < 0) return made;
    const GltfValue root = file_.root(), texture = root.item("textures", size_t(number));
    made.image = image_of(texture, is_data, mesh);
    const int sampler = texture.index("sampler", root.size("samplers"));
    if (sampler >= 0) {
        const GltfValue from = root.item("samplers", size_t(sampler));
        made.wrap_u = wrap_of(from, "wrapS");
        made.wrap_v = wrap_of(from, "wrapT");
    }
    return made;
}

/// A map of the material. A map with other texture coordinates is replaced by its mean.
TextureMap GltfTextures::map_of(int material, size_t map, Mesh& mesh) {
    const GltfValue item = file_.root().item("materials", size_t(material));
    const GltfTextureUse use = gltf_map(file_, item, map, unlit_.contains(material));
    TextureMap made;
    if (use.texture < 0) return made;
    const auto transform = gltf_map_transform(use, of_material(material));
    if (transform)
        made.transform = *transform;
    else
        mesh.notes.push_back(
            fmt::format("the {} texture of its {} is shown as its mean: it has texture coordinates "
                        "of its own",
                        kMapNames[map], item.place()));
    made.texture = append_map(use, map, !transform, mesh);
    return made;
}

uint32_t GltfTextures::append_map(const GltfTextureUse& use, size_t map, bool is_mean, Mesh& mesh) {
    const auto [entry, is_new] = maps_.try_emplace({use.texture, map, is_mean}, kNoTexture);
    if (!is_new) return entry->second;
    Texture made = texture_of(use.texture, map == kGlossMap, mesh);
    if (!made.image)
        made.image = std::make_shared<const TextureImage>(without_map(map));
    else if (is_mean)
        made.image =
            std::make_shared<const TextureImage>(TextureImage{1, 1, {made.image->texels.back()}});
    mesh.textures.push_back(made);
    return entry->second = uint32_t(mesh.textures.size() - 1);
}

GltfTextures::Image GltfTextures::read_image(const GltfValue& image, bool is_data) const {
    const Picture picture = parse_picture(file_.image(image), file_.path());
    uint64_t texels = uint64_t(picture.width) * uint64_t(picture.height);
    for (const auto& [other, known] : images_)
        if (known) texels += uint64_t(known->width) * uint64_t(known->height);
    if (texels > kMaxMeshTexels)
        throw Error(ErrorKind::input, "all textures of a mesh have at most 2^28 texels");
    return std::make_shared<const TextureImage>(is_data ? with_levels_of_data(picture)
                                                        : with_levels(picture));
}

GltfTextures::Image GltfTextures::image_of(const GltfValue& texture, bool is_data, Mesh& mesh) {
    const GltfValue root = file_.root();
    const int number = texture.index("source", root.size("images"));
    if (number < 0) {
        mesh.notes.push_back(
            fmt::format("its texture {} isn't shown: it has no PNG or JPEG", texture.place()));
        return {};
    }
    const auto [entry, is_new] = images_.try_emplace({number, is_data});
    if (!is_new) return entry->second;
    const GltfValue image = root.item("images", size_t(number));
    try {
        entry->second = read_image(image, is_data);
    } catch (const ImageDecoderError&) {
        throw;  // the picture may be whole
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input) throw;
        mesh.notes.push_back(fmt::format("its {} isn't shown: {}", image.place(), error.what()));
    }
    return entry->second;
}

}  // namespace voxelume
