// SPDX-License-Identifier: Apache-2.0
// The maps that a material of an OBJ file's library names, apart from its colour's texture.
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

/// What `colors`, or white, becomes where another picture says how much of it covers: by its alpha
/// or, if that is 255 everywhere, by the mean of its channels. It is of the larger one's size.
Picture covered_by(const Picture& cover, const std::optional<Picture>& colors);

/// True if the alpha of some pixels is below 255. A picture whose alpha is 0 everywhere counts as
/// one without: nobody paints what isn't there.
bool lets_through(const Picture& picture);

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
