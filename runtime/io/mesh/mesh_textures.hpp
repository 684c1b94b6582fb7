// SPDX-License-Identifier: Apache-2.0
// The textures that OBJ and PLY files name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/image/picture.hpp"

namespace voxelume {

/// The most texels of all first levels of a mesh's textures.
inline constexpr uint64_t kMaxMeshTexels = uint64_t{1} << 28;

/// Reads the textures of the mesh of file `name`: map_Kd and the maps of an OBJ file's library, or
/// that of a PLY file's comment TextureFile. One that isn't there, is damaged or too large is left
/// out with a note. A mesh without textures loses its places on them.
void read_textures(const std::filesystem::path& name, Mesh& mesh);

/// A picture that a mesh's file names; nothing, but a note to say why, where it can't be read.
std::optional<Picture> companion_picture(const std::filesystem::path& mesh_file,
                                         const std::string& texture_file, Mesh& mesh);

/// Appends the texture of a picture's file, unless a note says why there is none. Returns its
/// number, or kNoTexture.
uint32_t append_texture(const std::filesystem::path& mesh_file, const std::string& texture_file,
                        TextureWrap wrap, Mesh& mesh);

/// All other files that the bytes of a mesh's file lead to.
std::vector<std::filesystem::path> companion_files(const std::string& bytes,
                                                   const std::filesystem::path& name);

}  // namespace voxelume
