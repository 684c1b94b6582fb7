// SPDX-License-Identifier: Apache-2.0
// The maps that a material of an OBJ file's library names, beside its colour's texture.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/image/picture.hpp"
#include "runtime/io/mesh/material_library.hpp"

namespace voxelume {

bool has_maps(const MtlMaterial& material);

/// The maps of a library's materials as textures of a mesh, each pair of pictures once.
class LibraryMaps {
  public:
    LibraryMaps(const std::filesystem::path& mesh_file, Mesh& mesh)
        : mesh_file_(mesh_file), mesh_(mesh) {}

    /// Appends the maps of a material to the mesh (map_Ke; map_Pr and map_Pm as one), and gives
    /// them to the texture, whose places are those of map_Kd. What stands for one that can't be
    /// read, which a note says, neither glows nor is metal.
    void add(const MtlMaterial& material, Texture& texture);

  private:
    /// Which map it is, its one or two pictures, and whether they end at their edges.
    using Key = std::tuple<size_t, std::string, std::string, bool>;

    uint32_t appended(const Key& key, bool clamps, const std::function<TextureImage()>& image);
    std::optional<Picture> read(const std::string& file);
    TextureImage gloss_image(const std::string& rough, const std::string& metal);
    TextureImage emission_image(const std::string& file);

    const std::filesystem::path& mesh_file_;
    Mesh& mesh_;
    std::map<Key, uint32_t> known_;
};

}  // namespace voxelume
