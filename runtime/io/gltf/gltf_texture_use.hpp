// SPDX-License-Identifier: Apache-2.0
// How the materials of a glTF file use textures, and which of them are shown.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <set>

#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {

/// A texture as a material uses it.
struct GltfTextureUse {
    int texture = -1;  ///< number in the file; -1: none
    uint64_t set = 0;  ///< number of the set of texture coordinates
    // KHR_texture_transform
    glm::dvec2 offset{0}, scale{1};
    double rotation = 0;  ///< radians, counter-clockwise

    glm::vec2 moved(const glm::vec2& uv) const;
};

/// The base colour's texture, in either way of describing a material.
GltfTextureUse gltf_base_texture(const GltfFile& file, const GltfValue& material);

/// The numbers of the materials of KHR_materials_unlit, whose base colour is shown as emission.
/// Materials of vertices with colours aren't among them, since vertex colours don't multiply
/// emission.
std::set<int> gltf_unlit_materials(const GltfFile& file);

/// The texture that a material shows as map number `map` of TextureMap. Unlit materials show the
/// base colour's texture as emission.
GltfTextureUse gltf_map(const GltfFile& file, const GltfValue& material, size_t map, bool is_unlit);

/// True if a metallic-roughness texture of the material is shown, whose factors it multiplies.
/// Glass and coated surfaces have one roughness.
bool gltf_has_gloss_map(const GltfValue& material);

/// The UVs of a map in terms of those of the base texture, as TextureMap has them; empty where they
/// don't follow from each other.
std::optional<std::array<float, 6>> gltf_map_transform(const GltfTextureUse& map,
                                                       const GltfTextureUse& base);

}  // namespace voxelume
