// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_unshown.hpp"

#include <algorithm>

#include "runtime/io/gltf/gltf_texture_use.hpp"

namespace voxelume {
namespace {

bool has_clear_coat(const GltfValue& material) {
    return material.extension("KHR_materials_clearcoat").number("clearcoatFactor", 0) > 0;
}

bool coat_has(const GltfValue& material, const char* texture) {
    return has_clear_coat(material) && material.extension("KHR_materials_clearcoat").has(texture);
}

bool has_clear_map(const GltfValue& material) {
    const GltfValue clear = material.extension("KHR_materials_transmission");
    return clear.number("transmissionFactor", 0) > 0 && clear.has("transmissionTexture");
}

bool has_colored_gloss(const GltfValue& material) {
    const GltfValue layer = material.extension("KHR_materials_specular");
    const std::vector<double> color = layer.numbers("specularColorFactor", 3);
    return layer.has("specularColorTexture") ||
           std::ranges::any_of(color, [](double v) { return v != 1; });
}

bool has_lost_gloss_map(const GltfValue& material) {
    return material.at("pbrMetallicRoughness").has("metallicRoughnessTexture") &&
           !gltf_has_gloss_map(material);
}

}  // namespace

void note_unshown(const GltfValue& material, std::vector<std::string>& notes) {
    if (material.has_extension("KHR_materials_unlit")) return;  // it has nothing but a colour
    const auto add = [&](bool is_there, const char* sentence) {
        if (is_there && std::ranges::find(notes, sentence) == notes.end())
            notes.emplace_back(sentence);
    };
    add(has_clear_map(material),
        "its transmission textures aren't shown: all of a surface lets as much light through as "
        "the factor says");
    add(material.extension("KHR_materials_specular").has("specularTexture"),
        "its specular textures aren't shown: what has one reflects as much as its index of "
        "refraction says");
    add(has_colored_gloss(material),
        "its colours of KHR_materials_specular aren't shown: highlights are white");
    add(coat_has(material, "clearcoatTexture"),
        "its clear coats aren't shown where a texture says how much they cover");
    add(coat_has(material, "clearcoatRoughnessTexture"),
        "its clear coats are smooth where a texture says how rough they are");
    add(has_lost_gloss_map(material),
        "its metallic-roughness textures aren't shown on glass and under clear coats, which have a "
        "roughness of 0.7 in place of one");
    add(material.extension("KHR_materials_pbrSpecularGlossiness").has("specularGlossinessTexture"),
        "its specular-glossiness textures aren't shown");
}

std::vector<std::string> unshown_of_gltf(const GltfFile& file) {
    bool has_bumps = false, has_occlusion = false, has_thickness = false, is_matte = false;
    const std::set<int> unlit = gltf_unlit_materials(file);
    int number = 0;
    for (const GltfValue& material : file.root().items("materials")) {
        has_bumps |= material.has("normalTexture") || coat_has(material, "clearcoatNormalTexture");
        has_occlusion |= material.has("occlusionTexture");
        has_thickness |= material.extension("KHR_materials_volume").has("thicknessTexture");
        is_matte |= material.has_extension("KHR_materials_unlit") && !unlit.contains(number);
        ++number;
    }
    std::vector<std::string> notes;
    if (has_bumps) notes.emplace_back("its normal textures aren't shown: surfaces have no bumps");
    if (has_occlusion)
        notes.emplace_back("its occlusion textures aren't shown: rays find what is occluded");
    if (has_thickness)
        notes.emplace_back("its thickness textures aren't shown: rays find how thick bodies are");
    if (is_matte)
        notes.emplace_back(
            "its materials of KHR_materials_unlit are matte, and lit as others are, "
            "where vertices have colours");
    return notes;
}

}  // namespace voxelume
