// SPDX-License-Identifier: Apache-2.0
// The base colour textures of a glTF file's materials.
#pragma once

#include <glm/vec2.hpp>
#include <map>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {

/// A texture as a material uses it.
struct GltfTextureUse {
    int texture = -1;  ///< number in the file; -1: none
    uint64_t set = 0;  ///< of texture coordinates
    // KHR_texture_transform
    glm::dvec2 offset{0}, scale{1};
    double rotation = 0;  ///< radians, counter-clockwise

    glm::vec2 moved(const glm::vec2& uv) const;
};

/// Appends textures to a mesh, each of the file's images once.
class GltfTextures {
  public:
    explicit GltfTextures(const GltfFile& file) : file_(file) {}

    GltfTextureUse of_material(int material) const;
    /// The number of the material's texture in the mesh, or kNoTexture; a note says why where the
    /// material has one that can't be read.
    uint32_t append(int material, Mesh& mesh);

  private:
    std::shared_ptr<const TextureImage> image_of(const GltfValue& texture, Mesh& mesh);

    const GltfFile& file_;
    std::map<int, std::shared_ptr<const TextureImage>> images_;
    std::map<std::pair<int, uint32_t>, uint32_t> appended_;  ///< by their numbers and alpha
};

}  // namespace voxelume
