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

    /// Notes which materials the mesh uses on vertices with alpha. All meshes are to be expected
    /// before the first is added.
    void expect_mesh(int number);

    /// The material's use of its base colour's texture, or without one of its first map. All of its
    /// maps share these texture coordinates.
    GltfTextureUse of_material(int material) const;
    /// True if the alpha of vertices is the opacity of surfaces with the material. It is a UV on a
    /// texture of alpha_ramp.hpp, so materials with other textures don't show it.
    bool shows_vertex_alpha(int material) const;
    /// Adds a note that the vertices' alpha isn't shown, although the material asks for it.
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
    std::set<int> unlit_;                           ///< numbers of unlit materials
    std::map<std::pair<int, bool>, Image> images_;  ///< by number, and whether of data
    /// By their numbers and alpha, and the number of a material with maps.
    std::map<std::tuple<int, uint32_t, int>, uint32_t> appended_;
    std::set<int> meshes_;         ///< numbers of expected meshes
    std::set<int> vertex_alphas_;  ///< materials of primitives whose vertices have alpha
    std::set<int> lost_alphas_;    ///< materials with such a note
    std::map<std::tuple<int, size_t, bool>, uint32_t> maps_;  ///< by number, kind, and being a mean
};

}  // namespace voxelume
