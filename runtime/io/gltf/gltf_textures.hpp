// SPDX-License-Identifier: Apache-2.0
// The textures of a glTF file's materials: base colours, and their maps.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <tuple>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/gltf/gltf_texture_use.hpp"

namespace voxelume {

/// Appends textures to a mesh, each of the file's images once.
class GltfTextures {
  public:
    explicit GltfTextures(const GltfFile& file) : file_(file), unlit_(gltf_unlit_materials(file)) {}

    /// Looks which materials the mesh has on vertices with alpha. All meshes that are added are
    /// expected before.
    void expect_mesh(int number);

    /// How the material uses its base colour's texture, or without one its first map; all of its
    /// maps lie on the same places.
    GltfTextureUse of_material(int material) const;
    /// True if the alpha of vertices says how much is covered of what has the material. It is a
    /// place on a texture of alpha_ramp.hpp, so that materials with other textures don't show it.
    bool shows_vertex_alpha(int material) const;
    /// Notes that it isn't shown where vertices let light through, though the material wants it.
    void note_lost_alpha(int material, Mesh& mesh);
    /// The number of the material's texture in the mesh, or kNoTexture; a note says why where the
    /// material has one that can't be read. A material with maps alone gets a white texture.
    uint32_t append(int material, Mesh& mesh);

  private:
    using Image = std::shared_ptr<const TextureImage>;

    Image image_of(const GltfValue& texture, bool is_data, Mesh& mesh);
    Image read_image(const GltfValue& image, bool is_data) const;
    Texture texture_of(int number, bool is_data, Mesh& mesh);
    TextureMap map_of(int material, size_t map, Mesh& mesh);
    uint32_t append_map(const GltfTextureUse& use, size_t map, bool is_mean, Mesh& mesh);

    const GltfFile& file_;
    std::set<int> unlit_;                           ///< materials
    std::map<std::pair<int, bool>, Image> images_;  ///< by their numbers, and whether of data
    /// By their numbers and alpha, and the number of a material with maps.
    std::map<std::tuple<int, uint32_t, int>, uint32_t> appended_;
    std::set<int> meshes_;         ///< that are expected
    std::set<int> vertex_alphas_;  ///< materials of primitives whose vertices have alpha
    std::set<int> lost_alphas_;    ///< materials of which a note says that it isn't shown
    std::map<std::tuple<int, size_t, bool>, uint32_t> maps_;  ///< by numbers, kinds and being means
};

}  // namespace voxelume
