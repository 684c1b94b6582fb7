// SPDX-License-Identifier: Apache-2.0
// The textures to which OBJ and PLY files refer.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/image/picture.hpp"

namespace voxelume {

/// The maximum number of texels in the first levels of all of a mesh's textures.
inline constexpr uint64_t kMaxMeshTexels = uint64_t{1} << 28;

/// Reads the textures of the mesh of file `name`: map_Kd and the maps of an OBJ file's library, or
/// the comment TextureFile of a PLY file. A texture that is missing, damaged or too large is left
/// out with a note. A mesh without textures loses its UVs.
void read_textures(const std::filesystem::path& name, Mesh& mesh);

/// A picture to which a mesh's file refers; empty, with a note that says why, if it can't be read.
std::optional<Picture> companion_picture(const std::filesystem::path& mesh_file,
                                         const std::string& texture_file, Mesh& mesh);

/// Appends the texture of a picture's file. Returns its number, or kNoTexture with a note that says
/// why.
uint32_t append_texture(const std::filesystem::path& mesh_file, const std::string& texture_file,
                        TextureWrap wrap, Mesh& mesh);

/// All other files to which the bytes of a mesh's file lead.
std::vector<std::filesystem::path> companion_files(const std::string& bytes,
                                                   const std::filesystem::path& name);

}  // namespace voxelume
