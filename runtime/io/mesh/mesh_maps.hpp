// SPDX-License-Identifier: Apache-2.0
// The maps of a material of an OBJ file's library, without the colour's texture.
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

/// Multiplies `colors`, or white, by the opacity in another picture: its alpha or, if that is 255
/// everywhere, the mean of its channels. The result has the size of the larger picture.
Picture covered_by(const Picture& cover, const std::optional<Picture>& colors);

/// True if the alpha of some pixels is below 255. A picture whose alpha is 0 everywhere counts as
/// opaque, because invisible pictures aren't meant.
bool lets_through(const Picture& picture);

/// The maps of a library's materials as textures of a mesh, each pair of pictures once.
class LibraryMaps {
  public:
    LibraryMaps(const std::filesystem::path& mesh_file, Mesh& mesh)
        : mesh_file_(mesh_file), mesh_(mesh) {}

    /// Appends the maps of a material to the mesh (map_Ke; map_Pr and map_Pm as one), and adds them
    /// to the texture, whose UVs are those of map_Kd. A map that can't be read gets a note, and is
    /// replaced by one that neither emits nor is metal.
    void add(const MtlMaterial& material, Texture& texture);

  private:
    /// The map's kind, its one or two pictures, and whether they are clamped at their edges.
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
