// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_texture_use.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "runtime/geometry/texture.hpp"

namespace voxelume {
namespace {

constexpr const char* kBySpecular = "KHR_materials_pbrSpecularGlossiness";

GltfTextureUse use_of(const GltfFile& file, const GltfValue& info) {
    GltfTextureUse use;
    use.texture = info.index("index", file.root().size("textures"));
    const GltfValue transform = info.extension("KHR_texture_transform");
    use.set = transform.count("texCoord", info.count("texCoord", 0));
    const std::vector<double> offset = transform.numbers("offset", 2);
    const std::vector<double> scale = transform.numbers("scale", 2);
    if (!offset.empty()) use.offset = {offset[0], offset[1]};
    if (!scale.empty()) use.scale = {scale[0], scale[1]};
    use.rotation = transform.number("rotation", 0);
    return use;
}

/// The linear part of a use's transform.
glm::dmat2 matrix_of(const GltfTextureUse& use) {
    const double c = std::cos(use.rotation), s = std::sin(use.rotation);
    return {{c * use.scale.x, -s * use.scale.x}, {s * use.scale.y, c * use.scale.y}};
}

}  // namespace

glm::vec2 GltfTextureUse::moved(const glm::vec2& uv) const {
    const double c = std::cos(rotation), s = std::sin(rotation);
    const glm::dvec2 at = glm::dvec2(uv) * scale;
    const glm::vec2 moved(offset + glm::dvec2(c * at.x + s * at.y, c * at.y - s * at.x));
    return std::isfinite(moved.x) && std::isfinite(moved.y) ? moved : glm::vec2(0);
}

GltfTextureUse gltf_base_texture(const GltfFile& file, const GltfValue& material) {
    const GltfValue common = material.at("pbrMetallicRoughness");
    return use_of(file, common.has("baseColorTexture")
                            ? common.at("baseColorTexture")
                            : material.extension(kBySpecular).at("diffuseTexture"));
}

std::set<int> gltf_unlit_materials(const GltfFile& file) {
    const GltfValue root = file.root();
    const size_t count = root.size("materials");
    std::set<int> unlit;
    for (size_t i = 0; i < count; ++i)
        if (root.item("materials", i).has_extension("KHR_materials_unlit")) unlit.insert(int(i));
    if (unlit.empty()) return unlit;
    for (const GltfValue& mesh : root.items("meshes"))
        for (const GltfValue& primitive : mesh.items("primitives"))
            if (primitive.at("attributes").has("COLOR_0"))
                unlit.erase(primitive.index("material", count));
    return unlit;
}

GltfTextureUse gltf_map(const GltfFile& file, const GltfValue& material, size_t map,
                        bool is_unlit) {
    if (is_unlit) return map == kEmissionMap ? gltf_base_texture(file, material) : GltfTextureUse{};
    if (map == kEmissionMap) {
        const std::vector<double> factor = material.numbers("emissiveFactor", 3);
        const bool is_emissive = std::ranges::any_of(factor, [](double v) { return v > 0; });
        return is_emissive ? use_of(file, material.at("emissiveTexture")) : GltfTextureUse{};
    }
    if (!gltf_has_gloss_map(material)) return {};
    return use_of(file, material.at("pbrMetallicRoughness").at("metallicRoughnessTexture"));
}

bool gltf_has_gloss_map(const GltfValue& material) {
    const GltfValue coat = material.extension("KHR_materials_clearcoat");
    const bool has_coat = !coat.has("clearcoatTexture") && coat.number("clearcoatFactor", 0) > 0;
    const bool is_glass =
        material.extension("KHR_materials_transmission").number("transmissionFactor", 0) > 0;
    return !has_coat && !is_glass && !material.has_extension("KHR_materials_unlit") &&
           material.at("pbrMetallicRoughness").has("metallicRoughnessTexture");
}

std::optional<std::array<float, 6>> gltf_map_transform(const GltfTextureUse& map,
                                                       const GltfTextureUse& base) {
    const glm::dmat2 from = matrix_of(base);
    if (map.set != base.set || glm::determinant(from) == 0) return std::nullopt;
    const glm::dmat2 m = matrix_of(map) * glm::inverse(from);
    const glm::dvec2 off = map.offset - m * base.offset;
    const std::array<float, 6> transform = {float(m[0].x), float(m[1].x), float(off.x),
                                            float(m[0].y), float(m[1].y), float(off.y)};
    const bool is_finite = std::ranges::all_of(transform, [](float v) { return std::isfinite(v); });
    return is_finite ? std::optional(transform) : std::nullopt;
}

}  // namespace voxelume
