// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_textures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/error.hpp"
#include "runtime/io/image/picture.hpp"
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

/// The base colour's texture, in either way of describing a material.
GltfValue base_texture(const GltfValue& material) {
    const GltfValue common = material.at("pbrMetallicRoughness");
    if (common.has("baseColorTexture")) return common.at("baseColorTexture");
    return material.extension("KHR_materials_pbrSpecularGlossiness").at("diffuseTexture");
}

/// What the alpha of a material's texture means, of which its factor is a part.
uint32_t alpha_of(const GltfValue& material) {
    const std::string mode = material.text("alphaMode", "OPAQUE");
    if (mode == "BLEND") return kAlphaBlend;
    if (mode != "MASK") return kAlphaOpaque;
    const std::vector<double> factor =
        material.at("pbrMetallicRoughness").numbers("baseColorFactor", 4);
    const double cutoff = std::clamp(material.number("alphaCutoff", 0.5), 0.0, 1.0);
    const double share = factor.empty() ? 1 : std::clamp(factor[3], 0.0, 1.0);
    // Nothing reaches the cutoff of a smaller factor, which the material's opacity says.
    if (share <= cutoff) return share < cutoff ? kAlphaOpaque : 255;
    return uint32_t(std::clamp(std::ceil(255 * cutoff / share), 0.0, 255.0));
}

}  // namespace

glm::vec2 GltfTextureUse::moved(const glm::vec2& uv) const {
    const double c = std::cos(rotation), s = std::sin(rotation);
    const glm::dvec2 at = glm::dvec2(uv) * scale;
    const glm::vec2 moved(offset + glm::dvec2(c * at.x + s * at.y, c * at.y - s * at.x));
    return std::isfinite(moved.x) && std::isfinite(moved.y) ? moved : glm::vec2(0);
}

GltfTextureUse GltfTextures::of_material(int material) const {
    GltfTextureUse use;
    if (material < 0) return use;
    const GltfValue info = base_texture(file_.root().item("materials", size_t(material)));
    use.texture = info.index("index", file_.root().size("textures"));
    const GltfValue transform = info.extension("KHR_texture_transform");
    use.set = transform.count("texCoord", info.count("texCoord", 0));
    const std::vector<double> offset = transform.numbers("offset", 2);
    const std::vector<double> scale = transform.numbers("scale", 2);
    if (!offset.empty()) use.offset = {offset[0], offset[1]};
    if (!scale.empty()) use.scale = {scale[0], scale[1]};
    use.rotation = transform.number("rotation", 0);
    return use;
}

uint32_t GltfTextures::append(int material, Mesh& mesh) {
    const int number = of_material(material).texture;
    if (number < 0) return kNoTexture;
    const uint32_t alpha = alpha_of(file_.root().item("materials", size_t(material)));
    const auto [entry, is_new] = appended_.try_emplace({number, alpha}, kNoTexture);
    if (!is_new) return entry->second;
    const GltfValue root = file_.root(), texture = root.item("textures", size_t(number));
    const auto image = image_of(texture, mesh);
    if (!image) return kNoTexture;
    Texture made{image};
    made.alpha = alpha;
    const int sampler = texture.index("sampler", root.size("samplers"));
    if (sampler >= 0) {
        const GltfValue from = root.item("samplers", size_t(sampler));
        made.wrap_u = wrap_of(from, "wrapS");
        made.wrap_v = wrap_of(from, "wrapT");
    }
    mesh.textures.push_back(made);
    return entry->second = uint32_t(mesh.textures.size() - 1);
}

std::shared_ptr<const TextureImage> GltfTextures::image_of(const GltfValue& texture, Mesh& mesh) {
    const GltfValue root = file_.root();
    const int number = texture.index("source", root.size("images"));
    if (number < 0) {
        mesh.notes.push_back(
            fmt::format("its texture {} isn't shown: it has no PNG or JPEG", texture.place()));
        return {};
    }
    const auto [entry, is_new] = images_.try_emplace(number);
    if (!is_new) return entry->second;
    const GltfValue image = root.item("images", size_t(number));
    try {
        const Picture picture = parse_picture(file_.image(image), file_.path());
        uint64_t texels = uint64_t(picture.width) * uint64_t(picture.height);
        for (const auto& [other, known] : images_)
            if (known) texels += uint64_t(known->width) * uint64_t(known->height);
        if (texels > kMaxMeshTexels)
            throw Error(ErrorKind::input, "all textures of a mesh have at most 2^28 texels");
        entry->second = std::make_shared<const TextureImage>(with_levels(picture));
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input) throw;
        mesh.notes.push_back(fmt::format("its {} isn't shown: {}", image.place(), error.what()));
    }
    return entry->second;
}

}  // namespace voxelume
